"""Read films by OpenCV, whose package brings FFmpeg."""

import math
from pathlib import Path

import cv2
import numpy as np

from occ_model.errors import VideoError
from occ_model.video.file.source import FrameSource, StoredFrame, one_channel, too_large

_MILLISECONDS = 1e3
_MAX_FRAMES, _FASTEST = 1e9, 1e6
_THREADS = 2
"""Threads of FFmpeg. With one for each of many processors, each keeping frames, films of 4K would
take more memory than the process may have."""


class OpenCvSource(FrameSource):
    """The frames of a film as OpenCV's FFmpeg decodes them, turned upright."""

    def __init__(self, path: Path, channel: str) -> None:
        self._channel = channel
        # FFmpeg takes what begins with "/" or a drive's letter for a file, never for an address.
        self._capture = cv2.VideoCapture(
            str(path.resolve()), cv2.CAP_FFMPEG, (cv2.CAP_PROP_N_THREADS, _THREADS)
        )
        if not self._capture.isOpened():
            raise VideoError("no film was found in it.")
        width = self._capture.get(cv2.CAP_PROP_FRAME_WIDTH)
        height = self._capture.get(cv2.CAP_PROP_FRAME_HEIGHT)
        problem = too_large(width, height)
        if problem:
            raise VideoError(problem)
        self.pixels = int(width * height)
        rate = self._capture.get(cv2.CAP_PROP_FPS)
        count = self._capture.get(cv2.CAP_PROP_FRAME_COUNT)
        self.frame_rate = rate if 0.0 < rate < _FASTEST else None
        self.frame_count = round(count) if 0.0 < count < _MAX_FRAMES else None

    def read(self) -> StoredFrame | None:
        found, pixels = self._capture.read()
        if not found or pixels is None:
            return None
        return StoredFrame(self._time(), one_channel(np.asarray(pixels, np.uint8), self._channel))

    def skip(self) -> bool:
        """Pass over the next frame; tell whether there was one."""
        return bool(self._capture.grab())

    def seek(self, index: int, time: float, within: float) -> StoredFrame | None:
        """Return a frame anywhere in the film, None where it has another time than was stated."""
        # OpenCV counts frames by their times, which fails where they are not equally far apart.
        if not self._capture.set(cv2.CAP_PROP_POS_FRAMES, index):
            return None
        frame = self.read()
        return frame if frame is not None and abs(frame.time - time) < within else None

    def close(self) -> None:
        self._capture.release()

    def _time(self) -> float:
        time = self._capture.get(cv2.CAP_PROP_POS_MSEC) / _MILLISECONDS
        return time if math.isfinite(time) else 0.0
