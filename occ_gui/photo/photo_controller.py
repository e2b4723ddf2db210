"""Controller of the open photo: read it in the background, and show it on the panes."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

from PySide6.QtCore import QObject, Signal

import occ_model as occ
from occ_gui.background.task import Report, Task
from occ_model.photo.reading.load import CHANNELS, Photo
from occ_model.photo.reading.scan_axis import SCAN_AXES


class PhotoPane(Protocol):
    """A pane that shows a photo."""

    def show_photo(self, photo: Photo | None) -> None:
        """Show this photo in place of the previous one, or none."""


@dataclass(frozen=True, slots=True)
class PhotoReading:
    """Options of reading a photo.

    Parameters
    ----------
    scan_axis
        The axis of the file that the shutter scanned, one of SCAN_AXES.
    channel
        The channel of a coloured photo that is read, one of CHANNELS.
    """

    scan_axis: str = SCAN_AXES[0]
    channel: str = CHANNELS[0]


def _read(request: tuple[Path, PhotoReading], report: Report) -> Photo:
    report(0.0)
    path, reading = request
    return occ.load_photo(path, reading.scan_axis, channel=reading.channel, progress=report)


class PhotoController(QObject):
    """Opens and closes photos, and reads them again along another axis or in another channel."""

    opened = Signal(object)
    """The photo that the panes show now, or None."""

    another_read = Signal()
    """Another photo than the one on the panes has been read from its file; it is shown next."""

    failed = Signal(str)
    """Why a photo could not be read; the previous one stays."""

    begun = Signal()
    """A photo is being read."""

    progressed = Signal(float)
    """The fraction of the reading that is done, from 0 to 1."""

    ended = Signal()
    """Reading has ended: the photo is shown, could not be read, or was cancelled."""

    reading_changed = Signal(object)
    """The new options of reading: a PhotoReading."""

    def __init__(self) -> None:
        super().__init__()
        self._panes: Sequence[PhotoPane] = ()
        self._wanted: Path | None = None
        self.photo: Photo | None = None
        """The photo that is shown, None if none is open."""
        self.reading = PhotoReading()
        self.runner: Task[tuple[Path, PhotoReading], Photo] = Task(
            _read, "reading of the photo", impatient=True
        )
        self.runner.reported.connect(self.progressed.emit)
        self.runner.finished.connect(self._show)
        self.runner.failed.connect(self._fail)

    def show_on(self, panes: Sequence[PhotoPane]) -> None:
        """Show photos on these panes from now on, which are there before the first one is."""
        self._panes = panes

    @property
    def path(self) -> Path | None:
        """The path of the photo that is shown, None if none is open."""
        return None if self.photo is None else self.photo.path

    @property
    def awaited(self) -> Path | None:
        """The path of the photo that is being read, None if none is."""
        return self._wanted if not self.runner.is_idle else None

    def open(self, path: Path) -> None:
        """Read a photo and show it."""
        self._wanted = path
        self.runner.ask((path, self.reading))
        self.begun.emit()

    def cancel(self) -> None:
        """Cancel the reading; the previous photo stays."""
        if not self.runner.is_idle:
            self.runner.cancel()
            self._wanted = self.path
            self.ended.emit()

    def scan_along(self, scan_axis: str) -> None:
        """Set the axis of the file that the shutter scanned, and read the open photo again."""
        self._read_as(replace(self.reading, scan_axis=scan_axis))

    def take_channel(self, channel: str) -> None:
        """Set the channel, and read the open photo again."""
        self._read_as(replace(self.reading, channel=channel))

    def _read_as(self, reading: PhotoReading) -> None:
        self.reading = reading
        self.reading_changed.emit(reading)
        if self._wanted is not None:
            self.open(self._wanted)

    def close(self) -> None:
        """Close the photo."""
        self.cancel()
        self._wanted = None
        self._show_on_panes(None)

    def show_again(self, photo: Photo, reading: PhotoReading) -> None:
        """Show a photo that has been read before, in these options."""
        self.cancel()
        self.reading, self._wanted = reading, photo.path
        self.reading_changed.emit(reading)
        self._show_on_panes(photo)

    def _show(self, photo: Photo) -> None:
        self.ended.emit()
        if self.photo is None or photo.path != self.photo.path:
            self.another_read.emit()
        self._show_on_panes(photo)

    def _fail(self, sentence: str) -> None:
        self.ended.emit()
        self._wanted = self.path
        self.failed.emit(sentence)

    def _show_on_panes(self, photo: Photo | None) -> None:
        self.photo = photo
        for pane in self._panes:
            pane.show_photo(photo)
        self.opened.emit(photo)

    def stop(self) -> None:
        """Stop reading."""
        self.runner.stop()
