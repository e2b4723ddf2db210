"""Controller of the live camera: films, has each picture read, and releases the device."""

from collections.abc import Callable

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from occ_gui.background.task import Report, Task
from occ_gui.video.camera import CameraDevice, CameraSource, find_cameras
from occ_gui.video.film_controller import FilmController
from occ_gui.video.frame_source import FrameSource
from occ_gui.video.live_video import LiveVideo
from occ_gui.video.reading_controller import ReadingController
from occ_model.scene.scene import Scene

_TURN_MS = 30  # milliseconds between two pictures on the screen


def _find(_request: None, report: Report) -> tuple[CameraDevice, ...]:
    report(None)
    return find_cameras()


class LiveController(QObject):
    devices_found = Signal(object)

    ended = Signal(str)  # why the camera gives no more pictures; empty where it was stopped
    exposure_refused = Signal(str)  # why the exposure is not held

    _answered = Signal(bool, bool)

    def __init__(
        self,
        films: FilmController,
        readings: ReadingController,
        scene: Callable[[], Scene],
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

    def start(self, source: FrameSource, axis: str = "") -> None:
        """Read what a source gives, in place of the film that is open.

        ``axis``: what of its pictures the shutter scans; by default what the source says.
        """
        self.stop_filming()
        self.video = LiveVideo(source, axis or source.axis, self._last)
        self._shown = -1
        self._films.put_live(self.video)
        self.video.start()
        self.read()
        self._turns.start()

    def scan_along(self, axis: str) -> None:
        """Set what the shutter scans: the camera is opened again."""
        if self.video is not None:
            self.start(self.video.source, axis)

    def read(self) -> None:
        if self.video is not None:
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
                "This camera does not let its exposure be held."
                if on
                else "This camera does not let its exposure go."
            )

    def release(self) -> None:
        self.stop_filming()
        if self._last is not None:
            self._last.join()
