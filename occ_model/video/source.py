"""What a film's file gives, whatever reads it: pictures with their times, in order."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from occ_model.arrays import ByteArray


@dataclass(frozen=True, eq=False, slots=True)
class StoredFrame:
    """A frame as its file has it.

    Parameters
    ----------
    time
        In seconds, as the container states it.
    pixels : ndarray of uint8, shape (lines, columns) or (lines, columns, 3)
        Upright; grey, or blue, green and red.
    """

    time: float
    pixels: ByteArray


class FrameSource(ABC):
    """A film's file, opened: gives its frames in order, each once."""

    frame_rate: float | None = None
    frame_count: int | None = None

    @abstractmethod
    def read(self) -> StoredFrame | None:
        """Give the next frame, None after the last that can be decoded."""

    @abstractmethod
    def close(self) -> None:
        """Free the file and the decoder."""
