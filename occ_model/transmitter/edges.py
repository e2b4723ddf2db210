"""Waveform of an LED with rise and fall times, and its exact running integral.

The chips s(x), x in chips, are averaged over the last ``tau``:
s_tau(x) = (1/tau) (C(x) - C(x - tau)), with C their running integral. The light is then continuous
and piecewise linear, its own running integral piecewise quadratic.
"""

from collections.abc import Callable
from fractions import Fraction

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.transmitter.waveform import Duration, Phases, Waveform, Windows

PhasesAt = Callable[[Fraction], Phases]  # of all windows' starts, shifted by chips


class EdgedWaveform:
    """The light of chips sent repeatedly by an LED with an edge time tau above 0, in chips."""

    def __init__(self, chips: ByteArray, edge: Fraction) -> None:
        self.period = period = len(chips)
        self._sharp = Waveform(chips)
        self._edge = edge
        self._mean = Fraction(int(chips.sum()), period)
        # A window that starts in one period may end in the next.
        self._level: FloatArray = np.concatenate([chips, chips, chips[:1]]).astype(np.float64)
        self._rise: FloatArray = np.diff(self._level, prepend=self._level[period - 1])

        # The running integral of the chips less their mean, its own mean taken out, and the
        # integral of that, at each chip's start. Scaled to whole numbers, below 2^53: exact.
        swing = period * chips.astype(np.int64) - int(chips.sum())
        integral = np.cumsum(swing) - swing
        integral = 2 * period * integral - 2 * int(integral.sum())
        second = np.cumsum(integral + period * swing) - (integral + period * swing)
        self._half_slope, self._integral, self._second = (
            np.concatenate([table, table, table[:1]]).astype(np.float64)
            for table in (period * swing, integral, second)
        )

    def lit_chips(self, starts: PhasesAt, exposure: Fraction) -> FloatArray:
        """Light within windows, in lit chips.

        As in :meth:`.Waveform.lit_chips` no term is the difference of two much larger numbers: the
        error stays that of the phases, also in windows far shorter than a chip.
        """
        duration = Duration.of(exposure, self.period)
        now = starts(Fraction(0))
        if self._edge < 1:
            return self._sharp.lit_chips(now, duration) - self._kept_back(now, duration)
        gained = self._swing_integral(now, duration)
        gained -= self._swing_integral(starts(-self._edge), duration)
        gained /= float(2 * self.period**2 * self._edge)
        gained += float(self._mean * exposure)
        return gained

    def _kept_back(self, starts: Phases, duration: Duration) -> FloatArray:
        """Light that the ramps keep back within windows, for edges within one chip.

        A ramp of height h keeps back h (x - x^2 / (2 tau)) within the time x, h tau / 2 in all.
        """
        # A fraction of a ramp that is not a normal number would be divided with an overflow.
        edge = max(float(self._edge), float(np.finfo(np.float64).tiny))
        windows = Windows.of(starts, duration)
        ahead = np.maximum(edge - starts.fraction, 0.0)  # rest of the first chip's ramp
        end = np.minimum(windows.end, edge)
        apart = self._rise[windows.first] * ahead * (0.5 * ahead / edge)
        apart += 0.5 * edge * (self._level[windows.last - 1] - self._level[windows.first])
        apart += self._rise[windows.last] * end * (1.0 - 0.5 * end / edge)
        gone = np.minimum(ahead, duration.fraction)
        within = self._rise[windows.first] * gone * ((ahead - 0.5 * gone) / edge)
        return np.where(windows.first == windows.last, within, apart)

    def _swing_integral(self, starts: Phases, duration: Duration) -> FloatArray:
        """Integral over windows of the running integral of the chips less their mean.

        The mean is taken out before both integrations, so that they are periodic and stay small for
        any edge time. In chips^2, times 2 period^2: I x + H x^2 within a chip whose tables are I
        and H.
        """
        windows = Windows.of(starts, duration)
        first, last, fraction = windows.first, windows.last, starts.fraction
        integral, slope = self._integral[first], self._half_slope[first]
        apart = windows.before * (integral + slope * (1.0 + fraction))
        apart += self._second[last] - self._second[first + 1]
        apart += windows.end * (self._integral[last] + self._half_slope[last] * windows.end)
        within = duration.fraction * (integral + slope * (2.0 * fraction + duration.fraction))
        return np.where(first == last, within, apart)
