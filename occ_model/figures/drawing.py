"""Drawings, which are figures with tables of their numbers: style, tables, and files."""

import csv
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack
from dataclasses import dataclass
from io import BytesIO, StringIO
from itertools import chain
from pathlib import Path
from typing import Any

from matplotlib import rc_context, rcParamsDefault
from matplotlib.figure import Figure

from occ_model import colours
from occ_model.figures.page import fit_texts
from occ_model.files.writing import (
    check_ending,
    check_replaceable,
    make_folder,
    write_atomically,
    write_whole,
)
from occ_model.results.sweep_csv import switches_text
from occ_model.scene.provenance import ENDINGS, Provenance
from occ_model.scene.scene import SimulationSettings, unit_of

# The line styles differ too, so that the lines can be distinguished in grey.
SIMULATION = {"color": colours.SIMULATION, "linestyle": "-"}
BAND = {"color": colours.BAND, "linestyle": "--"}
PHOTO = {"color": colours.PHOTO, "linestyle": ":"}
THRESHOLD: dict[str, Any] = {"color": colours.THRESHOLD, "linestyle": "-.", "linewidth": 0.9}

TABLE_ENDING = ".csv"
FIGURE_ENDINGS = tuple(ending for ending in ENDINGS if ending != TABLE_ENDING)
PRINT_ENDINGS = (".pdf", ".png", TABLE_ENDING)  # of the files of a figure for print

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


def figure_bytes(figure: Figure, format_name: str, provenance: Provenance) -> bytes:
    """Fit a figure that was drawn in :func:`house_style` to its page, and return its file."""
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


@dataclass(frozen=True, eq=False, slots=True)
class Drawing:
    name: str  # The file's name without ending
    title: str
    draw: Callable[[], Figure]  # Draws the figure; to be called in house_style
    header: Sequence[str]
    rows: Callable[[], Iterable[Sequence[object]]]
    # Returns the provenance for a date, for a figure that is not of a single scene
    provenance: Callable[[str], Provenance] | None = None

    def encode(self, endings: Iterable[str], provenance: Provenance) -> Iterator[bytes]:
        """Yield the file of each ending: the figure, which is drawn once, or its table as CSV."""
        figure: Figure | None = None
        for ending in endings:
            if ending == TABLE_ENDING:
                yield table_text(self.header, self.rows(), provenance).encode("utf-8")
                continue
            with house_style():
                if figure is None:
                    fit_texts(figure := self.draw())
                content = encode_figure(figure, ending.removeprefix("."), provenance)
            yield content

    def write(self, path: Path, provenance: Provenance) -> None:
        """Write the figure, or its table as CSV, by the file's ending."""
        ending = check_ending(path, "a figure or table", ENDINGS)
        (content,) = self.encode((ending,), provenance)
        write_whole(path, content)


def write_all(
    folder: Path,
    drawings: Iterable[Drawing],
    provenance: Callable[[Drawing], Provenance],
    endings: Sequence[str] | None = None,
) -> list[Path]:
    """Write figures and their tables into a folder, either all of them or none.

    ``endings``: those of each drawing's files; None for all that there are.
    """
    make_folder(folder)
    endings = ENDINGS if endings is None else endings
    paths = {each: [folder / f"{each.name}{ending}" for ending in endings] for each in drawings}
    for path in chain(*paths.values()):
        check_replaceable(path)  # before any is drawn, which takes seconds
    with ExitStack() as stack:
        for drawing, files in paths.items():
            contents = drawing.encode(endings, provenance(drawing))
            for path, content in zip(files, contents, strict=True):
                stack.enter_context(write_atomically(path)).write_bytes(content)
    return list(chain(*paths.values()))


def settings_notes(settings: SimulationSettings) -> tuple[str, ...]:
    """Format a simulation's settings, without the seed, as lines of a provenance."""
    observable = settings.observable
    return (
        f"tolerance {settings.tolerance:g} {unit_of(observable)} of the {observable}",
        switches_text(settings.force),
    )


def table_text(
    header: Sequence[str], rows: Iterable[Sequence[object]], provenance: Provenance
) -> str:
    """Format a table as CSV text; None becomes an empty cell."""
    text = StringIO()
    for line in provenance.lines():
        text.write(f"# {line}".rstrip() + "\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    return text.getvalue()
