"""The pane of the column profile, declared."""

from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.shell.feature import Feature, Pane
from occ_gui.shell.results import Results

if TYPE_CHECKING:
    from occ_gui.profile.pane import ProfilePart


def profile(store: Store) -> "Feature[ProfilePart]":
    """Declare the pane: figures, the comparison and the equations look at what it shows."""

    def make() -> "Pane[ProfilePart]":
        from occ_gui.profile.pane import ProfilePane

        return ProfilePane(store)

    def part(workspace: Workspace, results: Results) -> "ProfilePart":
        return (
            results.reading,
            results.before,
            results.photo_profile,
            results.chips,
            workspace.is_enhanced,
        )

    return Feature(
        name="profile",
        title="Column profile",
        help="guide.md#compare-column-profiles",
        make=make,
        part=part,
        goes_on_hidden=True,
    )
