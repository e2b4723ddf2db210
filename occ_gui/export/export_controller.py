"""Figures of what the window shows: to files, to a folder, to the clipboard."""

from collections import deque
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QGuiApplication, QImage
from PySide6.QtWidgets import QFileDialog, QWidget

from occ_gui.background.latest_wins import LatestWins
from occ_gui.export.figures import Figures, NothingToDraw
from occ_gui.export.jobs import Exported, ExportJob, FigureRequest, export
from occ_gui.files.preferences import Memory
from occ_model.errors import one_line
from occ_model.scene.provenance import ENDINGS


class ExportController(QObject):
    """Asks where to, and has the figures drawn off the window's thread, one job after the other.

    Parameters
    ----------
    window
        The window that dialogs belong to.
    figures
        Knows what each figure is drawn from.
    memory
        Remembers the folder.
    """

    status_message = Signal(str)
    """What was done, or why it was not."""

    def __init__(self, window: QWidget | None, figures: Figures, memory: Memory) -> None:
        super().__init__(window)
        self._window = window
        self._figures = figures
        self._memory = memory
        self._waiting: deque[ExportJob] = deque()
        self._left_out = ""
        # Looked up when it is called, so that another one can be put in its place.
        self.runner: LatestWins[ExportJob, Exported] = LatestWins(lambda job: export(job), "export")
        self.runner.finished.connect(self._tell)
        self.runner.failed.connect(self.status_message)
        self.runner.idle.connect(self._go_on)

    @property
    def is_idle(self) -> bool:
        """Whether all that was asked for is written."""
        return self.runner.is_idle and not self._waiting

    def ask(self, name: str) -> None:
        """Let the user choose the file that a figure is written to."""
        request = self._request(name)
        if request is None:
            return
        kinds = {
            ".png": self.tr("PNG picture (*.png)"),
            ".svg": self.tr("SVG drawing (*.svg)"),
            ".pdf": self.tr("PDF document (*.pdf)"),
            ".csv": self.tr("CSV table of the numbers (*.csv)"),
        }
        title = self.tr("Export: {figure}").format(figure=self._figures.titles[name])
        chosen, kind = QFileDialog.getSaveFileName(
            self._window, title, str(Path(self._memory.folder, f"{name}.png")),
            ";;".join(kinds.values()),
        )  # fmt: skip
        if not chosen:
            return
        path = Path(chosen)
        if not path.suffix:
            ending = next((each for each, text in kinds.items() if text == kind), ENDINGS[0])
            path = path.with_suffix(ending)
        self._put(ExportJob((request,), path=path))

    def export(self, name: str, path: Path) -> None:
        """Write a figure in the format that the file's ending names."""
        request = self._request(name)
        if request is not None:
            self._put(ExportJob((request,), path=path))

    def ask_for_folder(self) -> None:
        """Let the user choose the folder that all figures are written to."""
        folder = QFileDialog.getExistingDirectory(
            self._window, self.tr("Export all figures into a folder"), self._memory.folder
        )
        if folder:
            self.export_all(Path(folder))

    def export_all(self, folder: Path) -> None:
        """Write every figure that there is in every format into a folder."""
        requests, missing = [], []
        for name, source in self._figures.sources.items():
            try:
                requests.append(source())
            except NothingToDraw as reason:
                missing.append(f"{self._figures.titles[name]}: {reason}")
        self._left_out = " ".join(missing)
        if not requests:
            self.status_message.emit(self._left_out)
            return
        self._put(ExportJob(tuple(requests), folder=folder))

    def copy(self, name: str) -> None:
        """Put a figure on the clipboard, as a picture."""
        request = self._request(name)
        if request is not None:
            self._put(ExportJob((request,)))

    def _request(self, name: str) -> FigureRequest | None:
        try:
            return self._figures.sources[name]()
        except NothingToDraw as reason:
            self.status_message.emit(str(reason))
            return None

    def _put(self, job: ExportJob) -> None:
        self._waiting.append(job)
        self.status_message.emit(self.tr("Drawing…"))
        self._go_on()

    def _go_on(self) -> None:
        if self._waiting and self.runner.is_idle:
            self.runner.submit(self._waiting.popleft())

    def _tell(self, done: Exported) -> None:
        job = done.job
        if job.folder is not None:
            self._memory.visit(job.folder / "figure")
            message = self.tr("Exported {count} files into {folder}.").format(
                count=len(done.files), folder=one_line(job.folder.name)
            )
            left_out = self.tr("Left out: {what}").format(what=self._left_out)
            self.status_message.emit(f"{message} {left_out}" if self._left_out else message)
        elif job.path is not None:
            self._memory.visit(job.path)
            self.status_message.emit(
                self.tr("Exported {name}").format(name=one_line(job.path.name))
            )
        else:
            self._to_clipboard(done.png)

    def _to_clipboard(self, png: bytes) -> None:
        # With the texts of the file, the scene among them. Data made here, not by Qt, would end
        # the program with a fault where it is still on the clipboard then.
        QGuiApplication.clipboard().setImage(QImage.fromData(png))
        self.status_message.emit(self.tr("Copied the figure."))

    def stop(self) -> None:
        """Write no more than is at work."""
        self._waiting.clear()
        self.runner.stop()
