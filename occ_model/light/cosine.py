"""Light that varies as a cosine about its mean, such as that of mains lamps."""

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.light.times import count_phases


@dataclass(frozen=True, slots=True)
class Cosine:
    """The light 1 + m cos(2 pi F x + phi) at the time x.

    Its mean over an exposure [x, x + t] is 1 + m sinc(F t) cos(2 pi F (x + t/2) + phi) with sinc(y)
    = sin(pi y) / (pi y), the frequency response of an exposure as a moving average.

    Parameters
    ----------
    frequency
        F in Hz, above 0.
    depth
        m, from 0 to 1.
    phase
        phi in radians.
    """

    frequency: float
    depth: float
    phase: float = 0.0

    @property
    def period(self) -> Fraction:
        """Seconds after which the light repeats, exact."""
        return 1 / Fraction(self.frequency)

    @property
    def mean(self) -> float:
        return 1.0

    def response(self, length: Fraction) -> float:
        """Return sinc(F t), the fraction of the depth that an average over ``length`` leaves.

        The nearest whole number of cycles is subtracted before the sine, so that whole cycles give
        exactly 0.
        """
        cycles = Fraction(self.frequency) * length
        if not cycles:
            return 1.0
        nearest = round(cycles)
        sine = math.sin(math.pi * float(cycles - nearest))
        return (-sine if nearest % 2 else sine) / (math.pi * float(cycles))

    def depth_in(self, exposure: Fraction, edge: Fraction = Fraction(0)) -> float:
        """Return the depth after averaging over an exposure and an edge time."""
        if not self.depth:
            return 0.0
        return self.depth * abs(self.response(exposure) * self.response(edge))

    def means(
        self,
        start: Fraction,
        step: Fraction,
        count: int,
        exposure: Fraction,
        edge: Fraction = Fraction(0),
    ) -> FloatArray:
        """Return the mean light of exposures that start in equal steps.

        Parameters
        ----------
        start, step, exposure, edge
            Start of the first exposure, time from one start to the next, length of each exposure,
            and time over which the light itself is averaged first, all in seconds.

        Returns
        -------
        ndarray of float64, shape (count,)
        """
        cycles = Fraction(self.frequency)
        middle = (start + (exposure - edge) / 2) * cycles % 1
        phases = count_phases(middle, step * cycles % 1, 1, count).fraction
        swing = np.cos(2.0 * math.pi * phases + self.phase)
        return np.asarray(1.0 + self.depth * self.response(exposure) * self.response(edge) * swing)
