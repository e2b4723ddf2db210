"""The table of a sweep: a success rate for each point and decoder."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.errors import ParameterError, shown
from occ_model.files.writing import write_whole
from occ_model.results.sweep_csv import header_text, point_text
from occ_model.results.sweep_request import SweepPoint, SweepRequest
from occ_model.scene.parameter_kinds import ParameterValue


@dataclass(frozen=True, slots=True)
class SweepRow:
    """One success rate."""

    point: Mapping[str, ParameterValue]  # The varied parameters, in SI units
    decoder: str
    right: int
    sent: int
    rate: float | None  # Percent; None where the model refuses the scene
    # The ends of the rate's 95 % interval, percent; None where the model refuses the scene
    low: float | None
    high: float | None
    note: str  # Why the model refuses the scene; empty where it does not
    # Net bits a second of a video whose every image shows another payload; None where the model
    # refuses the scene
    bits_a_second: float | None


@dataclass(frozen=True, eq=False, slots=True)
class SweepTable:
    """Success rates over all combinations of some parameters' values.

    Two tables are equal when their requests, numbers and notes are.

    Parameters
    ----------
    request
        The sweep that was measured.
    sent : ndarray of int64, shape (values of the first axis, of the second, ...)
        Bits sent at each point; 0 where the model refuses the scene.
    right : ndarray of int64, shape (..., decoders)
        Bits of them that were read rightly.
    low, high : ndarray of float64, shape (..., decoders)
        The 95 % interval, percent, which counts images, as bits of one image fail together; not a
        number where the model refuses the scene.
    notes
        Why the model refuses a scene, by the point's index, the last axis running fastest.
    whole : ndarray of int64, shape (..., decoders)
        Images of which every bit was read rightly.
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
        """All rates, one a point and decoder, in the order of the axes."""
        return tuple(self.each_row())

    def each_row(self) -> Iterator[SweepRow]:
        """Yield the rows one by one: those of a large table need not fit in memory."""
        for point in self.each_point():
            values = self.request.values(point.index)
            place = np.unravel_index(point.index, self.request.shape)
            for number, decoder in enumerate(self.decoders):
                rate = low = high = None
                if point.sent:
                    rate = 100.0 * point.right[number] / point.sent
                    low, high = float(self.low[place][number]), float(self.high[place][number])
                yield SweepRow(
                    values, decoder, point.right[number], point.sent, rate, low, high, point.note,
                    self.request.bits_a_second(point, number),
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
            The decoder's name, by default that of the first.

        Returns
        -------
        ndarray of float64, shape (values of the first axis, of the second, ...)
            Not a number where the model refuses the scene.

        Raises
        ------
        ParameterError
            The sweep has not used that decoder.
        """
        rates = np.full(self.sent.shape, np.nan)
        right = 100.0 * self.right[..., self._place(decoder)]
        np.divide(right, self.sent, out=rates, where=self.sent > 0)
        return rates

    def bits_a_second(self, decoder: str | None = None) -> FloatArray:
        """Return the net bits a second of a decoder, in the shape of :meth:`rates`.

        Not a number where the model refuses the scene.
        """
        place = self._place(decoder)
        found = [self.request.bits_a_second(point, place) for point in self.each_point()]
        numbers = [math.nan if one is None else one for one in found]
        return np.array(numbers).reshape(self.sent.shape)

    def intervals(self, decoder: str | None = None) -> tuple[FloatArray, FloatArray]:
        """Return the ends of the 95 % intervals of :meth:`rates`, percent, in the same shape."""
        place = self._place(decoder)
        return self.low[..., place], self.high[..., place]

    def _place(self, decoder: str | None) -> int:
        if decoder is None:
            return 0
        if decoder not in self.decoders:
            raise ParameterError.of(
                "decoder", shown(decoder), ", ".join(self.decoders), condition="in this table"
            )
        return self.decoders.index(decoder)

    def csv(self) -> Iterator[str]:
        """Yield the table as CSV, in parts: its provenance in comment lines, then a row a rate."""
        yield header_text(self.request)
        low = self.low.reshape(-1, len(self.decoders)).tolist()
        high = self.high.reshape(-1, len(self.decoders)).tolist()
        for point in self.each_point():
            ends = list(zip(low[point.index], high[point.index], strict=True))
            yield point_text(self.request, point, ends)

    def to_csv(self, path: str | Path) -> None:
        """Write the table as :meth:`csv` gives it.

        Raises
        ------
        OutputError
            The file cannot be written; a file that was there before is unchanged.
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
