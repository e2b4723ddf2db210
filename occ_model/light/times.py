"""Times within a period of light, counted exactly over millions of columns.

A time is split into whole units and a fraction of one, because a double for both is too coarse,
after a million periods, to place an edge within a unit.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Self

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, IndexArray


@dataclass(frozen=True, slots=True)
class PhasesInPeriod:
    """Times within one period, as arrays: whole units and a fraction in [0, 1)."""

    whole: IndexArray
    fraction: FloatArray

    def first(self, count: int) -> "PhasesInPeriod":
        return PhasesInPeriod(self.whole[:count], self.fraction[:count])


@dataclass(frozen=True, slots=True)
class Duration:
    """A length of time: whole periods, whole units of a period, and a fraction of a unit."""

    periods: int
    units: int
    fraction: float

    @classmethod
    def of(cls, units: Fraction, period: int) -> Self:
        """Split an exact number of units; ``period`` is the number of units in one period."""
        whole = units.numerator // units.denominator
        return cls(whole // period, whole % period, float(units - whole))

    def in_units(self, period: int) -> float:
        """Return the number of units, with the same rounding as in :meth:`.Waveform.light_in`."""
        return self.units + self.fraction + float(self.periods * period)


@dataclass(frozen=True, slots=True)
class ExposureWindows:
    """Windows in time of equal length, given by the units in which they start and end.

    Unit numbers continue into the next period; further whole periods are omitted.
    """

    first: IndexArray
    last: IndexArray
    # Fractions of a unit: from the first unit's start to the window's start, from there to the
    # first unit's end, and from the last unit's start to the window's end. If a short window
    # crosses the edge between units, the errors of the last two shrink with the window.
    since: FloatArray
    before: FloatArray
    end: FloatArray
    # Whether the fractions of the start and of the length add up to a unit or more
    crosses: NDArray[np.bool_]
    # Length of the window without the whole units inside it: if it crosses, from the last unit's
    # start on, and otherwise from the point ``since`` after that start
    excess: FloatArray | float

    @classmethod
    def of(cls, starts: PhasesInPeriod, duration: Duration) -> Self:
        before = 1.0 - starts.fraction
        crosses = duration.fraction >= before
        last = starts.whole + duration.units + crosses
        end = np.where(crosses, duration.fraction - before, starts.fraction + duration.fraction)
        return cls(starts.whole, last, starts.fraction, before, end, crosses, duration.fraction)


def count_phases(start: Fraction, step: Fraction, period: int, count: int) -> PhasesInPeriod:
    """Count up from ``start`` by ``step``, both within one period; see :func:`count_each`."""
    phases = count_each((start,), step, period, count)
    return PhasesInPeriod(phases.whole[0], phases.fraction[0])


def count_each(
    starts: Sequence[Fraction], step: Fraction, period: int, count: int
) -> PhasesInPeriod:
    """Count up from each of some starts by ``step``, all within one period: (starts, count).

    The step is split into whole units, a part of only 24 bits, whose product with any number up to
    a million is exact, and a remainder below 1e-7 units. The error thus stays about 2e-16 units
    after a million steps, however long the period is.
    """
    units = [int(start) for start in starts]
    rests = [float(start - unit) for start, unit in zip(starts, units, strict=True)]
    steps = _count_steps(step, count)
    fraction = steps.fraction + (steps.remainder + np.array(rests)[:, None])
    carry = np.floor(fraction)
    fraction -= carry
    # A fraction just below zero can round to a whole unit when the floor is subtracted.
    rounds_up = fraction >= 1.0
    fraction[rounds_up] = 0.0
    carry += rounds_up
    carry += np.array(units, dtype=np.float64)[:, None]
    unit = np.add(steps.unit, carry, out=carry)
    # Exact, since a quotient of whole numbers this small never rounds up to a whole number.
    unit -= period * np.floor(unit / period)
    return PhasesInPeriod(unit.astype(np.int64), fraction)


@dataclass(frozen=True, eq=False, slots=True)
class _Steps:
    """The time from the first phase to each of them."""

    # Shape (count,): whole units of the exact part of the products
    unit: FloatArray
    # Shape (count,): fractions of a unit of that part, and the remainder
    fraction: FloatArray
    remainder: FloatArray


@lru_cache(maxsize=8)
def _count_steps(step: Fraction, count: int) -> _Steps:
    """Count up from 0 by ``step``; pictures that differ only in start time share the steps."""
    step_unit = int(step)
    rest = step - step_unit
    coarse = float(np.float32(float(rest)))
    number = np.arange(count, dtype=np.float64)
    position = number * coarse
    unit = np.floor(position)
    fraction = position - unit
    unit += number * step_unit
    steps = _Steps(unit, fraction, number * float(rest - Fraction(coarse)))
    for values in (steps.unit, steps.fraction, steps.remainder):
        values.flags.writeable = False
    return steps
