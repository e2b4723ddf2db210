"""Figure of the column profile: the columns in view, with a photo's profile if there is one."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.shell.figures import Draw, Figure
from occ_gui.shell.results import Board
from occ_gui.simulation.snapshot import Snapshot

if TYPE_CHECKING:
    from occ_gui.profile.pane import ProfilePane
    from occ_model.figures.drawing import Drawing


def profile_figure(store: Store, board: Board, about_photo: Callable[[], str]) -> Figure:
    """Declare the figure; ``about_photo`` gives what stands under the profile of the photo."""

    def ask(pane: "ProfilePane | None", shown: Snapshot) -> Draw:
        workspace, photo = store.workspace, board.results.photo_profile
        comparison = None if photo is None else photo.comparison
        about = "" if comparison is None else about_photo()
        whole = (0, len(shown.profile))
        columns = slice(*(whole if pane is None else pane.view.columns_in_view()))
        enhanced = workspace.is_enhanced
        band = shown.enhanced_band if enhanced else shown.band
        decoded = shown.result_of(workspace.decoder)

        def draw() -> "Drawing":
            from occ_model.figures.window_panes import profile_drawing

            return profile_drawing(
                shown.frame, band, shown.band_undefined, comparison, columns,
                enhanced=enhanced, decoded=decoded, about=about,
            )  # fmt: skip

        return draw

    return Figure(name="profile", title="Column profile", draw=ask)
