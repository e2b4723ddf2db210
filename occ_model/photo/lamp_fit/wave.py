"""The light of a blinking lamp as columns see it: a blurred trapezoid in each period."""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray

LEAST_RAMP = 0.02  # columns; a steeper ramp cannot be told from a step
_REACH = 4.0  # deviations of the blur beyond which it is not computed

# A trapezoid is the sum of four bent lines: the side of their bend, its place on the ramp, its sign
_SIDES = np.array([1.0, 1.0, -1.0, -1.0])
_ON_RAMP = np.array([0.5, -0.5, 0.5, -0.5])
_SIGNS = np.array([1.0, -1.0, -1.0, 1.0])


@dataclass(frozen=True, slots=True)
class Wave:
    """Pulses of a width at half height, with ramps, blurred.

    A lamp that is lit for d of each period P, exposed for t, is a trapezoid: the integral of a box
    of length d P over a box of length t. The one is the width, the other the ramp, in either order.
    """

    period: float  # Columns
    place: float  # Column of a pulse's middle
    width: float  # As a fraction of the period
    ramp: float  # As a fraction of the smaller of the width and the rest of the period
    blur: float  # Standard deviation in columns

    @property
    def ramp_columns(self) -> float:
        return max(self.period * min(self.width, 1.0 - self.width) * self.ramp, LEAST_RAMP)

    def values(self, columns: FloatArray) -> FloatArray:
        """Return the light, 0 between the pulses and 1 on them, where these are not blurred."""
        _, ends, below, bell = self._lines(columns)
        return np.asarray(self._sum(_SIGNS, ends * below + self.blur * bell) / self.ramp_columns)

    def slopes(self, columns: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the light and its slopes over the five parameters, shapes (n,) and (5, n).

        The first slope is over the period's logarithm, the third and fourth over the width's and
        the ramp's logits, the last over the blur's logarithm.
        """
        pulses, ends, below, bell = self._lines(columns)
        width, ramp, period = self.width, self.ramp_columns, self.period
        values = self._sum(_SIGNS, ends * below + self.blur * bell) / ramp
        by_width = 0.5 * width * period * self._sum(_SIGNS * _SIDES, below) / ramp
        by_period = by_width - period * self._sum(_SIGNS, below * pulses) / ramp
        by_width = by_width * (1.0 - width)
        by_shape = np.zeros_like(values)
        if ramp > LEAST_RAMP:
            by_ramp = self._sum(_SIGNS * _ON_RAMP, below) - values  # over its logarithm
            by_period = by_period + by_ramp
            by_width = by_width + by_ramp * (1.0 - width if width < 0.5 else -width)
            by_shape = by_ramp * (1.0 - self.ramp)
        by_place = -self._sum(_SIGNS, below) / ramp
        by_blur = self.blur * self._sum(_SIGNS, bell) / ramp
        return values, np.stack([by_period, by_place, by_width, by_shape, by_blur])

    def _lines(self, columns: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return the bent lines of the pulses near each column, shapes (4, pulses, n).

        Numbers of the pulses, distances past each bend, and the normal distribution and its density
        there.
        """
        from scipy.special import ndtr  # slow to import, and needed only for photos

        half = 0.5 * self.width * self.period
        beside = 1 if _REACH * self.blur + half + self.ramp_columns < self.period else 2
        pulses = np.rint((columns - self.place) / self.period)
        pulses = pulses + np.arange(-beside, beside + 1.0)[:, None]
        off = columns - self.place - pulses * self.period
        ends = off + (_SIDES * half + _ON_RAMP * self.ramp_columns)[:, None, None]
        scaled = ends / self.blur
        bell = np.exp(-0.5 * scaled * scaled) / math.sqrt(2.0 * math.pi)
        return pulses, ends, np.asarray(ndtr(scaled)), bell

    def _sum(self, weights: FloatArray, lines: FloatArray) -> FloatArray:
        return np.asarray(np.tensordot(weights, lines.sum(axis=1), 1))
