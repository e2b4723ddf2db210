"""Writing of a large file outside the window's thread, with a progress bar that can cancel it."""

from collections.abc import Callable
from pathlib import Path
from typing import Generic

from PySide6.QtCore import QObject, Signal

from occ_gui.background.task import Report, Request, Task
from occ_gui.widgets.work_bar import WorkBar
from occ_model.errors import one_line


class FileWriter(QObject, Generic[Request]):
    """Writes one file at a time; a new request cancels the previous one, which leaves no file."""

    status_message = Signal(str)
    written = Signal(Path)

    def __init__(
        self,
        write: Callable[[Request, Report], Path],
        name: str,
        bar: WorkBar,
        cancelled_sentence: str,
    ) -> None:
        super().__init__()
        self._bar, self._cancelled_sentence = bar, cancelled_sentence
        self.task: Task[Request, Path] = Task(write, name, impatient=True)
        self.task.reported.connect(bar.show_progress)
        self.task.finished.connect(self._finish)
        self.task.failed.connect(self._fail)
        bar.cancelled.connect(self.cancel)

    def start(self, request: Request) -> None:
        self._bar.begin()
        self.task.ask(request)

    def cancel(self) -> None:
        if not self.task.is_idle:
            self.task.cancel()
            self._bar.end()
            self.status_message.emit(self._cancelled_sentence)

    def _finish(self, path: Path) -> None:
        self._bar.end()
        self.written.emit(path)
        self.status_message.emit(f"Saved {one_line(path.name)}")

    def _fail(self, sentence: str) -> None:
        self._bar.end()
        self.status_message.emit(sentence)
