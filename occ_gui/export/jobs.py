"""Figures to files, off the window's thread, moved into place once all of them are written."""

import re
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from secrets import token_hex
from typing import TYPE_CHECKING

from PySide6.QtCore import QLockFile

from occ_gui.shell.feature import Draw
from occ_model.errors import OutputError
from occ_model.files.writing import check_replaceable, make_folder
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings

if TYPE_CHECKING:
    from occ_model.figures.drawing import Drawing

_PREFIX = ".export-"
_NAME = re.compile(re.escape(_PREFIX) + r"[a-z0-9_]{8}")


@contextmanager
def folder_aside(folder: Path) -> Iterator[Path]:
    """Create a temporary folder in a folder, with a lock file beside it while it exists."""
    aside = folder / f"{_PREFIX}{token_hex(4)}"
    lock = _lock_of(aside)
    is_locked = lock.tryLock(0)  # before the folder exists, which another process could remove
    aside.mkdir(mode=0o700)
    try:
        if not is_locked:
            raise OSError(f"no lock can be made beside {aside.name}")
        yield aside
    finally:
        shutil.rmtree(aside, ignore_errors=True)
        lock.unlock()


def remove_left_behind(folder: Path) -> None:
    names = {path.name.removesuffix(".lock") for path in folder.glob(f"{_PREFIX}*")}
    for name in filter(_NAME.fullmatch, names):
        aside = folder / name
        lock = _lock_of(aside)
        if not lock.tryLock(0):  # its process is running, here or on another computer
            continue
        if _holds_only_files(aside):
            shutil.rmtree(aside, ignore_errors=True)
        lock.unlock()


def _lock_of(aside: Path) -> QLockFile:
    lock = QLockFile(f"{aside}.lock")
    lock.setStaleLockTime(0)  # never stale by age, only if its process has ended
    return lock


def _holds_only_files(path: Path) -> bool:
    """Return whether a path is a folder of regular files only, as an export creates it."""
    try:
        is_folder = path.is_dir() and not path.is_symlink()
        return is_folder and all(
            each.is_file() and not each.is_symlink() for each in path.iterdir()
        )
    except OSError:
        return False


# matplotlib takes half a second to import: nothing here imports the export before it is used.


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
    path: Path | None = None  # the file of the only figure; None for the clipboard
    folder: Path | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Exported:
    job: ExportJob
    files: Sequence[Path] = ()
    png: bytes = b""


def export(job: ExportJob) -> Exported:
    """Write figures; what cannot be written complete is not there at all."""
    if job.folder is not None:
        return Exported(job, _write_all(job.folder, job.requests))
    (request,) = job.requests
    if job.path is not None:  # what takes a second to draw is refused before
        check_replaceable(job.path)
    drawing = request.draw()
    if job.path is not None:
        drawing.write(job.path, request.provenance(drawing))
        return Exported(job, (job.path,))
    from occ_model.figures.drawing import figure_bytes, house_style

    with house_style():
        return Exported(job, png=figure_bytes(drawing.draw(), "png", request.provenance(drawing)))


def _write_all(folder: Path, requests: Sequence[FigureRequest]) -> list[Path]:
    """Write a folder's figures beside their places first: a full disk leaves none."""
    from occ_model.figures.drawing import files_of, write_all

    is_new = not folder.exists()
    make_folder(folder)
    try:
        remove_left_behind(folder)
        with folder_aside(folder) as aside:
            pairs = [(request.draw(), request) for request in requests]
            drawn = {id(drawing): (drawing, request) for drawing, request in pairs}
            # Refused in a moment what takes seconds to draw.
            for drawing, _ in drawn.values():
                for path in files_of(drawing, folder):
                    check_replaceable(path)
            written = write_all(
                aside,
                [drawing for drawing, _ in drawn.values()],
                lambda drawing: drawn[id(drawing)][1].provenance(drawing),
            )
            return [path.replace(folder / path.name) for path in written]
    except OSError as error:
        raise OutputError(f"{folder} cannot be written to: {error.strerror or error}.") from None
    finally:
        if is_new and not any(folder.iterdir()):
            folder.rmdir()
