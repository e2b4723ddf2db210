"""Controller of the lamps: find them in the background, and choose what of the photo is matched."""

from pathlib import Path
from typing import NamedTuple, Protocol, Self

from PySide6.QtCore import QObject, Signal

import occ_model as occ
from occ_gui.background.task import Report, Task
from occ_gui.photo.kept_photo import KeptRegion
from occ_model.errors import ParameterError
from occ_model.photo.reading.load import Photo
from occ_model.photo.reading.part import region_within
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp

_INSET = 4
"""A first rectangle leaves out one part of so many at each side of the photo."""


class LampPane(Protocol):
    """A pane that shows lamps."""

    def show_lamps(self, lamps: tuple[Lamp, ...], chosen: int | None) -> None:
        """Show these lamps, one of them chosen, in place of the previous ones."""


class _Frame(NamedTuple):
    """A photo as it is read: along the other axis, a rectangle of it is another."""

    path: Path
    shape: tuple[int, ...]
    turned: bool

    @classmethod
    def of(cls, photo: Photo) -> Self:
        return cls(photo.path, photo.image.shape, photo.turned)


def _find(photo: Photo, report: Report) -> tuple[Photo, tuple[Lamp, ...]]:
    return photo, occ.find_lamps(photo, report)  # imported with the first search


class LampController(QObject):
    """Finds the lamps of the open photo, and keeps what of it is matched.

    Parameters
    ----------
    panes
        The panes that show the lamps.
    """

    region_changed = Signal(object)
    """What is matched now: a Lamp, a Region drawn by hand, or None for the whole photo."""

    searching = Signal(bool)
    failed = Signal(str)

    def __init__(self, panes: tuple[LampPane, ...]) -> None:
        super().__init__()
        self._panes = panes
        self._photo: Photo | None = None
        self._kept: tuple[Path, Region] | None = None
        self._regions: dict[_Frame, Region] = {}
        self.lamps: tuple[Lamp, ...] = ()
        self.chosen: int | None = None
        self.by_hand: Region | None = None
        self.runner: Task[Photo, tuple[Photo, tuple[Lamp, ...]]] = Task(
            _find, "search for lamps", impatient=True
        )
        self.runner.finished.connect(self._take)
        self.runner.failed.connect(self._fail)

    @property
    def region(self) -> Lamp | Region | None:
        """What is matched: a lamp, a rectangle drawn by hand, or None for the whole photo."""
        return self.by_hand if self.chosen is None else self.lamps[self.chosen]

    @property
    def rectangle(self) -> Region | None:
        """The rectangle of what is matched, which a session keeps; None for the whole photo."""
        return self.by_hand if self.chosen is None else self.lamps[self.chosen].region

    def keep(self, path: Path, region: Region) -> None:
        """Match this rectangle of a photo when it is opened next, if the photo still has it."""
        self._kept = path, region

    def kept(self) -> KeptRegion:
        """Return the lamps, and what is matched, to be given back with the photo."""
        return KeptRegion(self.lamps, self.chosen, self.by_hand)

    def give_back(self, kept: KeptRegion) -> None:
        """Show these lamps again, and match what was matched."""
        self.lamps, self.chosen, self.by_hand = kept.lamps, kept.chosen, kept.by_hand
        self._show()

    def show_photo(self, photo: Photo | None) -> None:
        """Search this photo in place of the previous one, or none."""
        self._photo = photo
        if not self.runner.is_idle:
            self.runner.cancel()
            self.searching.emit(False)
        if photo is None:
            self._regions.clear()
        kept = None if photo is None else self._regions.get(_Frame.of(photo))
        if photo is not None and self._kept is not None:
            kept = self._kept[1] if self._kept[0] == photo.path else kept
            self._kept = None
        self.lamps, self.chosen, self.by_hand = (), None, None
        if photo is not None and kept is not None and _lies_within(photo, kept):
            self.by_hand = kept
        self._show()

    def find(self) -> None:
        """Find the lamps of the open photo."""
        if self._photo is not None:
            self.searching.emit(True)
            self.runner.ask(self._photo)

    def choose(self, index: int) -> None:
        """Match this lamp."""
        if 0 <= index < len(self.lamps):
            self.chosen, self.by_hand = index, None
            self._show()

    def draw(self, region: Region) -> None:
        """Match this rectangle, as far as it lies within the photo."""
        if self._photo is None:
            return
        rows, columns = self._photo.image.shape
        clipped = Region(
            min(max(region.first_row, 0), rows - 1), max(min(region.last_row, rows), 1),
            min(max(region.first_column, 0), columns - 1), max(min(region.last_column, columns), 1),
        )  # fmt: skip
        if _lies_within(self._photo, clipped):
            self.chosen, self.by_hand = None, clipped
        self._show()

    def set_by_hand(self, by_hand: bool) -> None:
        """Match a rectangle drawn by hand, first that of the chosen lamp, or the whole photo."""
        if not by_hand or self._photo is None:
            self.match_whole()
            return
        rows, columns = self._photo.image.shape
        middle = Region(
            rows // _INSET, rows - rows // _INSET, columns // _INSET, columns - columns // _INSET
        )
        self.draw(middle if self.chosen is None else self.lamps[self.chosen].region)

    def match_whole(self) -> None:
        """Match the whole photo."""
        self.chosen = self.by_hand = None
        self._show()

    def _take(self, found: tuple[Photo, tuple[Lamp, ...]]) -> None:
        photo, lamps = found
        self.searching.emit(False)
        if photo is self._photo:
            self.lamps, self.chosen = lamps, None
            self._show()

    def _fail(self, sentence: str) -> None:
        self.searching.emit(False)
        self.failed.emit(sentence)

    def _show(self) -> None:
        if self._photo is not None:
            self._remember(_Frame.of(self._photo))
        for pane in self._panes:
            pane.show_lamps(self.lamps, self.chosen)
        self.region_changed.emit(self.region)

    def _remember(self, frame: "_Frame") -> None:
        """Keep what is matched with its photo: a row of the table opens with it again."""
        if self.rectangle is None:
            self._regions.pop(frame, None)
        else:
            self._regions[frame] = self.rectangle

    def stop(self) -> None:
        """Stop the search."""
        self.runner.stop()


def _lies_within(photo: Photo, region: Region) -> bool:
    try:
        region_within(photo, region)
    except ParameterError:
        return False
    return True
