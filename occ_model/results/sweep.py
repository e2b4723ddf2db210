"""The table of a sweep, with a success rate for each point and decoder, and its CSV.

The CSV starts with comment lines that state everything that determines the numbers. A row for each
point and decoder follows.
"""

import csv
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.errors import ParameterError, inflect, quote
from occ_model.files.writing import write_whole
from occ_model.results.sweep_request import SweepPoint, SweepRequest
from occ_model.scene.parameter_kinds import ParameterValue, Quantity
from occ_model.scene.parameters import PARAMETERS
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


@dataclass(frozen=True, eq=False, slots=True)
class SweepTable:
    """Success rates over all combinations of some parameters' values.

    Two tables are equal if their requests, counts and notes are equal.

    Parameters
    ----------
    request
        The request that was measured.
    sent : ndarray of int64, shape (values of the first axis, of the second, ...)
        Bits sent at each point; 0 if the model refuses the scene.
    right : ndarray of int64, shape (..., decoders)
        Number of these bits that were read correctly.
    low, high : ndarray of float64, shape (..., decoders)
        The 95 % interval in percent, based on the number of images, as the bits of an image fail
        together; NaN if the model refuses the scene.
    notes
        Why the model refuses a scene, or how often a plug-in has failed, by the point's index (the
        last axis runs fastest).
    whole : ndarray of int64, shape (..., decoders)
        Number of images in which every bit was read correctly.
    """

    request: SweepRequest
    sent: IndexArray
    right: IndexArray
    low: FloatArray
    high: FloatArray
    notes: Mapping[int, str]
    whole: IndexArray

    @property
    def axes(self) -> Mapping[str, tuple[ParameterValue, ...]]:
        """The values of each varied parameter."""
        return self.request.axes

    @property
    def decoders(self) -> tuple[str, ...]:
        """The decoders' names."""
        return self.request.settings.decoders

    @property
    def rows(self) -> tuple[SweepRow, ...]:
        """All rates, one for each point and decoder, in the order of the axes."""
        return tuple(self.each_row())

    def each_row(self) -> Iterator[SweepRow]:
        """Yield the rows one by one, as those of a large table may not fit into memory."""
        for point in self.each_point():
            values = self.request.values(point.index)
            indices = np.unravel_index(point.index, self.request.shape)
            for column, decoder in enumerate(self.decoders):
                rate = low = high = None
                if point.sent:
                    rate = 100.0 * point.right[column] / point.sent
                    low, high = float(self.low[indices][column]), float(self.high[indices][column])
                yield SweepRow(
                    values, decoder, point.right[column], point.sent, rate, low, high, point.note,
                    self.request.bits_a_second(point, column),
                )  # fmt: skip

    def each_point(self) -> Iterator[SweepPoint]:
        """Yield the counts point by point, in the order of the axes."""
        right = self.right.reshape(-1, len(self.decoders))
        whole = self.whole.reshape(-1, len(self.decoders))
        for index, sent in enumerate(self.sent.ravel().tolist()):
            counts = tuple(right[index].tolist())
            note = self.notes.get(index, "")
            yield SweepPoint(index, sent, counts, note, tuple(whole[index].tolist()))

    def rates(self, decoder: str | None = None) -> FloatArray:
        """Return the success rates of a decoder in percent.

        Parameters
        ----------
        decoder
            The decoder's name; by default that of the first decoder.

        Returns
        -------
        ndarray of float64, shape (values of the first axis, of the second, ...)
            Not a number where the model refuses the scene.

        Raises
        ------
        ParameterError
            The sweep did not use that decoder.
        """
        rates = np.full(self.sent.shape, np.nan)
        right = 100.0 * self.right[..., self._decoder_index(decoder)]
        np.divide(right, self.sent, out=rates, where=self.sent > 0)
        return rates

    def bits_a_second(self, decoder: str | None = None) -> FloatArray:
        """Return the net bits a second of a decoder, in the shape of :meth:`rates`.

        Not a number where the model refuses the scene.
        """
        column = self._decoder_index(decoder)
        rates = [self.request.bits_a_second(point, column) for point in self.each_point()]
        numbers = [math.nan if rate is None else rate for rate in rates]
        return np.array(numbers).reshape(self.sent.shape)

    def intervals(self, decoder: str | None = None) -> tuple[FloatArray, FloatArray]:
        """Return the ends of the 95 % intervals of :meth:`rates`, in percent, in the same shape."""
        column = self._decoder_index(decoder)
        return self.low[..., column], self.high[..., column]

    @property
    def faults(self) -> str:
        """A sentence on the points at which a plug-in has failed; empty if none has."""
        sent = self.sent.ravel()
        fault_notes = [note for index, note in self.notes.items() if sent[index]]
        return f"At {inflect(len(fault_notes), 'point')}: {fault_notes[0]}" if fault_notes else ""

    def _decoder_index(self, decoder: str | None) -> int:
        if decoder is None:
            return 0
        if decoder not in self.decoders:
            raise ParameterError.of(
                "decoder", quote(decoder), ", ".join(self.decoders), condition="in this table"
            )
        return self.decoders.index(decoder)

    def csv(self) -> Iterator[str]:
        """Yield the CSV in parts: comment lines on the table's origin, then rows of rates."""
        yield header_text(self.request)
        low = self.low.reshape(-1, len(self.decoders)).tolist()
        high = self.high.reshape(-1, len(self.decoders)).tolist()
        for point in self.each_point():
            ends = list(zip(low[point.index], high[point.index], strict=True))
            yield point_text(self.request, point, ends)

    def to_csv(self, path: str | Path) -> None:
        """Write the table as CSV (see :meth:`csv`).

        Raises
        ------
        OutputError
            The file cannot be written; an existing file is unchanged.
        """
        write_whole(Path(path), "".join(self.csv()).encode("utf-8"))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, SweepTable):
            return NotImplemented
        return (
            self.request == other.request
            and list(self.axes) == list(other.axes)
            and np.array_equal(self.sent, other.sent)
            and np.array_equal(self.right, other.right)
            and np.array_equal(self.whole, other.whole)
            and dict(self.notes) == dict(other.notes)
        )


_FORMAT = 3

TITLE = "# Success rate over "  # at the start of every sweep's table


def header_text(request: SweepRequest) -> str:
    """Write everything that determines a table's numbers, and the titles of its columns."""
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
        f"# effects switched: {forced or 'none'}",
    ]
    for name, values in request.axes.items():
        lines.append(f"# axis {column_title(name)}: {', '.join(map(format_value, values))}")
    lines += ["#", "# scene of this file:"]
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
    """Write the rows of a point, with each decoder's interval in percent (NaN if refused)."""
    settings = request.settings
    values = [format_value(value) for value in request.values(point.index).values()]
    text = ""
    for column, (decoder, ends) in enumerate(zip(settings.decoders, intervals, strict=True)):
        results: list[object] = [None] * 7
        if point.sent:
            right, bits = point.right[column], request.bits_a_second(point, column)
            results = [
                right,
                point.sent,
                100.0 * right / point.sent,
                *ends,
                point.whole[column],
                bits,
            ]
        text += csv_row([*values, decoder, settings.images, settings.seed, *results, point.note])
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
