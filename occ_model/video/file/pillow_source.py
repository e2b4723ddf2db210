"""Animated GIF and PNG pictures as films, read by Pillow: FFmpeg rounds the times of PNG files."""

import warnings
from pathlib import Path

import numpy as np

from occ_model.arrays import Samples
from occ_model.errors import VideoError
from occ_model.video.file.source import (
    FilmFacts,
    FrameSource,
    StoredFrame,
    explain_too_large,
    extract_channel,
)

_MILLISECONDS = 1e3
_GIF_RESOLUTION = 1e-2  # seconds


class PillowSource(FrameSource):
    """The frames of an animated picture, with transparent parts black."""

    def __init__(self, path: Path, channel: str) -> None:
        from PIL import Image

        warnings.simplefilter("ignore")  # warnings about sizes, which are checked here
        Image.MAX_IMAGE_PIXELS = None
        self._channel = channel
        try:
            self._picture = Image.open(path, formats=("GIF", "PNG"))
            width, height = self._picture.size
            problem, self.pixels = explain_too_large(width, height), width * height
            # A PNG file may hold another picture for programs that show no animations.
            self._next = int(getattr(self._picture, "default_image", False))
            count = 0 if problem else int(getattr(self._picture, "n_frames", 1)) - self._next
            self._picture.seek(self._next)
        except Exception:  # noqa: BLE001 - Pillow raises anything on damaged files
            raise VideoError("no film was found in it.") from None
        if problem:
            raise VideoError(problem)
        self._time = 0.0
        duration = float(self._picture.info.get("duration", 0.0))
        self.facts = FilmFacts(
            _MILLISECONDS / duration if duration > 0.0 else None,
            count,
            resolution=_GIF_RESOLUTION if self._picture.format == "GIF" else 0.0,
        )

    def read(self) -> StoredFrame | None:
        try:
            self._picture.seek(self._next)
            pixels = extract_channel(self._read_pixels(), self._channel)
        except Exception:  # noqa: BLE001 - Pillow raises anything on damaged files, EOFError at the end
            return None
        frame = StoredFrame(self._time, pixels)
        self._advance()
        return frame

    def _read_pixels(self) -> Samples:
        mode = self._picture.mode
        if mode.startswith("I;16"):
            return np.asarray(self._picture).astype(np.uint16)
        if mode in ("1", "L"):
            return np.asarray(self._picture.convert("L"))
        pixels = np.asarray(self._picture.convert("RGBA"))
        lit = pixels[..., 2::-1].astype(np.uint16) * pixels[..., 3:]
        return np.asarray((lit + 127) // 255, np.uint8)

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
