"""Further exposures that may explain stripes as well as a given one."""

import math
from dataclasses import replace

from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.timing import Timing

APART_CHIPS = 0.04
"""Difference in chips from which two exposures are different ones."""

_MOST_STARTS = 3
_LONGEST = 4.2
"""Longest exposure in chips of those that look the same."""


def other_starts(explanation: Explanation, best: Timing) -> list[Timing]:
    """Give further exposures to start from: for a square wave, those that look the same."""
    starts = [one for one in explanation.starts if one is not best]
    if len(explanation.chips) == 2:
        t = best.exposure
        alike = [2.0 * turns + sign * t for turns in (0, 1, 2) for sign in (-1.0, 1.0)]
        # From one such exposure to the next the stripes are turned about.
        return [
            replace(best, exposure=other, middle=best.middle + _turned(t, other))
            for other in alike
            if 0.0 < other < _LONGEST and abs(other - t) > APART_CHIPS
        ]
    return starts[:_MOST_STARTS]


def _turned(one: float, other: float) -> float:
    """Give the chips by which a square wave's stripes are shifted between two exposures."""
    return float((math.floor(one / 2.0) + math.floor(other / 2.0)) % 2)
