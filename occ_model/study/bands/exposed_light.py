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

# Of three nodes of Gauss and Legendre from 0 to 1, which integrate a quadratic's square exactly.
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
        first, slope, bend = self._coefficients()
        with np.errstate(divide="ignore", invalid="ignore"):
            place = -slope / (2.0 * bend)
            peak = first - slope**2 / (4.0 * bend)
        inner = peak[(place > 0.0) & (place < 1.0)]
        values = np.concatenate([self.values[:, 0], self.values[:, 2], inner])
        return float(values.min()), float(values.max())

    @property
    def variance(self) -> float:
        """Return the mean square over all starts."""
        first, slope, bend = (each[:, None] for each in self._coefficients())
        values = first + _PLACES * (slope + _PLACES * bend)
        return float((self.lengths / self.lengths.sum()) @ (values**2 @ _WEIGHTS))

    def _coefficients(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        first, middle, last = self.values.T
        bend = 2.0 * (first + last) - 4.0 * middle
        return first, last - first - bend, bend


@lru_cache(maxsize=2)
def exposed_light(waveform: Waveform, exposure: Fraction, edge: Fraction) -> ExposedLight:
    """Return the light of an exposure; ``exposure`` and ``edge`` in the waveform's units."""
    # Whole periods hold the same light for any start.
    part = exposure % waveform.period
    if edge:
        return _ramped(waveform, part, edge)
    return _sharp_even(waveform, part) if is_even(waveform) else _sharp(waveform, part)


def is_even(waveform: Waveform) -> bool:
    """Return whether all pieces are equally long."""
    return waveform.lengths.dtype != object


@lru_cache(maxsize=4)
def _whole_numbers(waveform: Waveform) -> tuple[Exact, int]:
    """Return the levels as multiples of a common part of full light, and how many make it up."""
    if waveform.levels.dtype != object:
        return waveform.levels, 1
    parts = math.lcm(*(level.denominator for level in waveform.levels))
    return _integers(waveform.levels * parts), parts


def _integers(values: Exact) -> Exact:
    """Return integers of any size in place of fractions that are integers."""
    return np.array([value.numerator for value in values], dtype=object)


def _float(values: Exact) -> FloatArray:
    return np.asarray(values).astype(np.float64)


def _sharp_even(waveform: Waveform, exposure: Fraction) -> ExposedLight:
    """Return the light of equally long pieces with sharp edges.

    The exposure is an integer number of units plus a fraction from -1/2 to 1/2. The light at the
    ends of the pieces is then an integer plus a product of that fraction, so that no digits are
    lost where the bars vanish.
    """
    period = waveform.period
    whole = round(exposure)
    fraction = float(exposure - whole)
    levels, parts = _whole_numbers(waveform)
    level = np.tile(levels, 3)
    before = np.concatenate([[0], np.cumsum(level)])
    start = np.arange(period)
    total = levels.sum()
    # In lit units times the units of a period, minus the mean: integers.
    count = period * (before[start + whole] - before[start]) - whole * total

    def value(of: Exact, lit: Exact) -> FloatArray:
        swing = fraction * _float((period * lit - total) / parts)
        return np.asarray((_float(of / parts) + swing) / period)

    following = np.roll(count, -1)
    if fraction >= 0.0:
        ends = (
            value(count, level[start + whole]),
            value(following, level[start]),
            value(following, level[start + 1 + whole]),
        )
        lengths = (1.0 - fraction, fraction)
    else:
        ends = (
            value(count, level[start + whole - 1]),
            value(count, level[start]),
            value(following, level[start + whole]),
        )
        lengths = (-fraction, 1.0 + fraction)
    return ExposedLight(np.repeat(lengths, period), _linear(pairwise(ends)))


def _linear(ends: Iterable[tuple[FloatArray, FloatArray]]) -> FloatArray:
    """Return the values of linear pieces from those at their ends."""
    return np.concatenate(
        [np.stack([first, 0.5 * (first + last), last], axis=1) for first, last in ends]
    )


def _sharp(waveform: Waveform, exposure: Fraction) -> ExposedLight:
    """Return the light of pieces of any lengths with sharp edges, exact before it is rounded."""
    levels, parts = _whole_numbers(waveform)
    count = len(levels)
    ticks = math.lcm(exposure.denominator, *(each.denominator for each in waveform.lengths))
    period, window = waveform.period * ticks, int(exposure * ticks)
    # Of three periods: starts are in the first, and ends before the third.
    lengths, level = np.tile(_integers(waveform.lengths * ticks), 3), np.tile(levels, 3)
    edges = np.concatenate([[0], np.cumsum(lengths)])
    before = np.concatenate([[0], np.cumsum(level * lengths)])
    near = _float(edges / period)

    def light_until(places: Exact) -> Exact:
        piece = np.searchsorted(near, _float(places / period), side="right") - 1
        # The neighbour where rounding has met it.
        piece -= edges[piece] > places
        piece += edges[piece + 1] <= places
        return np.asarray(before[piece] + level[piece] * (places - edges[piece]))

    starts = np.sort(np.concatenate([edges[:count], (edges[:count] - window) % period]))
    light = light_until(starts + window) - light_until(starts)
    values = _float((period * light - window * before[count]) / (period * ticks * parts))
    spans = np.diff(np.append(starts, starts[0] + period))
    return ExposedLight(_float(spans / ticks), _linear([(values, np.roll(values, -1))]))


def _ramped(waveform: Waveform, exposure: Fraction, edge: Fraction) -> ExposedLight:
    """Return the light for an LED with rise and fall times."""
    period, mean = waveform.period, float(waveform.mean * exposure)
    light_of = _edged(waveform, edge)
    # Equally long pieces have their cuts at like places, so that one piece stands for all.
    places, span = np.array([Fraction(0)]), 1
    if not is_even(waveform):
        places, span = np.cumsum(waveform.lengths), period
    cells = np.arange(0, period, span, dtype=np.int64)
    # Twice the least common denominator: the middles between cuts are whole numbers of ticks, too.
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
    at, middle = light(cuts), light(cuts + spans // 2)
    after = np.concatenate([at[1:], np.roll(at[:1], -1, axis=1)])
    lengths = np.repeat(_float(spans / ticks), len(cells))
    return ExposedLight(lengths, np.stack([at, middle, after], axis=2).reshape(-1, 3))


@lru_cache(maxsize=4)
def _edged(waveform: Waveform, edge: Fraction) -> EdgedWaveform:
    return EdgedWaveform(waveform, edge)
