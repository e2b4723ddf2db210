"""A drawing: a figure and the numbers in it, to be written in whatever format is asked for."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from matplotlib.figure import Figure

from occ_model.errors import OutputError
from occ_model.figures.drawing import FORMATS, house_style, write_figure
from occ_model.figures.table import write_table
from occ_model.files.writing import make_folder
from occ_model.scene.provenance import Provenance

ENDINGS = (*(f".{name}" for name in FORMATS), ".csv")
"""The endings of the files that a drawing is written to."""


@dataclass(frozen=True, eq=False, slots=True)
class Drawing:
    """A figure and the numbers in it.

    Parameters
    ----------
    name
        The file's name without ending.
    title
        What it shows.
    draw
        Draws it, to be called in the house style.
    header
        Names of the table's columns, with units.
    rows
        Gives the table's rows.
    """

    name: str
    title: str
    draw: Callable[[], Figure]
    header: Sequence[str]
    rows: Callable[[], Iterable[Sequence[object]]]

    def write(self, path: Path, provenance: Provenance) -> None:
        """Write it in the format that the file's ending names, its provenance inside.

        Raises
        ------
        OutputError
            The ending names none, or the file cannot be written.
        """
        ending = path.suffix.lower()
        if ending not in ENDINGS:
            raise OutputError(
                f"{path.name} has no ending of a figure or table; use {', '.join(ENDINGS)}."
            )
        if ending == ".csv":
            write_table(path, self.header, self.rows(), provenance)
            return
        with house_style():
            write_figure(path, self.draw(), provenance)


def write_all(
    folder: Path, drawings: Iterable[Drawing], provenance: Callable[[Drawing], Provenance]
) -> list[Path]:
    """Write drawings in all formats into a folder, which is made where there is none.

    Parameters
    ----------
    folder
        Where to.
    drawings
        The drawings.
    provenance
        Gives the provenance of each.

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    OutputError
        The folder cannot be made, or a file cannot be written.
    """
    make_folder(folder)
    written = []
    for drawing in drawings:
        for ending in ENDINGS:
            path = folder / f"{drawing.name}{ending}"
            drawing.write(path, provenance(drawing))
            written.append(path)
    return written
