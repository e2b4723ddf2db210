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

from occ_gui.background.task import Task
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


# matplotlib takes half a second to import, so that functions import what needs it when called.


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

        scenes, settings = {"at hand": self.scene}, self.settings
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


def export(job: ExportJob) -> ExportResult:
    """Write figures, each complete or not at all."""
    if job.folder is not None:
        return ExportResult(job, _write_all(job.folder, job.requests))
    (request,) = job.requests
    if job.path is not None:  # refused before the figure is drawn, which takes a second
        check_replaceable(job.path)
    drawing = request.draw()
    if job.path is not None:
        drawing.write(job.path, request.provenance(drawing))
        return ExportResult(job, (job.path,))
    from occ_model.figures.drawing import figure_bytes, house_style

    with house_style():
        return ExportResult(
            job, png=figure_bytes(drawing.draw(), "png", request.provenance(drawing))
        )


def _write_all(folder: Path, requests: Sequence[FigureRequest]) -> list[Path]:
    from occ_model.figures.drawing import files_of, write_all

    is_new = not folder.exists()
    make_folder(folder)
    try:
        drawn = {request.draw(): request for request in requests}
        # Refused at once: drawing takes seconds.
        for drawing in drawn:
            for path in files_of(drawing, folder):
                check_replaceable(path)
        return write_all(folder, drawn, lambda drawing: drawn[drawing].provenance(drawing))
    finally:
        if is_new and not any(folder.iterdir()):
            folder.rmdir()


_WITH_FIGURE = ("profile", "accuracy", "map", "bench", "bands", "room")
"""Panes with a figure of the same name; for any other pane, the picture is copied."""

_ENDING = "export/ending"  # key under which the ending of the last exported file is stored


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
        self._waiting: deque[ExportJob] = deque()
        self._left_out = ""
        # A lambda looks up `export` at each call, so that tests can replace it.
        self.runner: Task[ExportJob, ExportResult] = Task(
            lambda request, _: export(request), "export"
        )
        self.tasks = (self.runner,)
        self.runner.finished.connect(self._report)
        self.runner.failed.connect(self.status_message)
        self.runner.idle.connect(self._go_on)

    @property
    def is_idle(self) -> bool:
        return super().is_idle and not self._waiting

    def ask(self, name: str) -> None:
        """Ask for a file, and write a figure to it."""
        shown = self._present.latest
        if shown is not None and self._request_or_report(name, shown) is None:
            return
        kinds = {
            ".png": "PNG picture (*.png)",
            ".svg": "SVG drawing (*.svg)",
            ".pdf": "PDF document (*.pdf)",
            ".csv": "CSV table of the numbers (*.csv)",
        }
        title = f"Export: {self._shell.figures[name].title}"
        kept = self._preferences.recall(_ENDING)
        first = kept if kept in kinds else ENDINGS[0]
        chosen, kind = QFileDialog.getSaveFileName(
            self._window, title, str(Path(self._preferences.export_folder, f"{name}{first}")),
            ";;".join(kinds.values()), kinds[first],
        )  # fmt: skip
        if not chosen:
            return
        path = Path(chosen)
        if not path.suffix:
            ending = next((each for each, text in kinds.items() if text == kind), ENDINGS[0])
            path = path.with_suffix(ending)
        self._preferences.keep(_ENDING, path.suffix.lower())
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

    def _draw_all(self, folder: Path, shown: Snapshot) -> None:
        requests, missing = [], []
        for figure in self._shell.different_figures:
            try:
                requests.append(self._make_request(figure.name, shown))
            except NothingToDraw as reason:
                missing.append(f"{figure.title}: {reason}")
        self._left_out = " ".join(missing)
        if not requests:
            self.status_message.emit(self._left_out)
            return
        self._put(ExportJob(tuple(requests), folder=folder))

    def copy(self, name: str) -> None:
        self._present.ask(partial(self._draw, name, None))

    def copy_current(self) -> None:
        pane = self._current_pane()
        if pane == "decode":
            self.copy(f"decoding-{self._store.workspace.decoder}")
            return
        self.copy(pane if pane in _WITH_FIGURE else PICTURE)

    def _draw(self, name: str, path: Path | None, shown: Snapshot) -> None:
        request = self._request_or_report(name, shown)
        if request is not None:
            self._put(ExportJob((request,), path=path))

    def _request_or_report(self, name: str, shown: Snapshot) -> FigureRequest | None:
        try:
            return self._make_request(name, shown)
        except NothingToDraw as reason:
            self.status_message.emit(str(reason))
            return None

    def _make_request(self, name: str, shown: Snapshot) -> FigureRequest:
        now = datetime.now().astimezone().isoformat(timespec="seconds")
        draw = self._shell.draw(name, shown)
        return FigureRequest(shown.frame.scene, shown.request.settings, now, draw)

    def _put(self, job: ExportJob) -> None:
        self._waiting.append(job)
        self.status_message.emit("Drawing…")
        self._go_on()

    def _go_on(self) -> None:
        if self._waiting and self.runner.is_idle:
            self.runner.ask(self._waiting.popleft())

    def _report(self, done: ExportResult) -> None:
        job = done.job
        if job.folder is not None:
            self._preferences.visit_export(job.folder / "figure")
            message = (
                f"Exported {inflect(len(done.files), 'file')} into {one_line(job.folder.name)}."
            )
            left_out = f"Left out: {self._left_out}"
            self.status_message.emit(f"{message} {left_out}" if self._left_out else message)
        elif job.path is not None:
            self._preferences.visit_export(job.path)
            self.status_message.emit(
                f"Exported {one_line(job.path.name)} into "
                f"{one_line(str(job.path.absolute().parent))}"
            )
        else:
            self._to_clipboard(done.png)

    def _to_clipboard(self, png: bytes) -> None:
        # A QImage keeps the texts of the file, which include the scene. A QMimeData object made in
        # Python would crash the program if it were still on the clipboard at the end.
        QGuiApplication.clipboard().setImage(QImage.fromData(png))
        self.status_message.emit("Copied the figure.")
