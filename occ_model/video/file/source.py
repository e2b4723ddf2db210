"""A film's file as a sequence of pictures with times, independent of the library that reads it."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from occ_model.arrays import Samples

CHANNELS = ("luma", "red", "green", "blue", "colours")  # mostly stored for 2 x 2 pixels
MAX_PIXELS = 36_000_000  # largest frame to be read: 8K, if its codec's memory suffices
_BYTES_A_PIXEL_LEFT = 12  # memory that a decoder needs to continue: four coloured frames


@dataclass(frozen=True, eq=False, slots=True)
class StoredFrame:
    """A decoded frame, or a field of an interlaced film."""

    time: float  # In seconds of the recording, as the file states it
    pixels: Samples  # Shape (lines, columns) or (..., 3), upright; the largest number is white
    first_line: float = 0.0  # Place of its first line, in its lines from the film's first line


@dataclass(frozen=True, slots=True)
class FilmFacts:
    """What a file states of its film, None if nothing; times and rates are of the recording."""

    frame_rate: float | None = None
    frame_count: int | None = None
    duration: float | None = None  # From the first picture to the end of the last one, in seconds
    resolution: float = 0.0  # Step in seconds to which times are rounded; 0 if they are exact
    slowdown: float = 1.0  # How many times slower it plays than it was recorded
    field_axis: int | None = None  # Axis along which each frame, a field, has every other line


class FrameSource(ABC):
    """An open film's file, which returns its frames in order, each once."""

    pixels: int  # Pixels of a frame
    facts: FilmFacts
    damaged = 0  # Parts that could not be decoded, or not completely

    @abstractmethod
    def read(self) -> StoredFrame | None:
        """Return the next frame; None after the last one that can be decoded."""

    @abstractmethod
    def skip(self) -> bool:
        """Skip the next frame; return whether there was one."""

    def seek(self, index: int) -> int | None:  # noqa: ARG002
        """Go to a frame, or somewhat before it; return the next frame's number, None if unknown."""
        return None

    @abstractmethod
    def close(self) -> None:
        """Release the file and the decoder."""


def check_memory(pixels: int) -> None:
    """Raise MemoryError without memory for a few more frames, which FFmpeg does not state."""
    np.empty(_BYTES_A_PIXEL_LEFT * pixels, np.uint8)


def extract_channel(pixels: Any, channel: str) -> Samples:
    """Extract a channel, or all in RGB, of pixels of shape (lines, columns) or (..., 3) in BGR."""
    if pixels.ndim == 2:
        return np.asarray(pixels)
    if channel == "luma":
        return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY))
    if channel == "colours":
        return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGR2RGB))
    return np.asarray(cv2.extractChannel(pixels, ("blue", "green", "red").index(channel)))


def explain_too_large(width: float, height: float) -> str | None:
    """Explain, as the end of a sentence, why frames are too large; None if they are not."""
    if 0 < width * height <= MAX_PIXELS:
        return None
    return (
        f"its frames have {width:,.0f} x {height:,.0f} pixels; allowed: from 1 to "
        f"{MAX_PIXELS / 1e6:g} million of them."
    )
