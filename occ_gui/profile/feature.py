"""The pane of the column profile, declared."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.profile.figures import profile_figure
from occ_gui.shell.feature import Feature, Pane
from occ_gui.shell.results import Board, Results

if TYPE_CHECKING:
    from occ_gui.profile.pane import ProfilePart


def profile(store: Store, board: Board, about_photo: Callable[[], str]) -> "Feature[ProfilePart]":
    """Declare the pane: the comparison and the equations look at what it shows.

    ``about_photo`` gives what stands under a figure with the photo.
    """

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
        figures=(profile_figure(store, board, about_photo),),
    )
