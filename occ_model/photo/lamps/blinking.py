"""Lamps with stripes, and how each blinks: the parts of one lamp are put together."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.photo.lamps.shape import region_around
from occ_model.photo.lamps.timing import LampTiming, common_timing
from occ_model.results.lamp import Lamp

_LEAST_SHARED_ROWS = 0.5  # minimum fraction of rows that two parts of one code have in common
_LEAST_LIGHT_RATIO = 0.5  # minimum brightness of a part, and between parts, over the other's
_MOST_GAP_PERIODS = 2.5  # of a bar before a lamp, which hides some of its stripes
_MOST_GAP_STRIPS = 2.0  # between rows of a lamp and those of the light scattered around it
_LONGEST_LIT = 1.3  # chips; a longer stripe between pulses is that of a code


@dataclass(frozen=True, eq=False, slots=True)
class Blinking:
    lamp: Lamp
    timing: LampTiming
    light: float
    dark: float

    @property
    def evidence(self) -> float:
        """The larger the more likely it is a lamp rather than scattered light or noise."""
        return len(self.timing.edges) * self.lamp.area * max(self.light, 0.0)


def join_parts(
    blinking: Sequence[Blinking], means: FloatArray, bounds: IndexArray
) -> list[Blinking]:
    """Join the parts of each lamp: they blink in time, and touch or are lit between each other.

    What blinks so above or below a lamp is light that it scatters, and is left out.

    A bar before a lamp parts it, as do pixels that are white; where a code alternates, its stripes
    look like those of a pulse that repeats. ``means``: profiles of the strips, shape (strips,
    columns). ``bounds``: first rows of the strips.
    """
    kept: list[Blinking] = []
    for one in sorted(blinking, key=lambda one: one.evidence, reverse=True):
        number, host = next(
            ((number, host) for number, host in enumerate(kept)
             if _are_one(host, one, means, bounds)), (0, None)
        )  # fmt: skip
        if host is None:
            kept.append(one)
        elif _in_line(host, one):
            kept[number] = _join(host, one, _is_code(host, one, means, bounds))
    return kept


def _are_one(one: Blinking, other: Blinking, means: FloatArray, bounds: IndexArray) -> bool:
    if min(one.light, other.light) < _LEAST_LIGHT_RATIO * max(one.light, other.light):
        return False
    near = _touch(one, other, bounds) or _lit_between(one, other, means, bounds)
    return near and common_timing(one.timing, other.timing) is not None


def _touch(left: Blinking, right: Blinking, bounds: IndexArray) -> bool:
    here, there = left.lamp.region, right.lamp.region
    rows = max(here.first_row, there.first_row) - min(here.last_row, there.last_row)
    columns = max(here.first_column, there.first_column) - min(here.last_column, there.last_column)
    period = 2.0 * min(left.timing.chip, right.timing.chip)
    height = float(bounds[-1]) / (len(bounds) - 1)
    return rows <= _MOST_GAP_STRIPS * height and columns <= _MOST_GAP_PERIODS * period


def _is_code(left: Blinking, right: Blinking, means: FloatArray, bounds: IndexArray) -> bool:
    """Whether pulses have a longer stripe between them, so that both are parts of a code."""
    between = _profile_between(left, right, means, bounds)
    lit = between > _LEAST_LIGHT_RATIO * min(left.lamp.level, right.lamp.level)
    ends = np.flatnonzero(np.diff(lit, prepend=False, append=False))
    longest = int(np.diff(ends)[::2].max(initial=0))
    return longest > _LONGEST_LIT * min(left.timing.chip, right.timing.chip)


def _lit_between(left: Blinking, right: Blinking, means: FloatArray, bounds: IndexArray) -> bool:
    """Whether two pulses that repeat are parts of one code."""
    return _in_line(left, right) and _is_code(left, right, means, bounds)


def _in_line(left: Blinking, right: Blinking) -> bool:
    """Whether two pulses that repeat have most rows in common."""
    here, there = left.lamp.region, right.lamp.region
    shared = min(here.last_row, there.last_row) - max(here.first_row, there.first_row)
    is_code = left.timing.is_code or right.timing.is_code
    return not is_code and shared >= _LEAST_SHARED_ROWS * min(here.rows, there.rows)


def _profile_between(
    left: Blinking, right: Blinking, means: FloatArray, bounds: IndexArray
) -> FloatArray:
    """Return the profile between two parts in line; empty if they are not."""
    here, there = left.lamp.region, right.lamp.region
    first, last = max(here.first_row, there.first_row), min(here.last_row, there.last_row)
    begin, end = (
        min(here.last_column, there.last_column),
        max(here.first_column, there.first_column),
    )
    part = means[slice(*np.searchsorted(bounds, [first, last]).tolist()), begin:end]
    return np.asarray(part.mean(axis=0)) if part.size else np.zeros(0)


def _join(left: Blinking, right: Blinking, is_code: bool) -> Blinking:
    """Join two parts of a lamp; of a code that looked like pulses the chip is known."""
    more = max(left, right, key=lambda one: len(one.timing.edges))
    timing = common_timing(left.timing, right.timing) or more.timing
    spans = np.concatenate([left.lamp.spans, right.lamp.spans])
    starts = np.unique(spans[:, 0])
    of_start = [spans[spans[:, 0] == start] for start in starts]
    whole = np.array(
        [[p[0, 0], p[:, 1].max(), p[:, 2].min(), p[:, 3].max()] for p in of_start], dtype=np.int64
    )
    region = region_around(whole)
    seems_code = left.timing.is_code or right.timing.is_code
    is_guess, is_code = is_code and not seems_code, is_code or seems_code
    lamp = replace(
        more.lamp,
        region=region,
        spans=whole,
        level=max(left.lamp.level, right.lamp.level),
        period=None if is_code else timing.spacing,
        period_uncertainty=None if is_code else timing.uncertainty,
        switching_frequency_times_readout=1.0 / timing.chip,
        product_uncertainty=timing.uncertainty / timing.spacing / timing.chip,
        periods=None if is_code else region.columns / timing.spacing,
        is_joined=is_guess,
    )
    light = max(left, right, key=lambda one: one.light)
    return Blinking(lamp, timing, light.light, light.dark)
