"""Sources of live frames: a camera, or a film in its place."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from time import monotonic, sleep
from typing import Protocol

from occ_model.arrays import ByteArray
from occ_model.results.video import VideoFrame


@dataclass(frozen=True, eq=False, slots=True)
class LivePicture:
    time: float  # seconds since the source was opened
    # Shape (lines, pixels) or (lines, pixels, 3): Grey, or blue, green and red
    pixels: ByteArray


class FrameSource(Protocol):
    """What gives pictures one after the other; used by one thread at a time."""

    title: str

    axis: str
    """What of its pictures the rolling shutter usually scans: ``"lines"`` or ``"columns"``."""

    def open(self) -> None: ...

    def read(self) -> LivePicture | None:
        """Wait for the next picture; None where there are no more, as of a camera unplugged."""

    def lock_exposure(self, on: bool) -> bool:
        """Hold the exposure, or let the source choose it; False where it does not know how to."""

    def close(self) -> None:
        """End filming; a source that is not open stays so."""


class FilmSource:
    """The frames of a film at their own times, in place of a camera.

    ``frames``: the frames; they are gone through anew each time that the source is opened.
    ``in_real_time``: whether each frame comes at its own time, else as soon as it is asked for.
    """

    def __init__(
        self, frames: Iterable[VideoFrame], title: str, *, in_real_time: bool = True
    ) -> None:
        self.title, self.axis = title, "columns"
        self._frames, self._in_real_time = frames, in_real_time
        self._left: Iterator[VideoFrame] | None = None
        self._began = 0.0
        self.is_locked = False

    def open(self) -> None:
        self._left, self._began = iter(self._frames), monotonic()

    def read(self) -> LivePicture | None:
        frame = None if self._left is None else next(self._left, None)
        if frame is None:
            return None
        if self._in_real_time:
            sleep(max(0.0, self._began + frame.time - monotonic()))
        return LivePicture(frame.time, frame.image)

    def lock_exposure(self, on: bool) -> bool:
        self.is_locked = on
        return True

    def close(self) -> None:
        self._left = None
