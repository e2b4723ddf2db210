"""Further exposures that may explain stripes as well as a given one."""

import math
from collections.abc import Callable
from dataclasses import replace

from occ_model.arrays import FloatArray
from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.initial_search import EXPOSURES
from occ_model.photo.fit.joint_fit import JointModel
from occ_model.photo.fit.timing import Timing

APART_CHIPS = 0.04
"""Difference in chips from which two exposures are different ones."""

_MOST_STARTS = 3
_LONGEST = 4.2
"""Longest exposure in chips to start from."""

_MOST_SCANNED = 2
_HOPELESS = 4.0
"""Ratio to the misfit of the exposure found from which another one is no start."""

_BUT_EXPOSURE = (0, 3, 4, 5, 6, 7, 8)
_ROUGH_ROUNDS = 3


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


def scanned_starts(
    model: JointModel, found: FloatArray, is_possible: Callable[[Timing], bool]
) -> list[FloatArray]:
    """Give the parameters of the best other exposures of all, the camera being as usual.

    The first search compares exposures by a profile without blur and by one tone curve: it may keep
    only a wrong one, whose errors look small.

    Parameters
    ----------
    model
        The model, its noise being that of the exposure found.
    found : ndarray of float64, shape (9,)
        The parameters found.
    is_possible
        Whether a timing needs no column darker than black.
    """
    usual = model.with_usual(found)

    def rough(exposure: float) -> tuple[float, FloatArray]:
        values = usual.copy()
        values[1] = exposure
        fit = model.fit(values, _BUT_EXPOSURE, _ROUGH_ROUNDS)
        return fit.misfit, fit.values

    most = _HOPELESS * rough(float(found[1]))[0]
    fits = sorted((rough(one) for one in EXPOSURES if one < _LONGEST), key=lambda fit: fit[0])
    kept: list[FloatArray] = []
    for misfit, values in fits:
        step, exposure, middle = values[:3].tolist()
        apart = all(abs(exposure - other[1]) > APART_CHIPS for other in [found, *kept])
        if misfit < most and apart and is_possible(Timing(step, exposure, middle, model.gamma)):
            kept.append(values)
    return kept[:_MOST_SCANNED]


def _turned(one: float, other: float) -> float:
    """Give the chips by which a square wave's stripes are shifted between two exposures."""
    return float((math.floor(one / 2.0) + math.floor(other / 2.0)) % 2)
