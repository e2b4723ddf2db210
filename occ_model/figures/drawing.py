"""Drawings, which are figures with tables of their numbers: style, tables, and files."""

import csv
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager, ExitStack
from dataclasses import dataclass
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any

from matplotlib import rc_context, rcParamsDefault
from matplotlib.figure import Figure

from occ_model import colours
from occ_model.errors import OutputError, one_line
from occ_model.figures.page import fit_texts
from occ_model.files.writing import make_folder, write_atomically, write_whole
from occ_model.scene.provenance import Provenance
from occ_model.scene.scene import SimulationSettings, unit_of

# The line styles differ too, so that the lines can be distinguished in grey.
SIMULATION = {"color": colours.SIMULATION, "linestyle": "-"}
BAND = {"color": colours.BAND, "linestyle": "--"}
PHOTO = {"color": colours.PHOTO, "linestyle": ":"}
THRESHOLD: dict[str, Any] = {"color": colours.THRESHOLD, "linestyle": "-.", "linewidth": 0.9}

FORMATS = ("png", "svg", "pdf")  # the file formats of a figure

ENDINGS = (*(f".{name}" for name in FORMATS), ".csv")  # of a drawing's file

STYLE: dict[Any, Any] = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "figure.constrained_layout.use": True,
    "figure.dpi": 200,
    "pdf.fonttype": 42,
    "svg.hashsalt": "occ_model",  # the same figure gives the same file
}


def house_style() -> AbstractContextManager[None]:
    """Return a context in which all figures have one style, regardless of the user's settings."""
    parameters = dict[Any, Any](rcParamsDefault) | STYLE
    # These figures become files, and the backend matters only for windows.
    del parameters["backend"]
    return rc_context(parameters)


def write_figure(path: Path, figure: Figure, provenance: Provenance) -> None:
    """Write a figure that was drawn in :func:`house_style`, in the format of the file's ending."""
    write_whole(path, figure_bytes(figure, figure_format(path), provenance))


def figure_format(path: Path) -> str:
    ending = path.suffix.lower().removeprefix(".")
    if ending not in FORMATS:
        raise OutputError(
            f"{one_line(path.name)} does not have the ending of a figure; use .png, .svg or .pdf."
        )
    return ending


def figure_bytes(figure: Figure, format_name: str, provenance: Provenance) -> bytes:
    fit_texts(figure)
    return encode_figure(figure, format_name, provenance)


def encode_figure(figure: Figure, format_name: str, provenance: Provenance) -> bytes:
    title, text = provenance.title, provenance.text()
    metadata: dict[str, dict[str, str | None]] = {
        "pdf": {"Title": title, "Subject": text, "CreationDate": None},
        "svg": {"Title": title, "Description": text, "Date": None},
        "png": {"Title": title, "Description": text},
    }
    buffer = BytesIO()
    figure.savefig(buffer, format=format_name, metadata=metadata[format_name])
    return buffer.getvalue()


def save_figure(figure: Figure, folder: Path, name: str, provenance: Provenance) -> None:
    """Write a figure that was drawn in :func:`house_style` as PDF and PNG."""
    fit_texts(figure)
    for ending in ("pdf", "png"):
        write_whole(folder / f"{name}.{ending}", encode_figure(figure, ending, provenance))


@dataclass(frozen=True, eq=False, slots=True)
class Drawing:
    name: str  # The file's name without ending
    title: str
    draw: Callable[[], Figure]  # Draws the figure; to be called in house_style
    header: Sequence[str]
    rows: Callable[[], Iterable[Sequence[object]]]
    # Returns the provenance for a date, for a figure that is not of a single scene
    provenance: Callable[[str], Provenance] | None = None

    def write(self, path: Path, provenance: Provenance) -> None:
        """Write the figure, or its table as CSV, by the file's ending."""
        ending = path.suffix.lower()
        if ending not in ENDINGS:
            raise OutputError(
                f"{one_line(path.name)} does not have the ending of a figure or table; "
                f"use {', '.join(ENDINGS)}."
            )
        if ending == ".csv":
            write_table(path, self.header, self.rows(), provenance)
            return
        with house_style():
            write_figure(path, self.draw(), provenance)


def files_of(drawing: Drawing, folder: Path) -> list[Path]:
    return [folder / f"{drawing.name}{ending}" for ending in ENDINGS]


def write_all(
    folder: Path, drawings: Iterable[Drawing], provenance: Callable[[Drawing], Provenance]
) -> list[Path]:
    """Write figures and their tables into a folder, either all of them or none."""
    make_folder(folder)
    paths: list[Path] = []
    with ExitStack() as stack:
        for drawing in drawings:
            origin = provenance(drawing)
            with house_style():
                fit_texts(figure := drawing.draw())
                for path in files_of(drawing, folder):
                    content = (
                        table_text(drawing.header, drawing.rows(), origin).encode("utf-8")
                        if path.suffix == ".csv"
                        else encode_figure(figure, figure_format(path), origin)
                    )
                    stack.enter_context(write_atomically(path)).write_bytes(content)
                    paths.append(path)
    return paths


def settings_notes(settings: SimulationSettings) -> tuple[str, ...]:
    """Format a simulation's settings, without the seed, as lines of a provenance."""
    forced = ", ".join(f"{name} {'on' if on else 'off'}" for name, on in settings.force.items())
    observable = settings.observable
    return (
        f"tolerance {settings.tolerance:g} {unit_of(observable)} of the {observable}",
        f"effects switched: {forced or 'none'}",
    )


def write_table(
    path: Path, header: Sequence[str], rows: Iterable[Sequence[object]], provenance: Provenance
) -> None:
    """Write a table as CSV; None becomes an empty cell."""
    write_whole(path, table_text(header, rows, provenance).encode("utf-8"))


def table_text(
    header: Sequence[str], rows: Iterable[Sequence[object]], provenance: Provenance
) -> str:
    """Format a table as CSV text; the arguments are those of :func:`write_table`."""
    text = StringIO()
    for line in provenance.lines():
        text.write(f"# {line}".rstrip() + "\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    return text.getvalue()
