"""The exact light of an exposure as a function of its start within the code.

With sharp edges it is linear between the starts at which an end of the exposure meets a chip's
edge; with LED edges it is quadratic between these and the ends of the ramps.
"""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.light.edged import EdgedWaveform
from occ_model.light.times import PhasesInPeriod
from occ_model.light.waveform import Waveform

# Of three nodes of Gauss and Legendre from 0 to 1, which integrate a quadratic's square exactly.
_PLACES: FloatArray = 0.5 + np.sqrt(0.15) * np.array([-1.0, 0.0, 1.0])
_WEIGHTS: FloatArray = np.array([5.0, 8.0, 5.0]) / 18.0


@dataclass(frozen=True, eq=False, slots=True)
class ExposedLight:
    """Light of an exposure minus its mean over all starts, in lit chips, piece by piece."""

    lengths: FloatArray  # Shape (pieces,): in chips; they add up to one period
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
        found = np.concatenate([self.values[:, 0], self.values[:, 2], inner])
        return float(found.min()), float(found.max())

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


def exposed_light(chips: ByteArray, exposure: Fraction, edge: Fraction) -> ExposedLight:
    """Return the light of an exposure of a repeated code; ``exposure`` and ``edge`` in chips."""
    # Whole periods hold the same light for any start.
    part = exposure % len(chips)
    return _ramped(chips, part, edge) if edge else _sharp(chips, part)


def _sharp(chips: ByteArray, exposure: Fraction) -> ExposedLight:
    """Return the light for sharp edges.

    The exposure is an integer number of chips plus a fraction from -1/2 to 1/2. The light at the
    ends of the pieces is then an integer plus a product of that fraction, so that no digits are
    lost where the bars vanish.
    """
    period = len(chips)
    whole = round(exposure)
    fraction = float(exposure - whole)
    level = np.tile(chips.astype(np.int64), 3)
    before = np.concatenate([[0], np.cumsum(level)])
    start = np.arange(period)
    total = int(chips.sum())
    # In lit chips times the chips of a period, minus the mean: integers.
    count = period * (before[start + whole] - before[start]) - whole * total

    def value(of: np.ndarray, lit: np.ndarray) -> FloatArray:
        return (of + fraction * (period * lit - total)) / period

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
    pieces = [
        np.stack([first, 0.5 * (first + last), last], axis=1) for first, last in pairwise(ends)
    ]
    return ExposedLight(np.repeat(lengths, period), np.concatenate(pieces))


def _ramped(chips: ByteArray, exposure: Fraction, edge: Fraction) -> ExposedLight:
    """Return the light for an LED with rise and fall times."""
    period = len(chips)
    waveform = EdgedWaveform(Waveform(chips), edge)
    mean = float(Fraction(int(chips.sum()), period) * exposure)
    places = sorted({each % 1 for each in (Fraction(0), edge, -exposure, edge - exposure)})

    def light(place: Fraction) -> FloatArray:
        def starts(shift: Fraction) -> PhasesInPeriod:
            moved = place + shift
            whole = moved.numerator // moved.denominator
            chip = (np.arange(period, dtype=np.int64) + whole) % period
            return PhasesInPeriod(chip, np.full(period, float(moved - whole)))

        return waveform.light_in(starts, exposure) - mean

    at = [light(place) for place in places]
    at.append(np.roll(at[0], -1))
    lengths, values = [], []
    for index, (first, last) in enumerate(zip(places, [*places[1:], Fraction(1)], strict=True)):
        lengths.append(np.full(period, float(last - first)))
        values.append(np.stack([at[index], light((first + last) / 2), at[index + 1]], axis=1))
    return ExposedLight(np.concatenate(lengths), np.concatenate(values))
