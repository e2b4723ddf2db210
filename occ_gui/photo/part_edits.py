"""What the user does to choose what of a photo is matched, as edits of the workspace."""

from dataclasses import replace

from PySide6.QtCore import QObject

from occ_gui.core.store import Store
from occ_gui.photo.photo_part import Part, lies_within, part_of
from occ_gui.shell.results import Board
from occ_gui.values.photo_choice import Asked
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp

_INSET = 4
"""A first rectangle leaves out one part of so many at each side of the photo."""


class PartEdits(QObject):
    """Chooses a lamp, a rectangle or all of the photo that is shown."""

    def __init__(self, store: Store, board: Board) -> None:
        super().__init__()
        self._store, self._board = store, board

    @property
    def part(self) -> Part:
        return part_of(self._store.workspace.photo, self._board.results)

    def find(self) -> None:
        workspace, opened = self._store.workspace, self._board.results.opened
        if opened is not None:
            photo = replace(workspace.photo, lamps_asked=Asked(opened.source))
            self._store.put(replace(workspace, photo=photo))

    def choose(self, index: int) -> None:
        lamps = self._board.results.lamps
        if 0 <= index < len(lamps):
            self._match(lamps[index])

    def draw(self, region: Region) -> None:
        """Match this rectangle, as far as it lies within the photo."""
        photo = self._board.results.photo
        if photo is None:
            return
        rows, columns = photo.image.shape
        clipped = Region(
            min(max(region.first_row, 0), rows - 1), max(min(region.last_row, rows), 1),
            min(max(region.first_column, 0), columns - 1), max(min(region.last_column, columns), 1),
        )  # fmt: skip
        self._match(clipped if lies_within(photo, clipped) else self.part)

    def set_by_hand(self, by_hand: bool) -> None:
        """Match a rectangle drawn by hand, first that of the chosen lamp, or the whole photo."""
        photo = self._board.results.photo
        if not by_hand or photo is None:
            self.match_whole()
            return
        rows, columns = photo.image.shape
        middle = Region(
            rows // _INSET, rows - rows // _INSET, columns // _INSET, columns - columns // _INSET
        )
        self.draw(self.part.region if isinstance(self.part, Lamp) else middle)

    def match_whole(self) -> None:
        self._match(None)

    def _match(self, part: Part) -> None:
        workspace, opened = self._store.workspace, self._board.results.opened
        if opened is not None:
            photo = workspace.photo.with_part(opened.frame, part)
            self._store.put(replace(workspace, photo=photo))
