"""The pane of the whole picture, declared."""

from typing import TYPE_CHECKING

from occ_gui.core.store import Store
from occ_gui.core.workspace import Workspace
from occ_gui.shell.feature import Feature, Pane
from occ_gui.shell.results import Results

if TYPE_CHECKING:
    from occ_gui.picture.pane import PicturePart


def picture(store: Store) -> "Feature[PicturePart]":
    """Declare the pane, which stands in the story in place of its rows."""

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
    )
