"""Live camera: shows and reads its newest picture as soon as the previous one is done."""

from collections.abc import Callable, Iterator
from threading import Condition, Thread

import cv2
import numpy as np
from PySide6.QtCore import QObject, Qt, QTimer, Signal

from occ_gui.background.task import Report, Task
from occ_gui.video.camera import (
    AXES,
    CameraDevice,
    CameraDriver,
    CameraSource,
    LivePicture,
    find_cameras,
)
from occ_gui.video.film_controller import FilmController
from occ_gui.video.reading_controller import FilmReader
from occ_model.arrays import ByteArray
from occ_model.errors import OccError, VideoError
from occ_model.results.video import Video, VideoFrame
from occ_model.scene.scene import Scene

_JOIN_SECONDS = 5.0  # longest wait in seconds for a device that does not respond

_INTERVAL_MS = 30  # milliseconds between two pictures on the screen


class LiveVideo(Video):
    """The pictures of a source as an endless film, which drops pictures that are not read.

    A thread of its own opens, reads and closes the source, so that decoding never delays the next
    pictures and a device that hangs never blocks the window.

    ``axis``: the axis that the shutter scans, one of AXES. ``previous``: the previous film, which
    must release its device first.
    """

    def __init__(
        self, source: CameraDriver, axis: str = AXES[0], previous: "LiveVideo | None" = None
    ) -> None:
        self.title = source.title
        self.shape = (0, 0)
        self.frame_rate = self.frame_count = None
        self.source = source
        self.axis = axis
        self._previous = previous
        self._condition = Condition()
        self._newest: LivePicture | None = None
        self.picture_count = 0
        self.has_ended = self._is_stopped = False
        self.last_frame: VideoFrame | None = None
        self._problem: str | None = None
        self._commands: list[Callable[[], None]] = []
        self.thread = Thread(target=self._film, name="camera", daemon=True)

    @property
    def simulated(self) -> bool:
        return False

    @property
    def problem(self) -> str | None:
        """Why there are no more pictures; None if there are."""
        return self._problem

    def start(self) -> None:
        self.thread.start()

    def end(self) -> None:
        """End filming; the device is released as soon as it responds."""
        with self._condition:
            self._is_stopped = self.has_ended = True
            self._newest = None
            self._condition.notify_all()

    def join(self) -> None:
        """Wait until the device is released, but only for some seconds, as a driver may hang."""
        if self.thread.ident is not None:
            self.thread.join(_JOIN_SECONDS)

    def lock_exposure(self, on: bool, report: Callable[[bool], None]) -> None:
        """Lock or release the exposure between two pictures.

        ``report`` is called from another thread; its argument tells whether that was possible.
        """
        with self._condition:
            self._commands.append(lambda: report(self.source.lock_exposure(on)))

    def frames(self, first: int = 0) -> Iterator[VideoFrame]:  # noqa: ARG002 - part of Video
        """Yield the newest picture whenever one is requested, each only once; ignores ``first``."""
        while (frame := self._next()) is not None:
            yield frame

    def frame(self, index: int) -> VideoFrame:
        """Refuse: past pictures are not kept."""
        raise VideoError(f"Frame {index} of {self.title} is not kept: it is a live film.")

    def _next(self) -> VideoFrame | None:
        with self._condition:
            self._condition.wait_for(lambda: self._newest is not None or self.has_ended)
            picture, self._newest = self._newest, None
            if picture is None:
                return None
            grey = self._grey(picture.pixels)
            self.shape = (grey.shape[0], grey.shape[1])
            self.last_frame = VideoFrame(self.picture_count - 1, picture.time, grey)
            return self.last_frame

    def _grey(self, pixels: ByteArray) -> ByteArray:
        """Return the luma with the scan axis as columns, as for a film from a file."""
        if pixels.ndim == 3:
            pixels = np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY), dtype=np.uint8)
        if self.axis == "lines":
            pixels = np.asarray(cv2.transpose(pixels), dtype=np.uint8)
        return pixels

    def _film(self) -> None:
        problem: str | None = None
        previous, self._previous = self._previous, None
        if previous is not None:
            previous.join()
        try:
            self.source.open()
            while not self._is_stopped:
                picture = self.source.read()
                if picture is None:
                    problem = f"{self.title} delivers no more pictures: it ended or was unplugged."
                    break
                self._put(picture)
        except OccError as error:
            problem = str(error)
        except Exception as error:  # noqa: BLE001 - a driver may raise anything
            problem = f"{self.title} delivers no more pictures ({type(error).__name__}: {error})."
        finally:
            self.source.close()
            with self._condition:
                self.has_ended = True
                self._problem = None if self._is_stopped else problem
                self._condition.notify_all()

    def _put(self, picture: LivePicture) -> None:
        with self._condition:
            commands, self._commands = self._commands, []
            if not self._is_stopped:
                self._newest = picture
                self.picture_count += 1
                self._condition.notify_all()
        for command in commands:
            command()


def _find_devices(_request: None, report: Report) -> tuple[CameraDevice, ...]:
    report(None)
    return find_cameras()


class LiveController(QObject):
    devices_found = Signal(object)

    ended = Signal(str)  # why there are no more pictures; empty if the user stopped the camera
    exposure_refused = Signal(str)  # why the exposure is not locked or released

    _exposure_set = Signal(bool, bool)

    def __init__(
        self, films: FilmController, readings: FilmReader, scene: Callable[[], Scene]
    ) -> None:
        super().__init__()
        self._films, self._readings, self._scene = films, readings, scene
        self.video: LiveVideo | None = None  # the film of the camera that is filming
        self.finder: Task[None, tuple[CameraDevice, ...]] = Task(
            _find_devices, "search for cameras", impatient=True
        )
        self.finder.finished.connect(self.devices_found)
        self.finder.failed.connect(self.ended)
        self._timer = QTimer(self)
        self._timer.setInterval(_INTERVAL_MS)
        self._timer.timeout.connect(self._show)
        self._exposure_set.connect(self._on_exposure_set, Qt.ConnectionType.QueuedConnection)
        self._shown_index = -1
        self._last_video: LiveVideo | None = None

    @property
    def is_filming(self) -> bool:
        return self.video is not None

    def find(self) -> None:
        if self.finder.is_idle:
            self.finder.ask(None)

    def start_camera(self, device: CameraDevice) -> None:
        self.start(CameraSource(device))

    def start(self, source: CameraDriver, axis: str = "") -> None:
        """Open a source in place of the film; ``axis`` is by default the source's usual axis."""
        self.stop_filming()
        self.video = LiveVideo(source, axis or source.axis, self._last_video)
        self._shown_index = -1
        self._films.show_live_film(self.video)
        self.video.start()
        self.read()
        self._timer.start()

    def scan_along(self, axis: str) -> None:
        """Set the axis that the shutter scans, and reopen the camera."""
        if self.video is not None:
            self.start(self.video.source, axis)

    def read(self) -> None:
        if self.video is not None and self._scene().transmitter.light == "code":
            self._readings.start(self.video, self._scene(), is_live=True)

    def lock_exposure(self, on: bool) -> None:
        if self.video is not None:
            self.video.lock_exposure(on, lambda is_set: self._exposure_set.emit(on, is_set))

    def stop_filming(self) -> None:
        """Release the camera; its last picture stays."""
        self._timer.stop()
        video, self.video = self.video, None
        if video is not None:
            self._readings.cancel()
            video.end()
            self._last_video = video

    def _show(self) -> None:
        video = self.video
        if video is None:
            return
        has_ended = video.has_ended
        if has_ended:
            next(video.frames(), None)  # the last picture, if no reader has taken it yet
        if video.last_frame is not None and video.last_frame.index != self._shown_index:
            self._shown_index = video.last_frame.index
            self._films.show_live(video.last_frame)
        if has_ended:
            problem = video.problem or ""
            self.stop_filming()
            self.ended.emit(problem)

    def _on_exposure_set(self, on: bool, is_set: bool) -> None:
        if not is_set:
            self.exposure_refused.emit(
                "The exposure of this camera cannot be held."
                if on
                else "The exposure of this camera cannot be released."
            )

    def release(self) -> None:
        self.stop_filming()
        if self._last_video is not None:
            self._last_video.join()
