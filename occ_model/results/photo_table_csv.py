"""Write the table of several photos as CSV: comment lines, then one row a photo."""

from collections.abc import Sequence

from occ_model.errors import one_line, printable
from occ_model.results.photo_table import SURE, CombinedEstimate, PhotoTable
from occ_model.results.sweep_csv import csv_row
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import quantity
from occ_model.version import __version__

_MAX_TEXT_LENGTH = 10_000  # maximum characters of a text; a path has fewer

_COLUMNS = (
    "file", "verdict", "in the mean", "readout time (s)", "its error (s)",
    "switching frequency (Hz)", "its error (Hz)", "exposure time (s)", "its error (s)",
    "exposure time is", "rests on", "noted exposure time (s)", "correlation", "chips", "lines",
    "camera", "note",
)  # fmt: skip


def csv_text(table: PhotoTable, more: Sequence[str] = (), condition: str = "") -> str:
    """Write a table; ``condition``: what estimates rest on, as ``"if f = 10 kHz: "``, or empty."""
    counts = ", ".join(
        f"{table.count(v)} {v}" for v in dict.fromkeys(r.verdict for r in table.rows)
    )
    lines = [
        f"# Match of {len(table.rows)} photos: {counts}",
        f"# occ_model {__version__}",
        f"# measured: {table.estimate}",
        *_mean(table.estimate, table.estimated, condition),
        *_mean("exposure_time", table.exposure_time, condition),
        *(f"# {printable(note)}" for note in (*table.notes, *more)),
        "#",
        "# scene at hand:",
        *(f"# {line}".rstrip() for line in table.scene.to_toml().splitlines()),
    ]
    return "\n".join(lines) + "\n" + csv_row(_COLUMNS) + "".join(_photo_rows(table, condition))


def _photo_rows(table: PhotoTable, condition: str) -> list[str]:
    texts = []
    known = quantity(table.known)
    of_scene = _given(known, float(table.scene.value(table.known)))
    rests_on = condition.removesuffix(": ") or of_scene
    for place, row in enumerate(table.rows):
        kept = "outlier" if table.is_outlier(place) else "yes" if table.is_counted(place) else "no"
        estimates: list[object] = []
        for name in ("readout_time", "switching_frequency", "exposure_time"):
            estimates += [getattr(row, name), _error(row.uncertainty(name))]
        own = rests_on if row.given is None else _given(known, row.given)
        estimates += [row.exposure_verdict, None if row.match is None else own]
        texts.append(
            csv_row(
                [_text(str(row.path)), row.verdict, kept, *estimates, row.noted_exposure,
                 row.correlation, row.pattern, row.lines or None, _text(row.camera or ""),
                 _text(row.note)]
            )
        )  # fmt: skip
    return texts


def _given(known: Quantity, value: float) -> str:
    return f"{known.symbol} = {known.format(value)}, given"


def _mean(name: str, found: CombinedEstimate | None, condition: str) -> list[str]:
    if found is None:
        return [f"# no mean of {name}"]
    value = quantity(name).unit.rounded_estimate(found.value, found.uncertainty)
    photos, left_out = _counted(found.count, f"{SURE} photo"), len(found.outliers)
    lines = [
        f"# mean of {name}: {condition}{value!r} +- {_error(found.uncertainty)}, from "
        f"{photos}, {_counted(left_out, 'outlier')}"
    ]
    if found.count > 1:
        lines.append(
            f"# chi-square of {name}: {found.chi_square:.4g} of "
            f"{_counted(found.degrees_of_freedom, 'degree')} of freedom, probability "
            f"{found.probability:.3g}, error widened {found.scale:.3g} times"
        )
    return lines


def _counted(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"


def _error(deviation: float | None) -> str | None:
    """Write a standard deviation to two digits, as in the window."""
    return None if deviation is None else f"{deviation:.1e}"


_FORMULA = "=+-@\uff1d\uff0b\uff0d\uff20"  # first of a spreadsheet's formula, also full-width


def _text(text: str) -> str:
    """Return a text from a file, quoted so that no spreadsheet evaluates it."""
    text = one_line(text, _MAX_TEXT_LENGTH)
    return f"'{text}" if text.startswith(tuple(_FORMULA)) else text
