"""Write the table of several photos as CSV: comment lines, then one row a photo."""

import csv
from collections.abc import Sequence
from io import StringIO

from occ_model.errors import one_line, printable
from occ_model.results.photo_table import SURE, CombinedEstimate, PhotoTable
from occ_model.version import __version__

_LONGEST = 10_000
"""Characters of a text; a path has fewer."""

_COLUMNS = (
    "file", "verdict", "in the mean", "readout time (s)", "its error (s)",
    "switching frequency (Hz)", "its error (Hz)", "exposure time (s)", "its error (s)",
    "noted exposure time (s)", "correlation", "chips", "lines", "camera", "note",
)  # fmt: skip


def csv_text(table: PhotoTable, more: Sequence[str] = ()) -> str:
    """Write a table.

    Parameters
    ----------
    table
        The table.
    more
        Further comment lines.
    """
    counts = ", ".join(
        f"{table.count(v)} {v}" for v in dict.fromkeys(r.verdict for r in table.rows)
    )
    lines = [
        f"# Match of {len(table.rows)} photos: {counts}",
        f"# occ_model {__version__}",
        f"# measured: {table.estimate}",
        *_mean(table.estimate, table.estimated),
        *_mean("exposure_time", table.exposure_time),
        *(f"# {printable(note)}" for note in (*table.notes, *more)),
        "#",
        "# scene at hand:",
        *(f"# {line}".rstrip() for line in table.scene.to_toml().splitlines()),
    ]
    return "\n".join(lines) + "\n" + _row(_COLUMNS) + "".join(_photo_rows(table))


def _photo_rows(table: PhotoTable) -> list[str]:
    texts = []
    for place, row in enumerate(table.rows):
        kept = "outlier" if table.is_outlier(place) else "yes" if table.is_counted(place) else "no"
        estimates: list[object] = []
        for name in ("readout_time", "switching_frequency", "exposure_time"):
            estimates += [getattr(row, name), row.uncertainty(name)]
        texts.append(
            _row(
                [_text(str(row.path)), row.verdict, kept, *estimates, row.noted_exposure,
                 row.correlation, row.pattern, row.lines or None, _text(row.camera or ""),
                 _text(row.note)]
            )
        )  # fmt: skip
    return texts


def _mean(name: str, found: CombinedEstimate | None) -> list[str]:
    if found is None:
        return [f"# no mean of {name}"]
    return [
        f"# mean of {name}: {found.value!r} +- {found.uncertainty!r}, from {found.count} {SURE} "
        f"photos, {len(found.outliers)} outliers",
        f"# chi-square of {name}: {found.chi_square:.4g} of {found.degrees_of_freedom} degrees of "
        f"freedom, probability {found.probability:.3g}, error widened {found.scale:.3g} times",
    ]


_FORMULA = "=+-@\uff1d\uff0b\uff0d\uff20"
"""Letters that begin a formula in a spreadsheet, also those of full width."""


def _text(text: str) -> str:
    """Write a text of a file, such as its camera's name, which no spreadsheet calculates."""
    text = one_line(text, _LONGEST)
    return f"'{text}" if text.startswith(tuple(_FORMULA)) else text


def _row(cells: Sequence[object]) -> str:
    text = StringIO()
    csv.writer(text, lineterminator="\n").writerow("" if cell is None else cell for cell in cells)
    return text.getvalue()
