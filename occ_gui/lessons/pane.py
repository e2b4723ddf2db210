"""Connects the lessons with their pane, the controls and the equations, and writes reports."""

from collections.abc import Callable, Sequence
from datetime import date
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, QUrl, Signal
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog, QWidget

from occ_gui.background.task import Task
from occ_gui.explanation.equation_controller import EquationController
from occ_gui.files.preferences import Preferences
from occ_gui.lessons.answers import LessonAnswers
from occ_gui.lessons.lesson_controller import LessonController
from occ_gui.lessons.lesson_view import LessonView
from occ_gui.scene.control_panel import ControlPanel
from occ_gui.scene.scene_store import SceneStore
from occ_gui.scene.spotlight import Spotlight
from occ_gui.shell.feature import Pane
from occ_gui.shell.results import ResultsStore
from occ_model.errors import OccError, one_line
from occ_model.results.teaching import AnsweredStep, Lesson
from occ_model.teaching.lessons import begin_lessons_folder

_AUTHOR = "lessons/author"
_SUFFIX = ".pdf"


class LessonReports(QObject):
    status_message = Signal(str)

    def __init__(self, window: QWidget | None, preferences: Preferences) -> None:
        super().__init__()
        self._window, self._preferences = window, preferences
        self.task: Task[Callable[[], Path], Path] = Task(lambda write, _: write(), "lesson report")
        self.task.finished.connect(self._announce)
        self.task.failed.connect(self.status_message)

    @property
    def author(self) -> str:
        return self._preferences.recall(_AUTHOR)

    def save_author(self, author: str) -> None:
        self._preferences.keep(_AUTHOR, one_line(author.strip()))

    def ask(self, lesson: Lesson, steps: Sequence[AnsweredStep], author: str) -> None:
        """Ask for a file, and write the report under the student's name."""
        self.save_author(author)
        proposal = Path(self._preferences.export_folder, f"{lesson.name}{_SUFFIX}")
        name, _ = QFileDialog.getSaveFileName(
            self._window, "Save the report", str(proposal),
            "PDF document (*.pdf);;PNG picture (*.png);;SVG drawing (*.svg)",
        )  # fmt: skip
        if name:
            path = Path(name)
            path = path if path.suffix else path.with_suffix(_SUFFIX)
            self.status_message.emit("Drawing…")
            self.task.ask(partial(_write, path, lesson, steps, self.author))

    def _announce(self, path: Path) -> None:
        self._preferences.remember_export_folder(path)
        self.status_message.emit(f"Saved {one_line(path.name)}")


def _write(path: Path, lesson: Lesson, steps: Sequence[AnsweredStep], author: str) -> Path:
    # matplotlib takes half a second to import.
    from occ_model.figures.lesson_report import write_lesson_report

    write_lesson_report(path, lesson, steps, author=author, date=date.today().isoformat())
    return path


class LessonPane(Pane[None]):
    """The pane of the lessons; a step highlights one of the controls."""

    noted = Signal(str)  # the outcome of an action, shown until the scene changes

    def __init__(
        self,
        scenes: SceneStore,
        results_store: ResultsStore,
        controls: ControlPanel,
        preferences: Preferences,
    ) -> None:
        self.view = view = LessonView()
        super().__init__(view)
        self.answers = LessonAnswers()
        self.controller = LessonController(scenes.store, results_store, view, self.answers)
        self.reports = LessonReports(view, preferences)
        self.tasks = (self.answers.task, self.reports.task)
        self._end = view.end
        self._end.author.setText(self.reports.author)
        self._end.author.editingFinished.connect(
            lambda: self.reports.save_author(self._end.author.text())
        )
        self.spotlight = Spotlight(controls)
        self._equations = EquationController(scenes, view.step.equation.show_equations)
        self.controller.control_requested.connect(self.spotlight.show_only)
        self.controller.equation_requested.connect(self._equations.show_only)
        self.controller.report_asked.connect(self._write_report)
        view.step.equation_shown.connect(self._equations.set_visible)
        view.list.folder_asked.connect(self.open_folder)
        for source in (self.controller, self.reports):
            source.status_message.connect(self.noted)

    def set_visible(self, visible: bool) -> None:
        self.controller.set_visible(visible)

    def open_folder(self) -> None:
        try:
            folder = begin_lessons_folder()
        except OccError as error:
            self.noted.emit(str(error))
            return
        if not QDesktopServices.openUrl(QUrl.fromLocalFile(str(folder))):
            self.noted.emit(f"Put your own lessons into {folder}")

    def end(self) -> None:
        self.spotlight.end()
        self.controller.restore_user()

    def _write_report(self, lesson: Lesson) -> None:
        self.reports.ask(lesson, self.answers.list_steps(lesson), self._end.author.text())
