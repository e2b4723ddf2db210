"""The rows of a sweep's table, and its CSV.

The CSV starts with comment lines that state everything that determines the numbers. A row for each
point and decoder follows.
"""

import csv
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import StringIO

from occ_model.errors import ParameterError, quote
from occ_model.results.sweep_request import SweepPoint, SweepRequest
from occ_model.scene.parameter_kinds import ParameterValue, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.version import __version__


@dataclass(frozen=True, slots=True)
class SweepRow:
    point: Mapping[str, ParameterValue]  # The varied parameters, in SI units
    decoder: str
    right: int
    sent: int
    rate: float | None  # Percent; None if the model refuses the scene
    # The ends of the rate's 95 % interval, percent; None if the model refuses the scene
    low: float | None
    high: float | None
    note: str  # Why the model refuses the scene, or how often a plug-in has failed; else empty
    # Net bits a second of a video with another payload in every image; None if the model refuses
    # the scene
    bits_a_second: float | None


_FORMAT = 3

TITLE = "# Success rate over "  # at the start of every sweep's table


def header_text(request: SweepRequest) -> str:
    """Write everything that determines a table's numbers, and the titles of its columns."""
    settings = request.settings
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
        f"# {switches_text(settings.force)}",
    ]
    for name, values in request.axes.items():
        lines.append(f"# axis {column_title(name)}: {', '.join(map(format_value, values))}")
    lines += scene_comments(request.scene)
    return "\n".join(lines) + "\n" + csv_row(_columns(request))


def switches_text(force: Mapping[str, bool]) -> str:
    """Name the effects that the user has switched on or off."""
    forced = ", ".join(f"{name} {'on' if is_on else 'off'}" for name, is_on in force.items())
    return f"effects switched: {forced or 'none'}"


def scene_comments(scene: Scene) -> list[str]:
    """Return the comment lines from which a table's scene is read again."""
    lines = ["", "scene of this file:", *scene.to_toml().splitlines()]
    return [f"# {line}".rstrip() for line in lines]


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


def rows_of_point(
    request: SweepRequest, point: SweepPoint, intervals: Sequence[tuple[float, float]]
) -> Iterator[SweepRow]:
    """Yield the rates of a point, one for each decoder, with its interval in percent."""
    values = request.values(point.index)
    for column, (decoder, ends) in enumerate(
        zip(request.settings.decoders, intervals, strict=True)
    ):
        right, rate, low, high = point.right[column], None, None, None
        if point.sent:
            rate, (low, high) = 100.0 * right / point.sent, ends
        bits = request.bits_a_second(point, column)
        yield SweepRow(values, decoder, right, point.sent, rate, low, high, point.note, bits)


def point_text(
    request: SweepRequest, point: SweepPoint, intervals: Sequence[tuple[float, float]]
) -> str:
    """Write the rows of a point, with each decoder's interval in percent (NaN if refused)."""
    settings = request.settings
    text = ""
    for column, row in enumerate(rows_of_point(request, point, intervals)):
        results: list[object] = [None] * 7
        if row.sent:
            whole = point.whole[column]
            results = [row.right, row.sent, row.rate, row.low, row.high, whole, row.bits_a_second]
        values = map(format_value, row.point.values())
        text += csv_row([*values, row.decoder, settings.images, settings.seed, *results, row.note])
    return text


class PointReader:
    """Reads the texts of :func:`point_text`."""

    def __init__(self, request: SweepRequest) -> None:
        self._request = request
        self._axes = [
            {format_value(value): index for index, value in enumerate(values)}
            for values in request.axes.values()
        ]

    def read(self, lines: Sequence[str], number: int) -> SweepPoint | None:
        """Parse a point's rows, one for each decoder; the caller writes them again to verify.

        ``number``: the number of the first line. Returns None if they are not rows of this sweep;
        raises ParameterError for an impossible count.
        """
        first = len(self._axes) + 3
        try:
            rows = [next(csv.reader([line], strict=True)) for line in lines]
            index = 0
            for indices, text in zip(self._axes, rows[0], strict=False):
                index = index * len(indices) + indices[text]
            cells = [(row[first], row[first + 1], row[first + 5], row[first + 7]) for row in rows]
        except (LookupError, StopIteration, csv.Error):
            return None
        (_, sent, _, note), *_ = cells
        if not sent and note:  # the model refuses the scene
            return SweepPoint(index, 0, (0,) * len(rows), note, (0,) * len(rows))
        images, bits = self._request.settings.images, self._request.bits_sent(index)
        right, whole = [], []
        for line, (right_bits, sent_bits, read_whole, _) in enumerate(cells, number):
            read_count("sent bits", sent_bits, images * bits, images * bits, line)
            whole.append(read_count("images read whole", read_whole, 0, images, line))
            min_right = whole[-1] * bits  # every other image has a wrong bit
            max_right = min_right + (images - whole[-1]) * (bits - 1)
            right.append(read_count("right bits", right_bits, min_right, max_right, line))
        return SweepPoint(index, images * bits, tuple(right), note, tuple(whole))


def read_count(name: str, text: str, least: int, most: int, line: int) -> int:
    """Parse a count of a table; raises a ParameterError with the line if it is out of range."""
    is_count = text.isascii() and text.isdigit() and len(text) <= len(str(most))
    if is_count and least <= int(text) <= most:
        return int(text)
    allowed = str(most) if least == most else f"{least} to {most}"
    raise ParameterError.of(name, quote(text), allowed).within(f"line {line}")


def join_lines(sentence: str) -> str:
    """Write a sentence on one line, as tables are read line by line."""
    return " ".join(sentence.split())


def format_value(value: ParameterValue) -> str:
    return value if isinstance(value, str) else repr(value)


def csv_row(cells: Iterable[object]) -> str:
    """Write a line of a CSV table; None and NaN become empty cells."""
    text = StringIO()
    csv.writer(text, lineterminator="\n").writerow(
        "" if isinstance(cell, float) and math.isnan(cell) else cell for cell in cells
    )
    return text.getvalue()
