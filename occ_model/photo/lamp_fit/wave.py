"""The light of a blinking lamp as columns see it: a blurred trapezoid in each period."""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray

LEAST_RAMP = 0.02  # columns; a steeper ramp cannot be told from a step
_REACH = 4.0  # deviations of the blur beyond which it is not computed


@dataclass(frozen=True, slots=True)
class Wave:
    """Pulses with ramps, blurred.

    The light of a lamp that is lit for a fraction d of each period P, gathered for t, is a
    trapezoid: the integral of a box of length d P over a box of length t. The longer of the two is
    its width at half height, the shorter one the length of its ramps.
    """

    period: float  # Columns
    place: float  # Column of a pulse's middle
    width: float  # As a fraction of the period
    ramp: float  # As a fraction of the smaller of the width and the rest of the period
    blur: float  # Standard deviation in columns

    @property
    def ramp_columns(self) -> float:
        return max(self.period * min(self.width, 1.0 - self.width) * self.ramp, LEAST_RAMP)

    @property
    def ramp_part(self) -> float:
        """The ramp as a fraction of the period."""
        return self.ramp_columns / self.period

    def values(self, columns: FloatArray) -> FloatArray:
        """Return the light of columns: 0 between the pulses and 1 on them, but for the blur."""
        _, off = self._places(columns)
        away, total = np.abs(off), np.zeros(len(columns))
        ramps = self._ramps()
        for side, pulse, _ in ramps:
            ends, below, bell = self._bends(side, pulse, away)
            total += ends[0] * below[0] - ends[1] * below[1] + self.blur * (bell[0] - bell[1])
        return np.asarray(total / self.ramp_columns - sum(whole for *_, whole in ramps))

    def slopes(self, columns: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the light and its slopes over the five parameters, shapes (n,) and (5, n).

        The first slope is over the period's logarithm, the third and fourth over the width's and
        the ramp's logits, the last over the blur's logarithm.
        """
        pulses, off = self._places(columns)
        away, width, ramp, period = np.abs(off), self.width, self.ramp_columns, self.period
        ramps = self._ramps()
        values = np.full(len(columns), -sum(whole for *_, whole in ramps))
        by_away, by_half, by_pulse, by_ramp, by_blur = np.zeros((5, len(columns)))
        for side, pulse, _ in ramps:
            ends, below, bell = self._bends(side, pulse, away)
            bells = (bell[0] - bell[1]) * (self.blur / ramp)
            part = (ends[0] * below[0] - ends[1] * below[1]) / ramp + bells
            steep = (below[0] - below[1]) / ramp
            values += part
            by_half += steep
            by_away += side * steep
            by_pulse += pulse * steep
            by_ramp += 0.5 * (below[0] + below[1]) - part  # over its logarithm
            by_blur += bells
        by_place = -np.sign(off) * by_away
        by_width = 0.5 * width * period * by_half
        by_period = by_width + period * (pulses * by_place + by_pulse)
        by_width = by_width * (1.0 - width)
        by_shape = np.zeros(len(columns))
        if ramp > LEAST_RAMP:
            by_period = by_period + by_ramp
            by_width = by_width + by_ramp * (1.0 - width if width < 0.5 else -width)
            by_shape = by_ramp * (1.0 - self.ramp)
        return values, np.stack([by_period, by_place, by_width, by_shape, by_blur])

    def _places(self, columns: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the number of the pulse nearest to each column, and the distance from its middle.

        The distance is in columns, and positive right of the middle.
        """
        pulses = np.rint((columns - self.place) / self.period)
        return pulses, columns - self.place - pulses * self.period

    def _ramps(self) -> list[tuple[float, float, float]]:
        """Return the ramps that reach columns within half a period of a pulse's middle.

        Each is stated by its direction (-1: the light falls away from the middle of the nearest
        pulse, 1: it rises), by the number of pulses to its own one, and by the 0 or 1 that must be
        subtracted from the sum of all ramps.
        """
        half, period = 0.5 * self.width * self.period, self.period
        reach = 0.5 * self.ramp_columns + _REACH * self.blur
        beside = (
            (1.0, 0.0, 1.0, half), (1.0, -1.0, 0.0, 0.5 * period - half),
            (-1.0, 1.0, 1.0, 0.5 * period + half), (-1.0, -1.0, 0.0, period - half),
        )  # fmt: skip
        near = [(side, pulse, whole) for side, pulse, whole, away in beside if away < reach]
        return [(-1.0, 0.0, 0.0), *near]

    def _bends(
        self, side: float, pulse: float, away: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return what makes up the two bent lines whose difference is a ramp, shapes (2, n).

        These are the distances past each bend, and the normal distribution and its density there.
        """
        from scipy.special import ndtr  # slow to import, and needed only for photos

        ends = side * away + (0.5 * self.width + pulse) * self.period
        ends = ends + 0.5 * self.ramp_columns * np.array([[1.0], [-1.0]])
        scaled = ends / self.blur
        bell = np.exp(-0.5 * scaled * scaled) / math.sqrt(2.0 * math.pi)
        return ends, np.asarray(ndtr(scaled)), bell
