"""Controller of *Measure my camera*: asks for pictures, measures on a thread, sets the scene."""

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QWidget

from occ_gui.background.task import Task
from occ_gui.camera.camera_dialog import CameraDialog
from occ_gui.camera.jobs import CameraAnswer, CameraQuestion, answer_question
from occ_gui.core.store import NO_GESTURE
from occ_gui.files.file_controller import PHOTO_KINDS
from occ_gui.files.preferences import Preferences
from occ_gui.scene.scene_store import SceneStore
from occ_gui.shell.feature import Service
from occ_model.errors import one_line
from occ_model.photo.camera.measure import MOST_PICTURES
from occ_model.results.camera import CameraMeasurement
from occ_model.scene.units import SECOND


class CameraController(Service):
    def __init__(self, window: QWidget, scenes: SceneStore, preferences: Preferences) -> None:
        super().__init__()
        self._window, self._scenes, self._preferences = window, scenes, preferences
        self._paths: tuple[Path, ...] = ()
        self._measured: CameraMeasurement | None = None
        self.dialog: CameraDialog | None = None
        self.measuring: Task[CameraQuestion, CameraAnswer] = Task(
            answer_question, "measurement of the camera", impatient=True
        )
        self.tasks = (self.measuring,)
        self.measuring.reported.connect(self._show_progress)
        self.measuring.finished.connect(self._show_answer)
        self.measuring.failed.connect(self._show_failure)

    def show(self) -> None:
        if self.dialog is None:
            self.dialog = CameraDialog(self._window)
            self.dialog.pictures_asked.connect(self.ask_for_pictures)
            self.dialog.pictures_dropped.connect(self.measure)
            self.dialog.mains_chosen.connect(self._measure_again)
            self.dialog.cancel_asked.connect(self._cancel)
            self.dialog.readout_chosen.connect(self._use_readout)
        self.dialog.show()
        self.dialog.activateWindow()

    def ask_for_pictures(self) -> None:
        names, _ = QFileDialog.getOpenFileNames(
            self.dialog, "Choose two pictures of a lit wall", self._preferences.folder, PHOTO_KINDS
        )
        if names:
            self._preferences.remember_folder(Path(names[0]))
            self.measure([Path(name) for name in names])

    def measure(self, paths: Sequence[Path]) -> None:
        """Measure the camera by one or two pictures; two that come one by one belong together."""
        is_sure = self._measured is not None and self._measured.verdict == "sure"
        if len(paths) == 1 and len(self._paths) == 1 and not is_sure:
            paths = [*self._paths, *paths]
        self._paths = tuple(paths)
        self._measure_again()

    def _measure_again(self) -> None:
        dialog, self._measured = self.dialog, None
        if dialog is None or not self._paths:
            return
        dialog.show_pictures([one_line(path.name) for path in self._paths[:MOST_PICTURES]])
        if len(self._paths) > MOST_PICTURES:
            self.measuring.cancel()
            dialog.show_failure(f"{len(self._paths)} pictures were chosen; allowed: one or two.")
            return
        dialog.work.begin()
        self.measuring.ask(CameraQuestion(self._paths, float(dialog.mains.key())))

    def _cancel(self) -> None:
        self.measuring.cancel()
        self._show_failure("The measurement was cancelled.")

    def _show_progress(self, fraction: float) -> None:
        if self.dialog is not None:
            self.dialog.work.show_progress(fraction)

    def _show_answer(self, answer: CameraAnswer) -> None:
        self._measured = answer.measured
        if self.dialog is not None:
            self.dialog.work.end()
            self.dialog.show_answer(answer)

    def _show_failure(self, sentence: str) -> None:
        if self.dialog is not None:
            self.dialog.work.end()
            self.dialog.show_failure(sentence)

    def _use_readout(self) -> None:
        if self._measured is not None:
            readout = self._measured.readout_time
            self._scenes.change(NO_GESTURE, readout_time=readout)
            self.status_message.emit(f"The scene's readout time is {SECOND.format(readout, 5)}.")
