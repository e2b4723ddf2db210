"""Export of figures to a file, a folder or the clipboard, off the window's thread."""

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtGui import QGuiApplication, QImage
from PySide6.QtWidgets import QFileDialog, QWidget

from occ_gui.background.task import Report, Task
from occ_gui.core.store import Store
from occ_gui.files.preferences import Preferences
from occ_gui.shell.feature import Draw, NothingToDraw, Service
from occ_gui.shell.shell import Shell
from occ_gui.simulation.present_results import PresentResults
from occ_gui.simulation.snapshot import Snapshot
from occ_gui.values.modes import PICTURE
from occ_model.errors import inflect, one_line
from occ_model.files.writing import check_replaceable, make_folder
from occ_model.scene.provenance import ENDINGS, Provenance
from occ_model.scene.scene import Scene, SimulationSettings

if TYPE_CHECKING:
    from occ_model.figures.drawing import Drawing


# Functions import what needs matplotlib when called, because it takes half a second to import.


@dataclass(frozen=True, eq=False, slots=True)
class FigureRequest:
    scene: Scene
    settings: SimulationSettings
    date: str
    draw: Draw

    def provenance(self, drawing: "Drawing") -> Provenance:
        if drawing.provenance is not None:
            return drawing.provenance(self.date)
        from occ_model.figures.drawing import settings_notes

        scenes, settings = {"of this file": self.scene}, self.settings
        notes = settings_notes(settings)
        return Provenance(drawing.title, scenes, settings.seed, notes, self.date)


@dataclass(frozen=True, eq=False, slots=True)
class ExportJob:
    requests: Sequence[FigureRequest]
    path: Path | None = None  # the file of a single figure; None for the clipboard
    folder: Path | None = None


@dataclass(frozen=True, eq=False, slots=True)
class ExportResult:
    job: ExportJob
    files: Sequence[Path] = ()
    png: bytes = b""


def export(job: ExportJob, report: Report) -> ExportResult:
    """Write figures, each complete or not at all; several of them all or none."""
    if job.folder is not None:
        return ExportResult(job, _write_all(job.folder, job.requests, report))
    (request,) = job.requests
    if job.path is not None:  # refused before the figure is drawn, which takes a second
        check_replaceable(job.path)
    drawing = request.draw()
    if job.path is not None:
        drawing.write(job.path, request.provenance(drawing))
        return ExportResult(job, (job.path,))
    (png,) = drawing.encode((".png",), request.provenance(drawing))
    return ExportResult(job, png=png)


def _write_all(folder: Path, requests: Sequence[FigureRequest], report: Report) -> list[Path]:
    from occ_model.figures.drawing import write_all

    is_new = not folder.exists()
    make_folder(folder)
    try:
        drawings = {request.draw(): request for request in requests}

        def find_provenance(drawing: "Drawing") -> Provenance:
            report(None)  # ends here if the window was closed
            return drawings[drawing].provenance(drawing)

        return write_all(folder, drawings, find_provenance)
    finally:
        if is_new and not any(folder.iterdir()):
            folder.rmdir()


_ENDING_KEY = "export/ending"  # key of the last exported file's ending in the preferences


class ExportController(Service):
    """Draws figures of the present scene one by one, on a thread, to save or copy them."""

    def __init__(
        self,
        window: QWidget | None,
        shell: Shell,
        present: PresentResults,
        preferences: Preferences,
        current_pane: Callable[[], str],
        store: Store,
    ) -> None:
        super().__init__()
        self._window = window
        self._shell = shell
        self._present = present
        self._preferences = preferences
        self._current_pane = current_pane
        self._store = store
        self._queue: deque[ExportJob] = deque()
        self._omissions = ""
        self.task: Task[ExportJob, ExportResult] = Task(export, "export")
        self.tasks = (self.task,)
        self.task.finished.connect(self._report)
        self.task.failed.connect(self.file_failed)
        self.task.idle.connect(self._draw_next)

    @property
    def is_idle(self) -> bool:
        return super().is_idle and not self._queue

    def ask(self, name: str) -> None:
        """Ask for a file, and write a figure to it."""
        snapshot = self._present.latest
        if snapshot is not None and self._request_or_report(name, snapshot) is None:
            return
        kinds = {
            ".png": "PNG picture (*.png)",
            ".svg": "SVG drawing (*.svg)",
            ".pdf": "PDF document (*.pdf)",
            ".csv": "CSV table of the numbers (*.csv)",
        }
        title = f"Export: {self._shell.figures[name].title}"
        last = self._preferences.recall(_ENDING_KEY)
        ending = last if last in kinds else ENDINGS[0]
        chosen, kind = QFileDialog.getSaveFileName(
            self._window, title, str(Path(self._preferences.export_folder, f"{name}{ending}")),
            ";;".join(kinds.values()), kinds[ending],
        )  # fmt: skip
        if not chosen:
            return
        path = Path(chosen)
        if not path.suffix:
            ending = next((key for key, text in kinds.items() if text == kind), ENDINGS[0])
            path = path.with_suffix(ending)
        self._preferences.keep(_ENDING_KEY, path.suffix.lower())
        self.export(name, path)

    def export(self, name: str, path: Path) -> None:
        self._present.ask(partial(self._draw, name, path))

    def ask_for_folder(self) -> None:
        folder = QFileDialog.getExistingDirectory(
            self._window, "Export all figures into a folder", self._preferences.export_folder
        )
        if folder:
            self.export_all(Path(folder))

    def export_all(self, folder: Path) -> None:
        """Write every available figure in every format into a folder."""
        self._present.ask(partial(self._draw_all, folder))

    def _draw_all(self, folder: Path, snapshot: Snapshot) -> None:
        requests, missing = [], []
        for figure in self._shell.different_figures:
            try:
                requests.append(self._make_request(figure.name, snapshot))
            except NothingToDraw as reason:
                missing.append(f"{figure.title}: {reason}")
        self._omissions = " ".join(missing)
        if not requests:
            self.status_message.emit(self._omissions)
            return
        self._enqueue(ExportJob(tuple(requests), folder=folder))

    def copy(self, name: str) -> None:
        self._present.ask(partial(self._draw, name, None))

    def copy_current(self) -> None:
        """Copy the figure of the current pane, or the picture if the pane has none."""
        pane = self._current_pane()
        if pane == "decode":
            self.copy(f"decoding-{self._store.workspace.decoder}")
            return
        self.copy(pane if pane in self._shell.figures else PICTURE)

    def _draw(self, name: str, path: Path | None, snapshot: Snapshot) -> None:
        request = self._request_or_report(name, snapshot)
        if request is not None:
            self._enqueue(ExportJob((request,), path=path))

    def _request_or_report(self, name: str, snapshot: Snapshot) -> FigureRequest | None:
        try:
            return self._make_request(name, snapshot)
        except NothingToDraw as reason:
            self.status_message.emit(str(reason))
            return None

    def _make_request(self, name: str, snapshot: Snapshot) -> FigureRequest:
        date = datetime.now().astimezone().isoformat(timespec="seconds")
        draw = self._shell.draw(name, snapshot)
        return FigureRequest(snapshot.frame.scene, snapshot.request.settings, date, draw)

    def _enqueue(self, job: ExportJob) -> None:
        self._queue.append(job)
        self.status_message.emit("Drawing…")
        self._draw_next()

    def _draw_next(self) -> None:
        if self._queue and self.task.is_idle:
            self.task.ask(self._queue.popleft())

    def _report(self, result: ExportResult) -> None:
        job = result.job
        if job.folder is not None:
            self._preferences.remember_export_folder(job.folder / "figure")
            message = (
                f"Exported {inflect(len(result.files), 'file')} into {one_line(job.folder.name)}."
            )
            omissions = f"Left out: {self._omissions}"
            self.status_message.emit(f"{message} {omissions}" if self._omissions else message)
        elif job.path is not None:
            self._preferences.remember_export_folder(job.path)
            self.status_message.emit(
                f"Exported {one_line(job.path.name)} into "
                f"{one_line(str(job.path.absolute().parent))}"
            )
        else:
            self._copy_to_clipboard(result.png)

    def _copy_to_clipboard(self, png: bytes) -> None:
        # A QImage keeps the texts of the file, which include the scene. A QMimeData object made in
        # Python would crash the program if it were still on the clipboard at the end.
        QGuiApplication.clipboard().setImage(QImage.fromData(png))
        self.status_message.emit("Copied the figure.")
