"""What a film's file gives, whatever reads it: pictures with their times, in order."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from occ_model.arrays import ByteArray

CHANNELS = ("luma", "red", "green", "blue")  # most files keep luma in each pixel, colours in 2 x 2
MAX_PIXELS = 36_000_000  # largest frame that is read: 8K, if its codec's memory suffices


@dataclass(frozen=True, eq=False, slots=True)
class StoredFrame:
    time: float  # In seconds, as the container states it
    pixels: ByteArray  # Shape (lines, columns): one channel, upright


class FrameSource(ABC):
    """A film's file, opened: gives its frames in order, each once."""

    pixels: int = 0  # Pixels of a frame
    # As the container states them; None where it does not
    frame_rate: float | None = None
    frame_count: int | None = None

    @abstractmethod
    def __init__(self, path: Path, channel: str) -> None:
        """Open a file; raise a VideoError where there is no film in it, or too large a one."""

    @abstractmethod
    def read(self) -> StoredFrame | None:
        """Return the next frame, None after the last that can be decoded."""

    @abstractmethod
    def skip(self) -> bool:
        """Pass over the next frame; tell whether there was one."""

    def seek(self, index: int, time: float, within: float) -> StoredFrame | None:  # noqa: ARG002
        """Return a frame anywhere in the film, None where this source cannot find it surely."""
        return None

    @abstractmethod
    def close(self) -> None:
        """Free the file and the decoder."""


def one_channel(pixels: ByteArray, channel: str) -> ByteArray:
    """Take one channel of pixels of shape (lines, columns) or (lines, columns, 3): BGR."""
    if pixels.ndim == 2:
        return pixels
    if channel == "luma":
        return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY), np.uint8)
    return np.asarray(cv2.extractChannel(pixels, ("blue", "green", "red").index(channel)), np.uint8)


def too_large(width: float, height: float) -> str | None:
    """Say in a sentence's end that frames are too large, before any is decoded; None if not."""
    if 0 < width * height <= MAX_PIXELS:
        return None
    return (
        f"its frames have {width:,.0f} x {height:,.0f} pixels; allowed: from 1 to "
        f"{MAX_PIXELS / 1e6:g} million of them."
    )
