"""Writing of figures to files off the window's thread: all that are requested, or none."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from occ_gui.shell.feature import Draw
from occ_model.files.writing import check_replaceable, make_folder
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

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
