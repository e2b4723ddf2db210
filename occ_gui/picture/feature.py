"""The pane of the whole picture, declared."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.picture.figures import picture_figures
from occ_gui.shell.feature import Feature, Pane
from occ_gui.shell.results import Results

if TYPE_CHECKING:
    from occ_gui.picture.pane import PicturePart


def picture(store: Store, about_photo: Callable[[], str]) -> "Feature[PicturePart]":
    """Declare the pane, which stands in the story in place of its rows.

    ``about_photo`` gives what stands under a figure with the photo.
    """

    def make() -> "Pane[PicturePart]":
        from occ_gui.picture.pane import PicturesPane

        return PicturesPane(store)

    def part(workspace: Workspace, results: Results) -> "PicturePart":
        there = (results.picture, results.snapshot, results.reading, results.before)
        return (*there, workspace.whose, workspace.overlay)

    return Feature(
        name="picture",
        title="Picture",
        help="guide.md#look-at-the-picture",
        make=make,
        part=part,
        goes_on_hidden=True,
        figures=picture_figures(store, about_photo),
    )
