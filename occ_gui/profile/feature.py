"""The pane of the column profile, declared."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.shell.feature import Draw, Feature, Figure, Pane
from occ_gui.shell.results import Board, Results
from occ_gui.simulation.snapshot import Snapshot

if TYPE_CHECKING:
    from occ_gui.profile.pane import ProfilePane, ProfilePart
    from occ_model.figures.drawing import Drawing


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


def profile_figure(store: Store, board: Board, about_photo: Callable[[], str]) -> Figure:
    """Declare the figure; ``about_photo`` gives what stands under the profile of the photo."""

    def ask(pane: "ProfilePane | None", shown: Snapshot) -> Draw:
        workspace, photo = store.workspace, board.results.photo_profile
        comparison = None if photo is None else photo.comparison
        about = "" if comparison is None else about_photo()
        whole = (0, len(shown.profile))
        columns = slice(*(whole if pane is None else pane.view.columns_in_view()))
        enhanced = workspace.is_enhanced
        band = shown.band_levels(enhanced=enhanced)
        decoded = shown.result_of(workspace.decoder)

        def draw() -> "Drawing":
            from occ_model.figures.window_panes import profile_drawing

            return profile_drawing(
                shown.frame, band, shown.band_undefined, comparison, columns,
                enhanced=enhanced, decoded=decoded, about=about,
            )  # fmt: skip

        return draw

    return Figure(name="profile", title="Column profile", draw=ask)
