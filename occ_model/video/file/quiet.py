"""Keep OpenCV and its FFmpeg from printing: what they find wrong is said in sentences."""

import os
from collections.abc import Iterator
from contextlib import contextmanager

import cv2

_FFMPEG = "OPENCV_FFMPEG_LOGLEVEL"
"""Looked at once, when FFmpeg is used first."""


@contextmanager
def quiet_opencv() -> Iterator[None]:
    """Let OpenCV print nothing."""
    log = getattr(getattr(cv2, "utils", None), "logging", None)
    level = None if log is None else log.getLogLevel()
    stated = os.environ.get(_FFMPEG)
    os.environ[_FFMPEG] = "-8"
    if log is not None:
        log.setLogLevel(log.LOG_LEVEL_SILENT)
    try:
        yield
    finally:
        if log is not None:
            log.setLogLevel(level)
        if stated is None:
            os.environ.pop(_FFMPEG, None)
        else:
            os.environ[_FFMPEG] = stated
