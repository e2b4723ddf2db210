"""Read films by OpenCV, whose package brings FFmpeg."""

from pathlib import Path

import cv2
import numpy as np

from occ_model.errors import VideoError, one_line
from occ_model.video.source import FrameSource, StoredFrame

_MILLISECONDS = 1e3


class OpenCvSource(FrameSource):
    """The frames of a film as OpenCV's FFmpeg decodes them.

    Raises
    ------
    VideoError
        It cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        # FFmpeg takes what begins with "/" or a drive's letter for a file, never for an address.
        self._capture = cv2.VideoCapture(str(path.resolve()), cv2.CAP_FFMPEG)
        if not self._capture.isOpened():
            raise VideoError(f"{one_line(str(path))} cannot be read: no film was found in it.")
        rate = self._capture.get(cv2.CAP_PROP_FPS)
        count = self._capture.get(cv2.CAP_PROP_FRAME_COUNT)
        self.frame_rate = rate if 0.0 < rate < 1e6 else None
        self.frame_count = int(count) if 0.0 < count < 1e9 else None

    def read(self) -> StoredFrame | None:
        """Give the next frame, None after the last."""
        found, pixels = self._capture.read()
        if not found or pixels is None:
            return None
        # After reading, this is the time of the frame that was read.
        time = self._capture.get(cv2.CAP_PROP_POS_MSEC) / _MILLISECONDS
        return StoredFrame(time, np.asarray(pixels, np.uint8))

    def close(self) -> None:
        """Free the file and the decoder."""
        self._capture.release()
