"""The wiring's figure and a board's files, made off the window's thread."""

from dataclasses import dataclass
from pathlib import Path

from occ_model.boards.transmission import Transmission
from occ_model.errors import OutputError, one_line
from occ_model.files.writing import make_folder

# matplotlib takes half a second to import: nothing here imports a figure before it is drawn.

_MOST_FOLDERS = 1000


@dataclass(frozen=True, eq=False, slots=True)
class Drawn:
    """The figure of a wiring as PNG, and its text for those who do not see it."""

    sent: Transmission
    png: bytes
    text: str


@dataclass(frozen=True, eq=False, slots=True)
class Saved:
    """The folder that was written, how many files, and why there is no WAV file, if so."""

    folder: Path
    files: int
    missing: str


def draw_wiring(sent: Transmission) -> Drawn:
    from occ_model.figures.transmitter_files import wiring_bytes
    from occ_model.figures.wiring import notes

    return Drawn(sent, wiring_bytes(sent, "png"), "\n".join(notes(sent)))


@dataclass(frozen=True, eq=False, slots=True)
class SaveJob:
    """What is sent, and the folder in which a new one is made for it."""

    sent: Transmission
    parent: Path


def save_files(job: SaveJob) -> Saved:
    from occ_model.figures.transmitter_files import write_transmitter_files

    folder = new_folder(job.parent, f"blink-{job.sent.board.name}")
    paths, missing = write_transmitter_files(folder, job.sent)
    return Saved(folder, len(paths), missing)


def new_folder(parent: Path, name: str) -> Path:
    """Make a folder of a name, with a number after it where there is one already."""
    for number in range(1, _MOST_FOLDERS):
        folder = parent / (name if number == 1 else f"{name}-{number}")
        if not folder.exists():
            make_folder(folder)
            return folder
    raise OutputError(
        f"{one_line(str(parent))} has {_MOST_FOLDERS - 1:,} folders {name} already; choose another "
        "folder."
    )
