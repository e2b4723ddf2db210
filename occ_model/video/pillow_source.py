"""Read animated GIF and PNG files by Pillow."""

from pathlib import Path

import numpy as np

from occ_model.errors import VideoError, one_line
from occ_model.video.source import FrameSource, StoredFrame

_MILLISECONDS = 1e3


class PillowSource(FrameSource):
    """The frames of an animated picture as Pillow decodes them.

    Raises
    ------
    VideoError
        It cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        from PIL import Image

        try:
            self._picture = Image.open(path, formats=("GIF", "PNG"))
            self.frame_count = getattr(self._picture, "n_frames", 1)
        except Exception:  # noqa: BLE001 - Pillow raises anything on damaged files
            raise VideoError(
                f"{one_line(str(path))} cannot be read: no film was found in it."
            ) from None
        self._next, self._time = 0, 0.0

    def read(self) -> StoredFrame | None:
        """Give the next frame, None after the last."""
        try:
            self._picture.seek(self._next)
            pixels = np.asarray(self._picture.convert("RGB"))[..., ::-1]
        except EOFError:
            return None
        except Exception:  # noqa: BLE001 - Pillow raises anything on damaged files
            return None
        frame = StoredFrame(self._time, pixels)
        self._time += self._picture.info.get("duration", 0) / _MILLISECONDS
        self._next += 1
        return frame

    def close(self) -> None:
        """Free the file and the decoder."""
        self._picture.close()
