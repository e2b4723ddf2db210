"""A film's file as a sequence of pictures with times, independent of the library that reads it."""

import math
import warnings
from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import VideoError

CHANNELS = ("luma", "red", "green", "blue")  # files mostly store colours for 2 x 2 pixels
MAX_PIXELS = 36_000_000  # largest frame to be read: 8K, if its codec's memory suffices

_MILLISECONDS = 1e3
_MAX_FRAMES, _MAX_FRAME_RATE = 1e9, 1e6
_THREADS = 2
"""Threads of FFmpeg. Each keeps frames: for 4K films, one for each of many processors would take
more memory than the process may use."""


@dataclass(frozen=True, eq=False, slots=True)
class StoredFrame:
    time: float  # In seconds, as stated by the container
    pixels: ByteArray  # Shape (lines, columns): one channel, upright


class FrameSource(ABC):
    """An open film's file, which returns its frames in order, each once."""

    pixels: int = 0  # Pixels of a frame
    # As stated by the container; None if it does not state them
    frame_rate: float | None = None
    frame_count: int | None = None

    @abstractmethod
    def __init__(self, path: Path, channel: str) -> None:
        """Open a file; raise VideoError if it contains no film, or one that is too large."""

    @abstractmethod
    def read(self) -> StoredFrame | None:
        """Return the next frame; None after the last one that can be decoded."""

    @abstractmethod
    def skip(self) -> bool:
        """Skip the next frame; return whether there was one."""

    def seek(self, index: int, time: float, within: float) -> StoredFrame | None:  # noqa: ARG002
        """Return any frame of the film; None if this source cannot find it reliably."""
        return None

    @abstractmethod
    def close(self) -> None:
        """Release the file and the decoder."""


def extract_channel(pixels: ByteArray, channel: str) -> ByteArray:
    """Extract one channel of pixels of shape (lines, columns) or (lines, columns, 3) in BGR."""
    if pixels.ndim == 2:
        return pixels
    if channel == "luma":
        return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY), np.uint8)
    return np.asarray(cv2.extractChannel(pixels, ("blue", "green", "red").index(channel)), np.uint8)


def explain_too_large(width: float, height: float) -> str | None:
    """Explain, as the end of a sentence, why frames are too large; None if they are not."""
    if 0 < width * height <= MAX_PIXELS:
        return None
    return (
        f"its frames have {width:,.0f} x {height:,.0f} pixels; allowed: from 1 to "
        f"{MAX_PIXELS / 1e6:g} million of them."
    )


class OpenCvSource(FrameSource):
    """The frames of a film as decoded by OpenCV's FFmpeg, turned upright."""

    def __init__(self, path: Path, channel: str) -> None:
        self._channel = channel
        # FFmpeg takes a path that starts with "/" or a drive's letter for a file, never for a URL.
        self._capture = cv2.VideoCapture(
            str(path.resolve()), cv2.CAP_FFMPEG, (cv2.CAP_PROP_N_THREADS, _THREADS)
        )
        if not self._capture.isOpened():
            raise VideoError("no film was found in it.")
        width = self._capture.get(cv2.CAP_PROP_FRAME_WIDTH)
        height = self._capture.get(cv2.CAP_PROP_FRAME_HEIGHT)
        problem = explain_too_large(width, height)
        if problem:
            raise VideoError(problem)
        self.pixels = int(width * height)
        rate = self._capture.get(cv2.CAP_PROP_FPS)
        count = self._capture.get(cv2.CAP_PROP_FRAME_COUNT)
        self.frame_rate = rate if 0.0 < rate < _MAX_FRAME_RATE else None
        self.frame_count = round(count) if 0.0 < count < _MAX_FRAMES else None

    def read(self) -> StoredFrame | None:
        is_read, pixels = self._capture.read()
        if not is_read or pixels is None:
            return None
        time = self._capture.get(cv2.CAP_PROP_POS_MSEC) / _MILLISECONDS
        channel = extract_channel(np.asarray(pixels, np.uint8), self._channel)
        return StoredFrame(time if math.isfinite(time) else 0.0, channel)

    def skip(self) -> bool:
        return bool(self._capture.grab())

    def seek(self, index: int, time: float, within: float) -> StoredFrame | None:
        """Return any frame of the film; None if its time differs from the stated one."""
        # OpenCV numbers frames by their times, which fails if they are not equally spaced.
        if not self._capture.set(cv2.CAP_PROP_POS_FRAMES, index):
            return None
        frame = self.read()
        return frame if frame is not None and abs(frame.time - time) < within else None

    def close(self) -> None:
        self._capture.release()


class PillowSource(FrameSource):
    """The frames of an animated picture as decoded by Pillow, with transparent parts black."""

    def __init__(self, path: Path, channel: str) -> None:
        from PIL import Image

        warnings.simplefilter("ignore")  # warnings about sizes, which are checked here
        Image.MAX_IMAGE_PIXELS = None
        self._channel = channel
        try:
            self._picture = Image.open(path, formats=("GIF", "PNG"))
            width, height = self._picture.size
            problem, self.pixels = explain_too_large(width, height), width * height
            if problem is None:
                self.frame_count = int(getattr(self._picture, "n_frames", 1))
        except Exception:  # noqa: BLE001 - Pillow raises anything on damaged files
            raise VideoError("no film was found in it.") from None
        if problem:
            raise VideoError(problem)
        duration = float(self._picture.info.get("duration", 0.0))
        self.frame_rate = _MILLISECONDS / duration if duration > 0.0 else None
        self._next, self._time = 0, 0.0

    def read(self) -> StoredFrame | None:
        try:
            self._picture.seek(self._next)
            is_grey = self._picture.mode in ("1", "L")
            pixels = np.asarray(self._picture.convert("L" if is_grey else "RGBA"))
        except Exception:  # noqa: BLE001 - Pillow raises anything on damaged files, EOFError at the end
            return None
        if pixels.ndim == 3:
            lit = pixels[..., 2::-1].astype(np.uint16) * pixels[..., 3:]
            pixels = np.asarray((lit + 127) // 255, np.uint8)
        frame = StoredFrame(self._time, extract_channel(pixels, self._channel))
        self._advance()
        return frame

    def skip(self) -> bool:
        try:
            self._picture.seek(self._next)
        except Exception:  # noqa: BLE001 - as above
            return False
        self._advance()
        return True

    def close(self) -> None:
        self._picture.close()

    def _advance(self) -> None:
        self._time += float(self._picture.info.get("duration", 0.0)) / _MILLISECONDS
        self._next += 1
