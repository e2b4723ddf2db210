"""Report of a lesson: asks for a file, and writes it on a thread."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from occ_gui.background.task import Task
from occ_gui.files.preferences import Preferences
from occ_model.errors import one_line
from occ_model.results.lessons import AnsweredStep, Lesson

_AUTHOR = "lessons/author"
_ENDING = ".pdf"


@dataclass(frozen=True, slots=True)
class _Job:
    path: Path
    lesson: Lesson
    steps: Sequence[AnsweredStep]
    author: str


class LessonReports(QObject):
    status_message = Signal(str)

    def __init__(self, window: QWidget | None, preferences: Preferences) -> None:
        super().__init__()
        self._window, self._preferences = window, preferences
        self.runner: Task[_Job, Path] = Task(lambda request, _: _write(request), "lesson report")
        self.runner.finished.connect(self._report)
        self.runner.failed.connect(self.status_message)

    @property
    def author(self) -> str:
        """The name of the student as it was entered last; empty before."""
        return self._preferences.recall(_AUTHOR)

    def keep_author(self, author: str) -> None:
        self._preferences.keep(_AUTHOR, one_line(author.strip()))

    def ask(self, lesson: Lesson, steps: Sequence[AnsweredStep], author: str) -> None:
        """Let the user choose a file, and write the report with this name of the student."""
        self.keep_author(author)
        start = Path(self._preferences.export_folder, f"{lesson.name}{_ENDING}")
        chosen, _ = QFileDialog.getSaveFileName(
            self._window, "Save the report", str(start),
            "PDF document (*.pdf);;Markdown (*.md);;PNG picture (*.png);;SVG drawing (*.svg)",
        )  # fmt: skip
        if chosen:
            path = Path(chosen)
            path = path if path.suffix else path.with_suffix(_ENDING)
            self.write(path, lesson, steps, self.author)

    def write(self, path: Path, lesson: Lesson, steps: Sequence[AnsweredStep], author: str) -> None:
        self.status_message.emit("Drawing…")
        self.runner.ask(_Job(path, lesson, tuple(steps), author))

    def _report(self, path: Path) -> None:
        self._preferences.visit_export(path)
        self.status_message.emit(f"Saved {one_line(path.name)}")


def _write(job: _Job) -> Path:
    # matplotlib takes half a second to import.
    from occ_model.figures.lesson_report import write_lesson_report

    today = date.today().isoformat()
    write_lesson_report(job.path, job.lesson, job.steps, author=job.author, date=today)
    return job.path
