"""Write and read a sweep's table as CSV: comment lines, then one row a point and decoder."""

import csv
import math
from collections.abc import Iterable, Sequence
from io import StringIO

from occ_model.results.sweep_request import SweepPoint, SweepRequest
from occ_model.scene.parameter_kinds import ParameterValue, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.version import __version__

_FORMAT = 3

TITLE = "# Success rate over "  # the beginning of every sweep's table


def header_text(request: SweepRequest) -> str:
    """Write all that determines a table's numbers, and the names of its columns."""
    settings = request.settings
    forced = ", ".join(f"{name} {'on' if on else 'off'}" for name, on in settings.force.items())
    lines = [
        f"{TITLE}{', '.join(request.axes)}",
        f"# occ_model {__version__}",
        f"# format {_FORMAT} of a sweep",
        f"# seed {settings.seed}, of every point",
        f"# images {settings.images}, at every point",
        f"# decoders {', '.join(settings.decoders)}",
        f"# path {settings.path}",
        f"# images a second {settings.frames_a_second!r}",
        f"# tolerance {settings.tolerance!r} levels of the profile",
        f"# by hand: {forced or 'nothing'}",
    ]
    for name, values in request.axes.items():
        lines.append(f"# axis {column_title(name)}: {', '.join(map(written, values))}")
    lines += ["#", "# scene at hand:"]
    lines += [f"# {line}".rstrip() for line in request.scene.to_toml().splitlines()]
    return "\n".join(lines) + "\n" + csv_row(_columns(request))


def _columns(request: SweepRequest) -> list[str]:
    return [
        *map(column_title, request.axes), "decoder", "images", "seed", "right bits", "sent bits",
        "success rate (%)", "95 % from (%)", "95 % to (%)", "images read whole", "bits a second",
        "note",
    ]  # fmt: skip


def column_title(name: str) -> str:
    parameter = PARAMETERS[name]
    unit = parameter.unit.symbol if isinstance(parameter, Quantity) else ""
    return f"{name} ({unit})" if unit else name


def point_text(
    request: SweepRequest, point: SweepPoint, intervals: Sequence[tuple[float, float]]
) -> str:
    """Write the rows of a point with each decoder's interval, percent; nan where refused."""
    settings = request.settings
    values = [written(value) for value in request.values(point.index).values()]
    text = ""
    for place, (decoder, ends) in enumerate(zip(settings.decoders, intervals, strict=True)):
        found: list[object] = [None] * 7
        if point.sent:
            right, bits = point.right[place], request.bits_a_second(point, place)
            found = [right, point.sent, 100.0 * right / point.sent, *ends, point.whole[place], bits]
        text += csv_row([*values, decoder, settings.images, settings.seed, *found, point.note])
    return text


class PointReader:
    """Reads the text that :func:`point_text` writes."""

    def __init__(self, request: SweepRequest) -> None:
        self._axes = [
            {written(value): place for place, value in enumerate(values)}
            for values in request.axes.values()
        ]

    def read(self, lines: Sequence[str]) -> SweepPoint | None:
        """Read the rows of a point, one line a decoder; None where they cannot be read.

        The caller writes the point again and compares.
        """
        first = len(self._axes) + 3
        try:
            rows = [next(csv.reader([line], strict=True)) for line in lines]
            index = 0
            for places, text in zip(self._axes, rows[0], strict=False):
                index = index * len(places) + places[text]
            right = tuple(int(row[first] or 0) for row in rows)
            whole = tuple(int(row[first + 5] or 0) for row in rows)
            return SweepPoint(index, int(rows[0][first + 1] or 0), right, rows[0][-1], whole)
        except (ValueError, LookupError, StopIteration, csv.Error):
            return None


def one_line(sentence: str) -> str:
    """Write a sentence in one line: tables are read line by line."""
    return " ".join(sentence.split())


def written(value: ParameterValue) -> str:
    return value if isinstance(value, str) else repr(value)


def csv_row(cells: Iterable[object]) -> str:
    """Return a line of a CSV table; a cell that is None or not a number is empty."""
    text = StringIO()
    csv.writer(text, lineterminator="\n").writerow(
        "" if isinstance(cell, float) and math.isnan(cell) else cell for cell in cells
    )
    return text.getvalue()
