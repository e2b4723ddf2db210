"""The light's waveform: periodic and piecewise constant, with an exact running integral.

The unit of time is the mean length of a piece, so that a period has as many units as pieces. Pieces
of equal length, such as chips, last one unit each. Light is counted in lit units: the panel fully
lit for one unit.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, IndexArray
from occ_model.light.times import Duration, ExposureWindows, PhasesInPeriod

Exact = NDArray[Any]  # integers or fractions


class Waveform:
    """One period of light that repeats, constant on each of its pieces.

    Parameters
    ----------
    levels
        Light of each piece, 1 being the panel fully lit.
    lengths
        Length of each piece, above 0, in any unit of time; if empty, all are equally long.
    """

    def __init__(self, levels: Sequence[float] | NDArray[Any], lengths: Sequence[Fraction] = ()):
        self.period = count = len(levels)  # in units: as many as pieces
        is_even = len(set(lengths)) <= 1
        values = np.asarray(levels)
        # Exact: integers, which are fast, where possible; fractions otherwise.
        self.levels: Exact
        if values.dtype.kind in "iub":
            self.levels = values.astype(np.int64)
        else:
            self.levels = np.array([Fraction(float(level)) for level in values], dtype=object)
        self.lengths: Exact = np.ones(count, dtype=np.int64)
        if not is_even:
            unit = sum(lengths, Fraction(0)) / count
            self.lengths = np.array([length / unit for length in lengths], dtype=object)
        # A window that starts in one period may end in the next, or in the unit after that.
        self._level = repeat(self.levels).astype(np.float64)
        self._lit_before = np.concatenate([[0], np.cumsum(repeat(self.levels * self.lengths))])
        self._lit_before = self._lit_before.astype(np.float64)
        self._edges = None if is_even else _Edges(self.lengths)

    @property
    def has_equal_pieces(self) -> bool:
        """Whether all pieces are equally long."""
        return self._edges is None

    @property
    def total(self) -> Any:
        """Light of a period in lit units: an exact whole number or fraction."""
        total = (self.levels * self.lengths).sum()
        return total if isinstance(total, Fraction) else int(total)

    @property
    def mean(self) -> Fraction:
        return Fraction(self.total) / self.period

    def windows(self, starts: PhasesInPeriod, duration: Duration) -> ExposureWindows:
        """Return windows with the indices of the pieces in which they start and end."""
        windows = ExposureWindows.of(starts, duration)
        return windows if self._edges is None else self._edges.pieces_of(windows, duration)

    def light_in(self, starts: PhasesInPeriod, duration: Duration) -> FloatArray:
        """Return the light within windows, C(end) - C(start), in lit units.

        The difference is computed term by term, separately for whole units, which are exact. The
        error thus stays that of the phases, about 2e-16 units, for windows of any length; with
        unequal pieces it is that of a sum over a period.
        """
        windows = self.windows(starts, duration)
        first, last, crosses = windows.first, windows.last, windows.crosses
        level_first, level_last = self._level.take(first), self._level.take(last)
        light: FloatArray = level_last * windows.excess
        level_last -= level_first
        level_last *= np.where(crosses, -windows.before, windows.since)
        light += level_last
        light_of_units = self._lit_before.take(last)
        light_of_units -= self._lit_before.take(first + crosses)
        light += light_of_units
        light += duration.periods * float(self._lit_before[self.period])
        return light


def repeat(values: Exact) -> Exact:
    """Return two periods of values and the first one after them."""
    return np.concatenate([values, values, values[:1]])


class _Edges:
    """Where pieces of unequal lengths start, in units."""

    def __init__(self, lengths: Exact) -> None:
        exact = np.concatenate([[Fraction(0)], np.cumsum(repeat(lengths))])
        self._whole: IndexArray = np.array([edge.__floor__() for edge in exact], dtype=np.int64)
        self._fraction: FloatArray = (exact - self._whole).astype(np.float64)
        self._rounded: FloatArray = exact.astype(np.float64)

    def pieces_of(self, windows: ExposureWindows, duration: Duration) -> ExposureWindows:
        """Convert windows in units to windows in pieces."""
        first, since = self._piece_at(windows.first, windows.since)
        before = -self._since(first + 1, windows.first, windows.since)
        last, end = self._piece_at(windows.last, windows.end)
        crosses = (last > first) & (end < since)
        start = first + crosses
        excess = (duration.units - (self._whole[last] - self._whole[start])) + (
            duration.fraction - (self._fraction[last] - self._fraction[start])
        )
        return ExposureWindows(first, last, since, before, end, crosses, excess)

    def _since(self, piece: IndexArray, whole: IndexArray, fraction: FloatArray) -> FloatArray:
        return np.asarray((whole - self._whole[piece]) + (fraction - self._fraction[piece]))

    def _piece_at(self, whole: IndexArray, fraction: FloatArray) -> tuple[IndexArray, FloatArray]:
        """Return the piece at each time, and the time since its start."""
        piece = np.searchsorted(self._rounded, whole + fraction, side="right") - 1
        piece = np.clip(piece, 0, len(self._rounded) - 2)
        # The sum is rounded, so that a time near an edge can be assigned to the wrong piece.
        while True:
            since = self._since(piece, whole, fraction)
            early = (since < 0.0) & (piece > 0)
            late = (self._since(piece + 1, whole, fraction) >= 0.0) & (
                piece < len(self._rounded) - 2
            )
            if not (early | late).any():
                return piece, np.maximum(since, 0.0)
            piece = piece - early + late
