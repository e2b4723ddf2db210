"""The table of a sweep, with a success rate for each point and decoder."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.errors import ParameterError, inflect, quote
from occ_model.files.writing import write_whole
from occ_model.results.sweep_csv import SweepRow, header_text, point_text, rows_of_point
from occ_model.results.sweep_request import SweepPoint, SweepRequest
from occ_model.scene.parameter_kinds import ParameterValue


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
            yield from rows_of_point(self.request, point, self._intervals_at(point.index))

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

    def _intervals_at(self, index: int) -> list[tuple[float, float]]:
        place = np.unravel_index(index, self.request.shape)
        return list(zip(self.low[place].tolist(), self.high[place].tolist(), strict=True))

    def csv(self) -> Iterator[str]:
        """Yield the CSV in parts: comment lines on the table's origin, then rows of rates."""
        yield header_text(self.request)
        for point in self.each_point():
            yield point_text(self.request, point, self._intervals_at(point.index))

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
