"""Read animated GIF and PNG files by Pillow."""

import warnings
from pathlib import Path

import numpy as np

from occ_model.errors import VideoError
from occ_model.video.file.source import FrameSource, StoredFrame, one_channel, too_large

_MILLISECONDS = 1e3


class PillowSource(FrameSource):
    """The frames of an animated picture as Pillow decodes them, transparent parts black."""

    def __init__(self, path: Path, channel: str) -> None:
        from PIL import Image

        warnings.simplefilter("ignore")  # about sizes, which are checked here
        Image.MAX_IMAGE_PIXELS = None
        self._channel = channel
        try:
            self._picture = Image.open(path, formats=("GIF", "PNG"))
            width, height = self._picture.size
            problem, self.pixels = too_large(width, height), width * height
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
            shown = self._picture.convert("RGBA") if self._has_colours() else self._picture
            pixels = np.asarray(shown.convert("L") if shown is self._picture else shown)
        except Exception:  # noqa: BLE001 - Pillow raises anything on damaged files, EOFError at the end
            return None
        if pixels.ndim == 3:
            lit = pixels[..., 2::-1].astype(np.uint16) * pixels[..., 3:]
            pixels = np.asarray((lit + 127) // 255, np.uint8)
        frame = StoredFrame(self._time, one_channel(pixels, self._channel))
        self._passed()
        return frame

    def skip(self) -> bool:
        """Pass over the next frame; tell whether there was one."""
        try:
            self._picture.seek(self._next)
        except Exception:  # noqa: BLE001 - as above
            return False
        self._passed()
        return True

    def close(self) -> None:
        self._picture.close()

    def _has_colours(self) -> bool:
        return self._picture.mode not in ("1", "L")

    def _passed(self) -> None:
        self._time += float(self._picture.info.get("duration", 0.0)) / _MILLISECONDS
        self._next += 1
