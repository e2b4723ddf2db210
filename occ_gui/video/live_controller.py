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

_TURN_MS = 30  # milliseconds between two pictures on the screen


class LiveVideo(Video):
    """The pictures of a source as an endless film, which drops pictures that are not read.

    A thread of its own opens, reads and closes the source, so that decoding never delays the next
    pictures and a device that hangs never blocks the window.

    ``axis``: the axis that the shutter scans, one of AXES. ``after``: the previous film, which
    must release its device first.
    """

    def __init__(
        self, source: CameraDriver, axis: str = AXES[0], after: "LiveVideo | None" = None
    ) -> None:
        self.title = source.title
        self.shape = (0, 0)
        self.frame_rate = self.frame_count = None
        self.source = source
        self.axis = axis
        self._after = after
        self._changed = Condition()
        self._newest: LivePicture | None = None
        self.arrived = 0
        self.has_ended = self._is_stopped = False
        self.last: VideoFrame | None = None
        self._problem: str | None = None
        self._orders: list[Callable[[], None]] = []
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
        with self._changed:
            self._is_stopped = self.has_ended = True
            self._newest = None
            self._changed.notify_all()

    def join(self) -> None:
        """Wait until the device is released, but only for some seconds, as a driver may hang."""
        if self.thread.ident is not None:
            self.thread.join(_JOIN_SECONDS)

    def lock_exposure(self, on: bool, answer: Callable[[bool], None]) -> None:
        """Lock or release the exposure between two pictures.

        ``answer`` is called from another thread; its argument says whether that was possible.
        """
        with self._changed:
            self._orders.append(lambda: answer(self.source.lock_exposure(on)))

    def frames(self, first: int = 0) -> Iterator[VideoFrame]:  # noqa: ARG002 - as of any film
        """Yield the newest picture whenever one is requested, each only once; ignores ``first``."""
        while (frame := self._next()) is not None:
            yield frame

    def frame(self, index: int) -> VideoFrame:
        """Refuse: past pictures are not kept."""
        raise VideoError(f"Frame {index} of {self.title} is not kept: it is a live film.")

    def _next(self) -> VideoFrame | None:
        with self._changed:
            self._changed.wait_for(lambda: self._newest is not None or self.has_ended)
            picture, self._newest = self._newest, None
            index = self.arrived - 1
        if picture is None:
            return None
        grey = self._grey(picture.pixels)
        self.shape = (grey.shape[0], grey.shape[1])
        self.last = VideoFrame(index, picture.time, grey)
        return self.last

    def _grey(self, pixels: ByteArray) -> ByteArray:
        """Return the luma with the scan axis as columns, as for a film from a file."""
        if pixels.ndim == 3:
            pixels = np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY), dtype=np.uint8)
        if self.axis == "lines":
            pixels = np.asarray(cv2.transpose(pixels), dtype=np.uint8)
        return pixels

    def _film(self) -> None:
        problem: str | None = None
        after, self._after = self._after, None
        if after is not None:
            after.join()
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
            with self._changed:
                self.has_ended = True
                self._problem = None if self._is_stopped else problem
                self._changed.notify_all()

    def _put(self, picture: LivePicture) -> None:
        with self._changed:
            orders, self._orders = self._orders, []
            if not self._is_stopped:
                self._newest = picture
                self.arrived += 1
                self._changed.notify_all()
        for order in orders:
            order()


def _find(_request: None, report: Report) -> tuple[CameraDevice, ...]:
    report(None)
    return find_cameras()


class LiveController(QObject):
    devices_found = Signal(object)

    ended = Signal(str)  # why there are no more pictures; empty if the user stopped the camera
    exposure_refused = Signal(str)  # why the exposure is not locked or released

    _answered = Signal(bool, bool)

    def __init__(
        self, films: FilmController, readings: FilmReader, scene: Callable[[], Scene]
    ) -> None:
        super().__init__()
        self._films, self._readings, self._scene = films, readings, scene
        self.video: LiveVideo | None = None  # the film of the camera that is filming
        self.finder: Task[None, tuple[CameraDevice, ...]] = Task(
            _find, "search for cameras", impatient=True
        )
        self.finder.finished.connect(self.devices_found)
        self.finder.failed.connect(self.ended)
        self._turns = QTimer(self)
        self._turns.setInterval(_TURN_MS)
        self._turns.timeout.connect(self._show)
        self._answered.connect(self._on_answer, Qt.ConnectionType.QueuedConnection)
        self._shown = -1
        self._last: LiveVideo | None = None

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
        self.video = LiveVideo(source, axis or source.axis, self._last)
        self._shown = -1
        self._films.put_live(self.video)
        self.video.start()
        self.read()
        self._turns.start()

    def scan_along(self, axis: str) -> None:
        """Set the axis that the shutter scans, and reopen the camera."""
        if self.video is not None:
            self.start(self.video.source, axis)

    def read(self) -> None:
        if self.video is not None and self._scene().transmitter.light == "code":
            self._readings.start(self.video, self._scene(), is_live=True)

    def lock_exposure(self, on: bool) -> None:
        if self.video is not None:
            self.video.lock_exposure(on, lambda done: self._answered.emit(on, done))

    def stop_filming(self) -> None:
        """Release the camera; its last picture stays."""
        self._turns.stop()
        video, self.video = self.video, None
        if video is not None:
            self._readings.cancel()
            video.end()
            self._last = video

    def _show(self) -> None:
        video = self.video
        if video is None:
            return
        if video.last is not None and video.last.index != self._shown:
            self._shown = video.last.index
            self._films.show_live(video.last)
        if video.has_ended:
            problem = video.problem or ""
            self.stop_filming()
            self.ended.emit(problem)

    def _on_answer(self, on: bool, done: bool) -> None:
        if not done:
            self.exposure_refused.emit(
                "The exposure of this camera cannot be held."
                if on
                else "The exposure of this camera cannot be released."
            )

    def release(self) -> None:
        self.stop_filming()
        if self._last is not None:
            self._last.join()
