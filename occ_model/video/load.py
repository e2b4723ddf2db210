"""Open a film's file: frames in grey levels, read as they are needed, columns the scan axis."""

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import cv2
import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import ParameterError, VideoError, one_line, shown
from occ_model.photo.reading.scan_axis import SCAN_AXES, stripes_are_lines
from occ_model.results.video import Video, VideoFrame
from occ_model.scene.argument_checks import check_choice, check_count
from occ_model.video.containers import FIRST_BYTES, Container, container_of
from occ_model.video.opencv_source import OpenCvSource
from occ_model.video.pillow_source import PillowSource
from occ_model.video.source import FrameSource, StoredFrame

CHANNELS = ("luma", "red", "green", "blue")
"""The channels of a film; most files keep the luma of each pixel, but colours of 2 x 2 pixels."""


def load_video(path: str | Path, scan_axis: str = "auto", *, channel: str = "luma") -> "VideoFile":
    """Open a film.

    Its frames are read as they are needed; only the one at hand is kept.

    Parameters
    ----------
    path
        A file of one of the kinds in :mod:`occ_model.video.containers`.
    scan_axis
        ``"columns"`` or ``"lines"`` of the film, or ``"auto"``: found on the first frames, and used
        for all.
    channel
        ``"luma"``, ``"red"``, ``"green"`` or ``"blue"``.

    Raises
    ------
    VideoError
        There is no such file, it may not be read, or no frame in it can be.
    ParameterError
        ``scan_axis`` or ``channel`` is not one of these words.
    """
    check_choice("scan_axis", scan_axis, SCAN_AXES)
    check_choice("channel", channel, CHANNELS)
    try:
        file = Path(path)
    except TypeError:
        raise VideoError(
            f"{shown(path)} is not the path of a film; allowed: str or Path."
        ) from None
    return VideoFile(file, scan_axis, channel)


class VideoFile(Video):
    """A film in a file: see :func:`load_video`."""

    path: Path

    def __init__(self, path: Path, scan_axis: str, channel: str) -> None:
        self.path = path
        self.title = path.name
        self._channel = channel
        self._container = _container(path)
        self.time_step = self._container.time_step
        self._problem: str | None = None
        self._times: list[float] = []
        self._at_hand: tuple[Iterator[VideoFrame], VideoFrame] | None = None
        source = self._opened()
        try:
            self.frame_rate, self.frame_count = source.frame_rate, source.frame_count
            first = source.read()
        finally:
            source.close()
        if first is None:
            raise VideoError(f"{one_line(str(path))} cannot be read: it holds no frame.")
        grey = _grey(first, channel)
        self.turned = scan_axis == "lines" or (
            scan_axis == "auto" and stripes_are_lines(grey, lying=False)
        )
        """Whether the film's lines became the columns."""
        self.shape = grey.shape[::-1] if self.turned else grey.shape

    @property
    def problem(self) -> str | None:
        """A sentence if the film is damaged or ended early, as far as it has been read; or None."""
        return self._problem

    def frames(self, first: int = 0) -> Iterator[VideoFrame]:
        """Read the frames in order, from the one with the number ``first``."""
        check_count("first", first, 0)
        source = self._opened()
        try:
            index, start = 0, 0.0
            while (stored := source.read()) is not None:
                start = stored.time if index == 0 else start
                if index >= first:
                    yield VideoFrame(index, stored.time - start, self._image(stored))
                index += 1
        finally:
            source.close()
        if self.frame_count is not None and index < self.frame_count:
            self._problem = (
                f"The film ended early: it holds {index} of the {self.frame_count} frames that "
                "it states."
            )

    def frame(self, index: int) -> VideoFrame:
        """Read one frame."""
        check_count("index", index, 0)
        if self._at_hand is None or self._at_hand[1].index > index:
            self._at_hand = None
            run = self.frames(index)
        else:
            run, frame = self._at_hand
            if frame.index == index:
                return frame
        for frame in run:
            if frame.index == index:
                self._at_hand = run, frame
                return frame
        self._at_hand = None
        raise ParameterError(f"index is {index}; allowed: a frame of {self.title}, which has none.")

    def _image(self, stored: StoredFrame) -> ByteArray:
        """Return a frame's picture in grey levels, columns being the scan axis."""
        grey = _grey(stored, self._channel)
        return np.asarray(cv2.transpose(grey), np.uint8) if self.turned else grey

    def _opened(self) -> FrameSource:
        if self._container.reader == "pillow":
            return PillowSource(self.path)
        return OpenCvSource(self.path)


def _container(path: Path) -> Container:
    with suppress(OSError), path.open("rb") as file:
        return container_of(path, file.read(FIRST_BYTES))
    raise VideoError(f"{one_line(str(path))} cannot be read.")


def _grey(stored: StoredFrame, channel: str) -> ByteArray:
    """Take one channel of a frame."""
    pixels = stored.pixels
    if pixels.ndim == 2:
        return pixels
    if channel == "luma":
        return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY), np.uint8)
    return np.asarray(cv2.extractChannel(pixels, ("blue", "green", "red").index(channel)), np.uint8)
