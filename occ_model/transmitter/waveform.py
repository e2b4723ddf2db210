"""Waveform of the light: periodic, piecewise constant, with an exact running integral.

Time is counted in chips and split into whole chips and a fraction: after a million packets a double
is too coarse to place an edge within a chip, a fraction alone is not.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import Self

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray


@dataclass(frozen=True, slots=True)
class Phases:
    """Times within one period, as arrays: whole chips and a fraction in [0, 1)."""

    chip: IndexArray
    fraction: FloatArray

    def first(self, count: int) -> "Phases":
        return Phases(self.chip[:count], self.fraction[:count])


@dataclass(frozen=True, slots=True)
class Duration:
    """A length of time: whole periods, whole chips of a period, and a fraction of a chip."""

    periods: int
    chips: int
    fraction: float

    @classmethod
    def of(cls, chips: Fraction, period: int) -> Self:
        """Split an exact number of chips; ``period`` is the number of chips of one period."""
        whole = chips.numerator // chips.denominator
        return cls(whole // period, whole % period, float(chips - whole))

    def in_chips(self, period: int) -> float:
        """Return the number of chips, rounded as :meth:`Waveform.lit_chips` rounds its sums."""
        return self.chips + self.fraction + float(self.periods * period)


@dataclass(frozen=True, slots=True)
class Windows:
    """Windows in time of one length, by the chips that they start and end in.

    Chip numbers continue into the period after that of the start; whole periods are left out.
    """

    first: IndexArray
    last: IndexArray
    # Part of the first chip after the start, and of the last one before the end. Where a short
    # window crosses a chip's edge, their error shrinks with the window.
    before: FloatArray
    end: FloatArray
    # Whether the fractions of the start and of the length add up to more than a chip
    crosses: NDArray[np.bool_]

    @classmethod
    def of(cls, starts: Phases, duration: Duration) -> Self:
        before = 1.0 - starts.fraction
        crosses = duration.fraction >= before
        last = starts.chip + duration.chips + crosses
        end = np.where(crosses, duration.fraction - before, starts.fraction + duration.fraction)
        return cls(starts.chip, last, before, end, crosses)


class Waveform:
    """The light of one period of chips that is sent repeatedly."""

    def __init__(self, chips: ByteArray) -> None:
        self.period = len(chips)
        # A window that starts in one period may end in the next: two periods, and the chip after.
        twice = np.concatenate([chips, chips, chips[:1]])
        self._level: FloatArray = twice.astype(np.float64)
        self._lit_before: FloatArray = np.concatenate([[0.0], np.cumsum(self._level)])

    def lit_chips(self, starts: Phases, duration: Duration) -> FloatArray:
        """Light within windows, C(end) - C(start), in lit chips.

        The difference is taken term by term, the exact whole chips separately: the error stays that
        of the phases, about 2e-16 chips, for windows of any length.
        """
        windows = Windows.of(starts, duration)
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
