"""The cameras of this computer, and the pictures of a live source."""

import platform
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import monotonic
from typing import Any, Protocol

import cv2
import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import VideoError, one_line

AXES = ("lines", "columns")
"""Axes of a source's pictures that the rolling shutter scans, the usual one first."""

_DEVICES = Path("/sys/class/video4linux")

IS_LINUX = platform.system() == "Linux"

_MOST_TRIED = 4  # cameras that are tried one by one if the system does not list them

_WIDTH, _HEIGHT = 1920, 1080
_MANUAL, _AUTOMATIC = 0.25, 0.75
_V4L_MANUAL, _V4L_AUTOMATIC = 1.0, 3.0
"""Numbers of the exposure modes in OpenCV's back ends; Video4Linux has its own numbers."""


@dataclass(frozen=True, eq=False, slots=True)
class LivePicture:
    time: float  # seconds since the source was opened
    # Shape (lines, pixels) in grey, or (lines, pixels, 3) in blue, green and red
    pixels: ByteArray


class CameraDriver(Protocol):
    """A source of successive pictures; used by one thread at a time."""

    title: str

    axis: str  # axis that the rolling shutter usually scans: ``"lines"`` or ``"columns"``

    def open(self) -> None: ...

    def read(self) -> LivePicture | None:
        """Wait for the next picture; None if there are no more, as when a camera is unplugged."""

    def lock_exposure(self, on: bool) -> bool:
        """Lock the exposure, or let the source choose it; return False if this is not possible."""

    def close(self) -> None:
        """Close the source, if it is open."""


@dataclass(frozen=True, slots=True)
class CameraDevice:
    number: int  # OpenCV's number for it
    name: str


def find_cameras(devices: Path = _DEVICES) -> tuple[CameraDevice, ...]:
    """List the cameras; if the system has no list, try to open the first few."""
    return tuple(_list_devices(devices) if IS_LINUX else _probe_devices())


def _list_devices(devices: Path) -> Iterator[CameraDevice]:
    """List the capture devices: the first node of each camera."""
    names = (folder.name.removeprefix("video") for folder in devices.glob("video*"))
    for number in sorted(int(name) for name in names if name.isascii() and name.isdigit()):
        folder = devices / f"video{number}"
        if _read_text(folder / "index") in ("", "0"):
            yield CameraDevice(number, _read_text(folder / "name") or f"/dev/video{number}")


def _read_text(file: Path) -> str:
    try:
        return one_line(file.read_text(encoding="utf-8", errors="replace").strip())
    except OSError:
        return ""


def _probe_devices() -> Iterator[CameraDevice]:
    with _silence_opencv():
        for number in range(_MOST_TRIED):
            capture = cv2.VideoCapture(number)
            if capture.isOpened():
                yield CameraDevice(number, f"Camera {number + 1}")
            capture.release()


@contextmanager
def _silence_opencv() -> Iterator[None]:
    """Keep OpenCV from printing, because errors are reported in sentences."""
    logging: Any = cv2 if hasattr(cv2, "setLogLevel") else cv2.utils.logging  # OpenCV 4, and 5
    level = logging.getLogLevel()
    logging.setLogLevel(0)
    try:
        yield
    finally:
        logging.setLogLevel(level)


class CameraSource:
    def __init__(self, device: CameraDevice) -> None:
        self.title, self.axis = device.name, "lines"
        self._device = device
        self._capture: cv2.VideoCapture | None = None
        self._open_time = 0.0
        self._is_locked = False

    def open(self) -> None:
        """Open the camera in full HD, or in the nearest size that it has."""
        self.close()
        with _silence_opencv():
            kind = cv2.CAP_V4L2 if IS_LINUX else cv2.CAP_ANY
            capture = cv2.VideoCapture(self._device.number, kind)
            if not capture.isOpened():
                capture.release()
                raise VideoError(
                    f"The camera {self.title} cannot be opened: it is no longer connected, "
                    "another program uses it, or this program has no permission to use it."
                )
            # Without compression, few cameras deliver such large pictures fast enough.
            capture.set(cv2.CAP_PROP_FOURCC, cv2.VideoWriter.fourcc(*"MJPG"))
            capture.set(cv2.CAP_PROP_FRAME_WIDTH, _WIDTH)
            capture.set(cv2.CAP_PROP_FRAME_HEIGHT, _HEIGHT)
            capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)
        self._capture, self._open_time = capture, monotonic()

    def read(self) -> LivePicture | None:
        if self._capture is None:
            return None
        has_picture, pixels = self._capture.read()
        if not has_picture or pixels is None or pixels.dtype != np.uint8:
            return None
        return LivePicture(monotonic() - self._open_time, np.asarray(pixels, dtype=np.uint8))

    def lock_exposure(self, on: bool) -> bool:
        """Lock the present exposure time, or let the camera choose it."""
        capture = self._capture
        if capture is None:
            return False
        is_v4l = capture.getBackendName() == "V4L2"
        manual = _V4L_MANUAL if is_v4l else _MANUAL
        automatic = _V4L_AUTOMATIC if is_v4l else _AUTOMATIC
        exposure = capture.get(cv2.CAP_PROP_EXPOSURE)
        mode = manual if on else automatic
        if not capture.set(cv2.CAP_PROP_AUTO_EXPOSURE, mode):
            return False
        if on:
            capture.set(cv2.CAP_PROP_EXPOSURE, exposure)
        self._is_locked = on
        return abs(capture.get(cv2.CAP_PROP_AUTO_EXPOSURE) - mode) < 0.01

    def close(self) -> None:
        if self._capture is not None:
            if self._is_locked:  # the device would keep it for other programs
                self.lock_exposure(False)
            self._capture.release()
            self._capture = None
