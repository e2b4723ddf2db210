"""Connects the lessons with their pane, the controls, the equations and the report."""

from PySide6.QtCore import QUrl, Signal
from PySide6.QtGui import QDesktopServices

from occ_gui.explanation.equation_controller import EquationController
from occ_gui.files.preferences import Preferences
from occ_gui.lessons.answers import LessonAnswers
from occ_gui.lessons.lesson_controller import LessonController
from occ_gui.lessons.lesson_view import LessonView
from occ_gui.lessons.report import LessonReports
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.spotlight import Spotlight
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import Board
from occ_model.errors import OccError
from occ_model.results.lessons import Lesson
from occ_model.teaching.lessons import begin_lessons_folder


class LessonPane(Pane[None]):
    """The lessons and all that they move; a step marks one of the controls."""

    noted = Signal(str)  # the outcome of an action, for as long as the scene stays

    def __init__(
        self, scenes: SceneStore, board: Board, controls: ControlPanel, preferences: Preferences
    ) -> None:
        self.view = pane = LessonView()
        super().__init__(pane)
        self.answers = LessonAnswers()
        self.controller = LessonController(scenes.store, board, pane, self.answers)
        self.reports = LessonReports(pane, preferences)
        self.tasks = (self.answers.runner, self.reports.runner)
        self._end = pane.end
        self._end.author.setText(self.reports.author)
        self._end.author.editingFinished.connect(
            lambda: self.reports.keep_author(self._end.author.text())
        )
        self.spotlight = Spotlight(controls)
        self._equations = EquationController(scenes, pane.step.show_equations)
        self.controller.control_wanted.connect(self.spotlight.show_only)
        self.controller.equation_wanted.connect(self._equations.show_only)
        self.controller.report_asked.connect(self._write_report)
        pane.step.explained.connect(self._equations.set_seen)
        pane.list.folder_asked.connect(self.open_folder)
        for speaker in (self.controller, self.reports):
            speaker.status_message.connect(self.noted)

    def set_seen(self, seen: bool) -> None:
        self.controller.set_seen(seen)

    def open_folder(self) -> None:
        try:
            folder = begin_lessons_folder()
        except OccError as error:
            self.noted.emit(str(error))
            return
        if not QDesktopServices.openUrl(QUrl.fromLocalFile(str(folder))):
            self.noted.emit(f"Your own lessons belong into {folder}")

    def end(self) -> None:
        self.spotlight.end()
        self.controller.restore_user()

    def _write_report(self, lesson: Lesson) -> None:
        self.reports.ask(lesson, self.answers.all_of(lesson), self._end.author.text())
