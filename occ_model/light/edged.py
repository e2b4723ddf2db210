"""The light of an LED with rise and fall times.

The sharp light s(x) is averaged over the last ``tau``: s_tau(x) = (1/tau) (C(x) - C(x - tau)), with
C its running integral. The light is then continuous and piecewise linear, its own running integral
piecewise quadratic.
"""

from collections.abc import Callable
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.light.times import Duration, PhasesInPeriod
from occ_model.light.waveform import Waveform, repeat

PhasesAt = Callable[[Fraction], PhasesInPeriod]  # phases of the windows' starts after a shift


class EdgedWaveform:
    """A waveform's light from an LED with an edge time tau > 0, in the waveform's units."""

    def __init__(self, sharp: Waveform, edge: Fraction) -> None:
        self.period = period = sharp.period
        self._sharp = sharp
        self._edge = edge
        # Compared with Python's numbers, as NumPy's integers overflow.
        self._is_short = edge < min(sharp.lengths.tolist())
        self._level: FloatArray = repeat(sharp.levels).astype(np.float64)
        self._length: FloatArray = repeat(sharp.lengths).astype(np.float64)
        self._rise: FloatArray = np.diff(self._level, prepend=self._level[period - 1])

        # At each piece's start: the running integral of the light minus its mean, itself reduced by
        # its own mean, and the integral of that. They are exact until they are rounded; for chips
        # they are whole numbers below 2^53.
        length = sharp.lengths
        swing = period * sharp.levels - sharp.total
        within = swing * length
        integral = np.cumsum(within) - within
        mean = 2 * (integral * length).sum() + (within * length).sum()
        integral = 2 * period * integral - mean
        within = integral * length + period * swing * length * length
        second = np.cumsum(within) - within
        self._half_slope, self._integral, self._second = (
            np.concatenate([table, table, table[:1]]).astype(np.float64)
            for table in (period * swing, integral, second)
        )

    def light_in(self, starts: PhasesAt, exposure: Fraction) -> FloatArray:
        """Return the light within windows, in lit units.

        As in :meth:`.Waveform.light_in`, no term is the difference of two much larger numbers, so
        that the error stays that of the phases, also for windows far shorter than a unit.
        """
        duration = Duration.of(exposure, self.period)
        phases = starts(Fraction(0))
        if self._is_short:
            return self._sharp.light_in(phases, duration) - self._light_lost_to_ramps(
                phases, duration
            )
        light = self._swing_integral(phases, duration)
        light -= self._swing_integral(starts(-self._edge), duration)
        light /= float(2 * self.period**2 * self._edge)
        light += float(self._sharp.mean * exposure)
        return light

    def _light_lost_to_ramps(self, starts: PhasesInPeriod, duration: Duration) -> FloatArray:
        """Return the light that the ramps take from windows, for edges shorter than any piece.

        A ramp of height h takes h (x - x^2 / (2 tau)) in the time x after its start, and h tau / 2
        in all.
        """
        # Dividing by an edge that is not a normal number would overflow.
        edge = max(float(self._edge), float(np.finfo(np.float64).tiny))
        windows = self._sharp.windows(starts, duration)
        remaining = np.maximum(edge - windows.since, 0.0)  # remainder of the first piece's ramp
        end = np.minimum(windows.end, edge)
        loss = self._rise[windows.first] * remaining * (0.5 * remaining / edge)
        loss += 0.5 * edge * (self._level[windows.last - 1] - self._level[windows.first])
        loss += self._rise[windows.last] * end * (1.0 - 0.5 * end / edge)
        passed_time = np.minimum(remaining, windows.excess)
        loss_in_one_piece = (
            self._rise[windows.first] * passed_time * ((remaining - 0.5 * passed_time) / edge)
        )
        return np.where(windows.first == windows.last, loss_in_one_piece, loss)

    def _swing_integral(self, starts: PhasesInPeriod, duration: Duration) -> FloatArray:
        """Integrate, over windows, the running integral of the light minus its mean.

        The mean is subtracted before both integrations, so that these are periodic and stay small
        for any edge time. The unit is units^2 / (2 period^2); within a piece it is I x + H x^2,
        with I and H from the tables.
        """
        windows = self._sharp.windows(starts, duration)
        first, last, since = windows.first, windows.last, windows.since
        integral, slope = self._integral[first], self._half_slope[first]
        integrals = windows.before * (integral + slope * (self._length[first] + since))
        integrals += self._second[last] - self._second[first + 1]
        integrals += windows.end * (self._integral[last] + self._half_slope[last] * windows.end)
        integrals_in_one_piece = windows.excess * (
            integral + slope * (2.0 * since + windows.excess)
        )
        return np.where(first == last, integrals_in_one_piece, integrals)
