"""Lamps with stripes, and how each blinks: parts of one lamp's code are put together."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.photo.lamps.shape import around
from occ_model.photo.lamps.timing import LampTiming
from occ_model.results.lamp import Lamp

_LEAST_SHARED_ROWS = 0.5  # minimum fraction of rows that two parts of one lamp have in common
_LEAST_LIGHT_RATIO = 0.5  # minimum brightness of a part, and between parts, over the other's


@dataclass(frozen=True, eq=False, slots=True)
class Blinking:
    lamp: Lamp
    timing: LampTiming
    light: float
    dark: float


def with_codes_joined(
    blinking: Sequence[Blinking], means: FloatArray, bounds: IndexArray
) -> list[Blinking]:
    """Join the parts of one lamp between which it is lit, too.

    Where a code alternates, its stripes look like those of a pulse that repeats. Such parts lie in
    line and blink in time, as lamps of one driver do, but those are dark between each other.
    ``means``: profiles of the strips, shape (strips, columns). ``bounds``: first rows of the
    strips.
    """
    kept: list[Blinking] = []
    for one in sorted(blinking, key=lambda one: one.lamp.region.first_column):
        found = next((n for n, left in enumerate(kept) if _is_one(left, one, means, bounds)), None)
        if found is None:
            kept.append(one)
        else:
            kept[found] = _joined(kept[found], one)
    return kept


def _is_one(left: Blinking, right: Blinking, means: FloatArray, bounds: IndexArray) -> bool:
    """Whether two pulses that repeat are parts of one code, the first one's columns being less."""
    here, there = left.lamp.region, right.lamp.region
    first, last = max(here.first_row, there.first_row), min(here.last_row, there.last_row)
    if last - first < _LEAST_SHARED_ROWS * min(here.rows, there.rows):
        return False
    gap = slice(here.last_column, there.first_column)
    if gap.stop <= gap.start or left.timing.is_code or right.timing.is_code:
        return False
    if min(left.light, right.light) < _LEAST_LIGHT_RATIO * max(left.light, right.light):
        return False
    if not left.timing.agrees(right.timing):
        return False
    rows = slice(*np.searchsorted(bounds, [first, last]).tolist())
    between = means[rows, gap].mean(axis=0)
    bright = min(left.lamp.level, right.lamp.level)
    return bool(between.size and between.max() > _LEAST_LIGHT_RATIO * bright)


def _joined(left: Blinking, right: Blinking) -> Blinking:
    """Join two parts of a lamp: of a code no period is known, but the chip is."""
    more = max(left, right, key=lambda one: len(one.timing.edges))
    spans = np.concatenate([left.lamp.spans, right.lamp.spans])
    starts = np.unique(spans[:, 0])
    of_start = [spans[spans[:, 0] == start] for start in starts]
    whole = np.array(
        [[p[0, 0], p[:, 1].max(), p[:, 2].min(), p[:, 3].max()] for p in of_start], dtype=np.int64
    )
    lamp = replace(
        more.lamp,
        region=around(whole),
        spans=whole,
        level=max(left.lamp.level, right.lamp.level),
        period=None,
        period_uncertainty=None,
        periods=None,
    )
    return replace(more, lamp=lamp)
