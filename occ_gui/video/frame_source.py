"""Sources of live frames, such as a camera."""

from dataclasses import dataclass
from typing import Protocol

from occ_model.arrays import ByteArray


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
