"""Lamps with stripes, and how each blinks; the parts of one lamp are joined."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.photo.lamps.shape import region_around
from occ_model.photo.lamps.timing import LampTiming, common_timing
from occ_model.results.lamp import Lamp

_LEAST_SHARED_ROWS = 0.5  # minimum fraction of rows that two parts of one code have in common
_LEAST_LIGHT_RATIO = 0.5  # minimum brightness of a part, and between parts, over the other's
_MOST_GAP_PERIODS = 2.5  # largest gap that a bar before a lamp leaves in its stripes, in periods
_MOST_GAP_STRIPS = 2.0  # largest gap between a lamp and the light scattered around it, in strips
_LONGEST_LIT = 1.3  # longest bright stripe of a pulse in chips; a longer one is that of a code


@dataclass(frozen=True, eq=False, slots=True)
class Blinking:
    """A lamp with stripes, or a part of one."""

    lamp: Lamp
    timing: LampTiming
    light: float  # light, dark: light of the stripes above that between them, 1 at white
    dark: float

    @property
    def evidence(self) -> float:
        """How likely it is a lamp rather than scattered light or noise, on no absolute scale."""
        return len(self.timing.edges) * self.lamp.area * max(self.light, 0.0)


def describe_lamp(timing: LampTiming, spans: IndexArray, level: float, *, is_code: bool) -> Lamp:
    """Return the lamp of a timing that fills some spans; a code has no period of its own."""
    region, spacing = region_around(spans), timing.spacing
    return Lamp(
        region=region,
        spans=spans,
        level=level,
        modulated=True,
        period=None if is_code else spacing,
        period_uncertainty=None if is_code else timing.uncertainty,
        switching_frequency_times_readout=1.0 / timing.chip,
        product_uncertainty=timing.uncertainty / spacing / timing.chip,
        periods=None if is_code else region.columns / spacing,
    )


def join_parts(
    blinking: Sequence[Blinking], means: FloatArray, bounds: IndexArray
) -> list[Blinking]:
    """Join the parts of each lamp: they blink in time, and touch, or what is between them is lit.

    A bar before a lamp divides it, as white pixels do; a part of a code that alternates looks like
    a repeated pulse. Light that blinks in time above or below a lamp is scattered light, and is
    left out.

    ``means``: profiles of the strips, shape (strips, columns). ``bounds``: first rows of the
    strips, and the number of rows.
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
    """Whether a longer stripe lies between two repeated pulses: both are then parts of a code."""
    between = _profile_between(left, right, means, bounds)
    lit = between > _LEAST_LIGHT_RATIO * min(left.lamp.level, right.lamp.level)
    ends = np.flatnonzero(np.diff(lit, prepend=False, append=False))
    longest = int(np.diff(ends)[::2].max(initial=0))
    return longest > _LONGEST_LIT * min(left.timing.chip, right.timing.chip)


def _lit_between(left: Blinking, right: Blinking, means: FloatArray, bounds: IndexArray) -> bool:
    """Whether two repeated pulses are parts of one code, as a longer stripe lies between them."""
    return _in_line(left, right) and _is_code(left, right, means, bounds)


def _in_line(left: Blinking, right: Blinking) -> bool:
    """Whether two parts are repeated pulses that have most rows in common."""
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
    """Join two parts of a lamp; ``is_code``: they are a code's, though both look like pulses."""
    more = max(left, right, key=lambda one: len(one.timing.edges))
    timing = common_timing(left.timing, right.timing) or more.timing
    spans = np.concatenate([left.lamp.spans, right.lamp.spans])
    starts = np.unique(spans[:, 0])
    of_start = [spans[spans[:, 0] == start] for start in starts]
    whole = np.array(
        [[p[0, 0], p[:, 1].max(), p[:, 2].min(), p[:, 3].max()] for p in of_start], dtype=np.int64
    )
    looks_coded = left.timing.is_code or right.timing.is_code
    level = max(left.lamp.level, right.lamp.level)
    lamp = describe_lamp(timing, whole, level, is_code=is_code or looks_coded)
    lamp = replace(lamp, is_joined=is_code and not looks_coded, is_blurred=more.lamp.is_blurred)
    light = max(left, right, key=lambda one: one.light)
    return Blinking(lamp, timing, light.light, light.dark)
