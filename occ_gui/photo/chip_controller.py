"""Controller of the chips: read them from the open photo in the background."""

from dataclasses import dataclass
from typing import Protocol

from PySide6.QtCore import QObject

import occ_model as occ
from occ_gui.background.task import Task
from occ_model.errors import MatchError
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import ChipReading


class ChipPane(Protocol):
    """A pane that shows the chips of a photo."""

    def show_chips(self, reading: ChipReading | None) -> None:
        """Show these chips in place of the previous ones, or none."""


Request = tuple[Photo, Lamp | Region | None]
"""A photo, and the part of it that is read; None for all of it."""


@dataclass(frozen=True, eq=False, slots=True)
class ReadPhoto:
    """The chips of a photo, None where none can be read."""

    request: Request
    reading: ChipReading | None


def read(request: Request) -> ReadPhoto:
    """Read the chips of a photo, or of a part of it."""
    try:
        return ReadPhoto(request, occ.read_chips(*request))  # imported with the first photo
    except MatchError:
        return ReadPhoto(request, None)


class ChipController(QObject):
    """Reads the chips of each photo that is opened, and of each part of it that is chosen.

    Parameters
    ----------
    pane
        The pane that shows them.
    """

    def __init__(self, pane: ChipPane) -> None:
        super().__init__()
        self._pane = pane
        self._wanted: Request | None = None
        self.runner: Task[Request, ReadPhoto] = Task(
            lambda request, _: read(request), "reading of chips"
        )
        self.runner.finished.connect(self._take)
        self.runner.failed.connect(self._show_none)

    def show_photo(self, photo: Photo | None) -> None:
        """Read the chips of this photo; those of the previous one are put away."""
        self._read(None if photo is None else (photo, None))

    def set_region(self, region: Lamp | Region | None) -> None:
        """Read the chips of this lamp or rectangle from now on, or of the whole photo."""
        if self._wanted is not None and self._wanted[1] != region:
            self._read((self._wanted[0], region))

    def _read(self, request: Request | None) -> None:
        self._wanted = request
        self._pane.show_chips(None)
        if request is not None:
            self.runner.ask(request)

    def _take(self, found: ReadPhoto) -> None:
        if found.request is self._wanted:  # not of one that was closed meanwhile
            self._pane.show_chips(found.reading)

    def _show_none(self, _sentence: str) -> None:
        self._pane.show_chips(None)

    def stop(self) -> None:
        """Stop reading."""
        self.runner.stop()
