"""The exact light of an exposure as a function of its start within the light's period.

With sharp edges it is linear between the starts at which an end of the exposure meets an edge of
the light; with LED edges it is quadratic between these and the ends of the ramps.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.light.edged import EdgedWaveform
from occ_model.light.times import PhasesInPeriod
from occ_model.light.waveform import Exact, Waveform

# Three Gauss-Legendre nodes from 0 to 1; they integrate the square of a quadratic exactly.
_PLACES: FloatArray = 0.5 + np.sqrt(0.15) * np.array([-1.0, 0.0, 1.0])
_WEIGHTS: FloatArray = np.array([5.0, 8.0, 5.0]) / 18.0


@dataclass(frozen=True, eq=False, slots=True)
class ExposedLight:
    """Light of an exposure minus its mean over all starts, in lit units, piece by piece."""

    lengths: FloatArray  # Shape (pieces,): in the waveform's units; they add up to one period
    # Shape (pieces, 3): at the start, the middle and the end of each piece, which is at most
    # quadratic
    values: FloatArray

    @property
    def extremes(self) -> tuple[float, float]:
        """Return the smallest and the largest value."""
        first, slope, curvature = self._coefficients()
        with np.errstate(divide="ignore", invalid="ignore"):
            place = -slope / (2.0 * curvature)
            peak = first - slope**2 / (4.0 * curvature)
        inner = peak[(place > 0.0) & (place < 1.0)]
        values = np.concatenate([self.values[:, 0], self.values[:, 2], inner])
        return float(values.min()), float(values.max())

    @property
    def variance(self) -> float:
        """Return the mean square over all starts."""
        first, slope, curvature = (each[:, None] for each in self._coefficients())
        values = first + _PLACES * (slope + _PLACES * curvature)
        return float((self.lengths / self.lengths.sum()) @ (values**2 @ _WEIGHTS))

    def _coefficients(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        first, middle, last = self.values.T
        curvature = 2.0 * (first + last) - 4.0 * middle
        return first, last - first - curvature, curvature


@lru_cache(maxsize=2)
def exposed_light(waveform: Waveform, exposure: Fraction, edge: Fraction) -> ExposedLight:
    """Return the light of an exposure; ``exposure`` and ``edge`` in the waveform's units."""
    # Whole periods contain the same light for any start.
    part = exposure % waveform.period
    if edge:
        return _expose_ramps(waveform, part, edge)
    return (
        _expose_equal_pieces(waveform, part)
        if waveform.has_equal_pieces
        else _expose_pieces(waveform, part)
    )


@lru_cache(maxsize=4)
def _integer_levels(waveform: Waveform) -> tuple[Exact, int]:
    """Return the levels as integers, and the integer that stands for full light."""
    if waveform.levels.dtype != object:
        return waveform.levels, 1
    full = math.lcm(*(level.denominator for level in waveform.levels))
    return _integers(waveform.levels * full), full


def _integers(values: Exact) -> Exact:
    """Return integers of any size in place of fractions that are integers."""
    return np.array([value.numerator for value in values], dtype=object)


def _float(values: Exact) -> FloatArray:
    return np.asarray(values).astype(np.float64)


def _expose_equal_pieces(waveform: Waveform, exposure: Fraction) -> ExposedLight:
    """Return the light of equally long pieces with sharp edges.

    The exposure is an integer number of units plus a fraction from -1/2 to 1/2. The light at the
    ends of the pieces is then an integer plus an integer times that fraction, so that no digits
    are lost where the bars vanish.
    """
    period = waveform.period
    whole = round(exposure)
    fraction = float(exposure - whole)
    levels, full = _integer_levels(waveform)
    level = np.tile(levels, 3)
    light_before = np.concatenate([[0], np.cumsum(level)])
    start = np.arange(period)
    total = levels.sum()
    # Integers: the light in lit units minus its mean, times the units of a period.
    counts = period * (light_before[start + whole] - light_before[start]) - whole * total

    def value(count_at_start: Exact, level_added: Exact) -> FloatArray:
        swing = fraction * _float((period * level_added - total) / full)
        return np.asarray((_float(count_at_start / full) + swing) / period)

    following = np.roll(counts, -1)
    if fraction >= 0.0:
        ends = (
            value(counts, level[start + whole]),
            value(following, level[start]),
            value(following, level[start + 1 + whole]),
        )
        lengths = (1.0 - fraction, fraction)
    else:
        ends = (
            value(counts, level[start + whole - 1]),
            value(counts, level[start]),
            value(following, level[start + whole]),
        )
        lengths = (-fraction, 1.0 + fraction)
    return ExposedLight(np.repeat(lengths, period), _linear(pairwise(ends)))


def _linear(ends: Iterable[tuple[FloatArray, FloatArray]]) -> FloatArray:
    """Return the values of linear pieces from those at their ends."""
    return np.concatenate(
        [np.stack([first, 0.5 * (first + last), last], axis=1) for first, last in ends]
    )


def _expose_pieces(waveform: Waveform, exposure: Fraction) -> ExposedLight:
    """Return the light of pieces of any lengths with sharp edges, exact before rounding."""
    levels, full = _integer_levels(waveform)
    count = len(levels)
    ticks = math.lcm(exposure.denominator, *(each.denominator for each in waveform.lengths))
    period, window = waveform.period * ticks, int(exposure * ticks)
    # Three periods: exposures start in the first and end before the third.
    lengths, level = np.tile(_integers(waveform.lengths * ticks), 3), np.tile(levels, 3)
    edges = np.concatenate([[0], np.cumsum(lengths)])
    light_before = np.concatenate([[0], np.cumsum(level * lengths)])
    rounded_edges = _float(edges / period)

    def light_until(times: Exact) -> Exact:
        pieces = np.searchsorted(rounded_edges, _float(times / period), side="right") - 1
        # Rounding may have led to a neighbouring piece.
        pieces -= edges[pieces] > times
        pieces += edges[pieces + 1] <= times
        return np.asarray(light_before[pieces] + level[pieces] * (times - edges[pieces]))

    starts = np.sort(np.concatenate([edges[:count], (edges[:count] - window) % period]))
    light = light_until(starts + window) - light_until(starts)
    values = _float((period * light - window * light_before[count]) / (period * ticks * full))
    spans = np.diff(np.append(starts, starts[0] + period))
    return ExposedLight(_float(spans / ticks), _linear([(values, np.roll(values, -1))]))


def _expose_ramps(waveform: Waveform, exposure: Fraction, edge: Fraction) -> ExposedLight:
    """Return the light for an LED with rise and fall times."""
    period, mean = waveform.period, float(waveform.mean * exposure)
    light_of = _add_ramps(waveform, edge)
    # Equally long pieces have cuts at the same places, so one piece stands for all.
    places, span = np.array([Fraction(0)]), 1
    if not waveform.has_equal_pieces:
        places, span = np.cumsum(waveform.lengths), period
    cells = np.arange(0, period, span, dtype=np.int64)
    # Twice the least common denominator: the middles between cuts are then integers, too.
    ticks = 2 * math.lcm(*(each.denominator for each in (exposure, edge, *places)))
    shifts = (Fraction(0), edge, -exposure, edge - exposure)
    cuts = np.concatenate([_integers((places + shift) * ticks) for shift in shifts])
    cuts = np.unique(cuts % (span * ticks))

    def light(places: Exact) -> FloatArray:
        def starts(shift: Fraction) -> PhasesInPeriod:
            moved = (places + int(shift * ticks)) % (period * ticks)
            units = (cells + (moved // ticks).astype(np.int64)[:, None]) % period
            rest = _float(moved % ticks / ticks)
            return PhasesInPeriod(units.ravel(), np.repeat(rest, len(cells)))

        return (light_of.light_in(starts, exposure) - mean).reshape(len(places), len(cells))

    spans = np.diff(np.append(cuts, cuts[0] + span * ticks))
    at_cuts, at_middles = light(cuts), light(cuts + spans // 2)
    at_next_cuts = np.concatenate([at_cuts[1:], np.roll(at_cuts[:1], -1, axis=1)])
    lengths = np.repeat(_float(spans / ticks), len(cells))
    return ExposedLight(
        lengths, np.stack([at_cuts, at_middles, at_next_cuts], axis=2).reshape(-1, 3)
    )


@lru_cache(maxsize=4)
def _add_ramps(waveform: Waveform, edge: Fraction) -> EdgedWaveform:
    return EdgedWaveform(waveform, edge)
