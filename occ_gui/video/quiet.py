"""Keep OpenCV from printing, because errors are reported in sentences."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import cv2

_FFMPEG = "OPENCV_FFMPEG_LOGLEVEL"  # read once, when FFmpeg is first used
_SILENT = 0  # OpenCV's level without any output


@contextmanager
def silence_opencv() -> Iterator[None]:
    logging: Any = cv2 if hasattr(cv2, "setLogLevel") else cv2.utils.logging  # OpenCV 4, and 5
    level = logging.getLogLevel()
    ffmpeg_level = os.environ.get(_FFMPEG)
    os.environ[_FFMPEG] = "-8"
    logging.setLogLevel(_SILENT)
    try:
        yield
    finally:
        logging.setLogLevel(level)
        if ffmpeg_level is None:
            os.environ.pop(_FFMPEG, None)
        else:
            os.environ[_FFMPEG] = ffmpeg_level
