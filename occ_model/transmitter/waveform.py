"""The light's waveform: periodic and piecewise constant, with an exact running integral.

Time is counted in chips and split into whole chips and a fraction, because a double for both is too
coarse, after a million packets, to place an edge within a chip.

For an LED with rise and fall times, the chips s(x), with x in chips, are averaged over the last
``tau``: s_tau(x) = (1/tau) (C(x) - C(x - tau)), with C their running integral. The light is then
continuous and piecewise linear, its own running integral piecewise quadratic.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Self

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray


@dataclass(frozen=True, slots=True)
class PhasesInPeriod:
    """Times within one period, as arrays: whole chips and a fraction in [0, 1)."""

    chip: IndexArray
    fraction: FloatArray

    def first(self, count: int) -> "PhasesInPeriod":
        return PhasesInPeriod(self.chip[:count], self.fraction[:count])


@dataclass(frozen=True, slots=True)
class Duration:
    """A length of time: whole periods, whole chips of a period, and a fraction of a chip."""

    periods: int
    chips: int
    fraction: float

    @classmethod
    def of(cls, chips: Fraction, period: int) -> Self:
        """Split an exact number of chips; ``period`` is the number of chips in one period."""
        whole = chips.numerator // chips.denominator
        return cls(whole // period, whole % period, float(chips - whole))

    def in_chips(self, period: int) -> float:
        """Return the number of chips, rounded as the sums of :meth:`Waveform.lit_chips` are."""
        return self.chips + self.fraction + float(self.periods * period)


@dataclass(frozen=True, slots=True)
class ExposureWindows:
    """Windows in time of equal length, by the chips in which they start and end.

    Chip numbers continue into the period after that of the start; further whole periods are
    omitted.
    """

    first: IndexArray
    last: IndexArray
    # Part of the first chip after the start, and of the last one before the end. If a short window
    # crosses a chip's edge, their errors shrink with the window.
    before: FloatArray
    end: FloatArray
    # Whether the fractions of the start and of the length add up to more than a chip
    crosses: NDArray[np.bool_]

    @classmethod
    def of(cls, starts: PhasesInPeriod, duration: Duration) -> Self:
        before = 1.0 - starts.fraction
        crosses = duration.fraction >= before
        last = starts.chip + duration.chips + crosses
        end = np.where(crosses, duration.fraction - before, starts.fraction + duration.fraction)
        return cls(starts.chip, last, before, end, crosses)


class Waveform:
    """The light of one period of chips that is sent repeatedly."""

    def __init__(self, chips: ByteArray) -> None:
        self.period = len(chips)
        # A window that starts in one period may end in the next, or in the first chip after that.
        twice = np.concatenate([chips, chips, chips[:1]])
        self._level: FloatArray = twice.astype(np.float64)
        self._lit_before: FloatArray = np.concatenate([[0.0], np.cumsum(self._level)])

    def lit_chips(self, starts: PhasesInPeriod, duration: Duration) -> FloatArray:
        """Return the light within windows, C(end) - C(start), in lit chips.

        The difference is taken term by term, with exact whole chips apart, so that the error stays
        that of the phases, about 2e-16 chips, for windows of any length.
        """
        windows = ExposureWindows.of(starts, duration)
        first, last, crosses = windows.first, windows.last, windows.crosses
        level_first, level_last = self._level.take(first), self._level.take(last)
        part: FloatArray = level_last * duration.fraction
        level_last -= level_first
        level_last *= np.where(crosses, -windows.before, starts.fraction)
        part += level_last
        whole = self._lit_before.take(last)
        whole -= self._lit_before.take(first + crosses)
        part += whole
        part += duration.periods * float(self._lit_before[self.period])
        return part


PhasesAt = Callable[[Fraction], PhasesInPeriod]  # of the starts of windows, shifted by chips


class EdgedWaveform:
    """The light of repeated chips from an LED with an edge time tau > 0, in chips."""

    def __init__(self, chips: ByteArray, edge: Fraction) -> None:
        self.period = period = len(chips)
        self._sharp = Waveform(chips)
        self._edge = edge
        self._mean = Fraction(int(chips.sum()), period)
        # A window that starts in one period may end in the next.
        self._level: FloatArray = np.concatenate([chips, chips, chips[:1]]).astype(np.float64)
        self._rise: FloatArray = np.diff(self._level, prepend=self._level[period - 1])

        # The running integral of the chips minus their mean, itself minus its mean, and the
        # integral of that, at each chip's start. They are exact, being scaled to whole numbers
        # below 2^53.
        swing = period * chips.astype(np.int64) - int(chips.sum())
        integral = np.cumsum(swing) - swing
        integral = 2 * period * integral - 2 * int(integral.sum())
        second = np.cumsum(integral + period * swing) - (integral + period * swing)
        self._half_slope, self._integral, self._second = (
            np.concatenate([table, table, table[:1]]).astype(np.float64)
            for table in (period * swing, integral, second)
        )

    def lit_chips(self, starts: PhasesAt, exposure: Fraction) -> FloatArray:
        """Return the light within windows, in lit chips.

        As in :meth:`.Waveform.lit_chips`, no term is the difference of two much larger numbers, so
        that the error stays that of the phases, also for windows far shorter than a chip.
        """
        duration = Duration.of(exposure, self.period)
        now = starts(Fraction(0))
        if self._edge < 1:
            return self._sharp.lit_chips(now, duration) - self._light_lost_to_ramps(now, duration)
        gained = self._swing_integral(now, duration)
        gained -= self._swing_integral(starts(-self._edge), duration)
        gained /= float(2 * self.period**2 * self._edge)
        gained += float(self._mean * exposure)
        return gained

    def _light_lost_to_ramps(self, starts: PhasesInPeriod, duration: Duration) -> FloatArray:
        """Return the light that the ramps take from windows, for edges shorter than one chip.

        A ramp of height h takes h (x - x^2 / (2 tau)) in the time x after its start, in all h tau /
        2.
        """
        # Dividing by an edge that is not a normal number would overflow.
        edge = max(float(self._edge), float(np.finfo(np.float64).tiny))
        windows = ExposureWindows.of(starts, duration)
        ahead = np.maximum(edge - starts.fraction, 0.0)  # remainder of the first chip's ramp
        end = np.minimum(windows.end, edge)
        apart = self._rise[windows.first] * ahead * (0.5 * ahead / edge)
        apart += 0.5 * edge * (self._level[windows.last - 1] - self._level[windows.first])
        apart += self._rise[windows.last] * end * (1.0 - 0.5 * end / edge)
        gone = np.minimum(ahead, duration.fraction)
        within = self._rise[windows.first] * gone * ((ahead - 0.5 * gone) / edge)
        return np.where(windows.first == windows.last, within, apart)

    def _swing_integral(self, starts: PhasesInPeriod, duration: Duration) -> FloatArray:
        """Integrate, over windows, the running integral of the chips minus their mean.

        The mean is subtracted before both integrations, so that these are periodic and stay small
        for any edge time. The unit is chips^2 / (2 period^2); within a chip it is I x + H x^2, with
        I and H from the tables.
        """
        windows = ExposureWindows.of(starts, duration)
        first, last, fraction = windows.first, windows.last, starts.fraction
        integral, slope = self._integral[first], self._half_slope[first]
        apart = windows.before * (integral + slope * (1.0 + fraction))
        apart += self._second[last] - self._second[first + 1]
        apart += windows.end * (self._integral[last] + self._half_slope[last] * windows.end)
        within = duration.fraction * (integral + slope * (2.0 * fraction + duration.fraction))
        return np.where(first == last, within, apart)
