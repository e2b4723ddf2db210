"""The timing of the columns' exposures over the chips, and its lit fractions."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.light.times import Duration, PhasesInPeriod
from occ_model.light.waveform import Waveform

SHORTEST_EXPOSURE = 1e-3  # shortest exposure in chips: shorter ones make the same stripes


@dataclass(frozen=True, slots=True)
class Timing:
    """The timing of the columns' exposures, in chips."""

    step: float  # chips from one column's start to the next one's: t_r / t_LED
    exposure: float  # chips that an exposure lasts: t / t_LED
    # Position in the period of the chips of the middle of the middle column's exposure. Unlike the
    # first column's start it hardly correlates with the other two.
    middle: float
    gamma: float  # the exponent of the camera's response

    def start(self, columns: int) -> float:
        """Return the position in the chips at which the first column's exposure starts."""
        return self.middle - 0.5 * self.step * (columns - 1) - 0.5 * self.exposure

    def lit_fraction(self, waveform: Waveform, columns: int) -> FloatArray:
        """Return the fraction of each exposure in which the LED is on, shape (columns,)."""
        place = self._starts(columns)
        chip = np.floor(place)
        phases = PhasesInPeriod((chip % waveform.period).astype(np.int64), place - chip)
        exposure = Duration.of(Fraction(self.exposure), waveform.period)
        lit = waveform.light_in(phases, exposure) / exposure.in_units(waveform.period)
        return np.clip(lit, 0.0, 1.0)

    def lit_slopes(self, lit: FloatArray, chips: ByteArray) -> FloatArray:
        """Return the lit fractions' slopes over step, exposure and middle, shape (3, columns)."""
        starts = self._starts(len(lit))
        first, last = (
            chips.take(np.floor(place).astype(np.int64), mode="wrap").astype(np.float64)
            for place in (starts, starts + self.exposure)
        )
        return self.slopes_between(lit, first, last)

    def slopes_between(self, lit: FloatArray, first: FloatArray, last: FloatArray) -> FloatArray:
        """Return the lit fractions' slopes over step, exposure and middle, shape (3, columns).

        An exposure that is later gains the light that it ends in and loses what it starts in:
        ``last`` and ``first``, 1 where the LED is on.
        """
        later = (last - first) / self.exposure
        longer = (0.5 * (last + first) - lit) / self.exposure
        from_middle = np.arange(len(lit)) - 0.5 * (len(lit) - 1)
        return np.stack([later * from_middle, longer, later])

    def _starts(self, columns: int) -> FloatArray:
        return self.start(columns) + self.step * np.arange(columns, dtype=np.float64)
