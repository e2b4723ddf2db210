"""Further exposures that may explain stripes as well as a given one."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from occ_model.arrays import FloatArray
from occ_model.photo.fit.best_timing import SAME_EXPOSURE
from occ_model.photo.fit.initial_search import EXPOSURES
from occ_model.photo.fit.joint_fit import JointFit, JointModel
from occ_model.photo.fit.timing import Timing

_LONGEST = 4.2  # longest exposure in chips to start from

_MOST_SCANNED = 2
_MOST_MISFIT_RATIO = 4.0  # maximum misfit ratio of a starting value
_HELD = (0, 3, 4, 5, 6, 7, 8)  # indices of the parameters held while exposures are compared
_ROUGH_ROUNDS = 3  # number of iterations that separate promising exposures from others


def alike_starts(best: Timing) -> list[Timing]:
    """Return the timings of other exposures by which a square wave's stripes look the same."""
    t = best.exposure
    alike = [2.0 * turns + sign * t for turns in (0, 1, 2) for sign in (-1.0, 1.0)]
    # From one such exposure to the next the stripes are turned about.
    return [
        replace(best, exposure=other, middle=best.middle + _turned(t, other))
        for other in alike
        if 0.0 < other < _LONGEST and abs(other - t) > SAME_EXPOSURE
    ]


def scanned_starts(
    model: JointModel, found: FloatArray, is_possible: Callable[[Timing], bool]
) -> list[FloatArray]:
    """Return the parameters of the best other exposures of all, the camera being as usual.

    The first search compares exposures by a profile without blur and by one tone curve: it may keep
    only a wrong one, whose errors look small.

    ``model``: the model, its noise being that of the exposure found.
    """
    usual = model.with_usual(found)

    def rough(exposure: float) -> tuple[float, FloatArray]:
        values = usual.copy()
        values[1] = exposure
        return model.rough(values, _HELD, _ROUGH_ROUNDS)

    most = _MOST_MISFIT_RATIO * rough(float(found[1]))[0]
    fits = sorted((rough(one) for one in EXPOSURES if one < _LONGEST), key=lambda fit: fit[0])
    kept: list[FloatArray] = []
    for misfit, values in fits:
        apart = all(abs(values[1] - other[1]) > SAME_EXPOSURE for other in [found, *kept])
        if misfit < most and apart and is_possible(model.timing(values)):
            kept.append(values)
    return kept[:_MOST_SCANNED]


def alike_among(
    tried: Sequence[JointFit],
    kept: Sequence[JointFit],
    most: float,
    is_possible: Callable[[JointFit], bool],
) -> list[JointFit]:
    """Return the fits of a square wave by other exposures that look like one of those kept.

    A search that begins near one exposure may end at another, where blur of a wrong shape fits
    better: 1.39 chips behind exponential tails had less than two thirds of the misfit of 0.62
    behind a normal blur, where 0.48 was right (seed 730509).
    """
    found: list[JointFit] = []
    for fit in sorted(tried, key=lambda one: one.misfit):
        known = [one.exposure for one in (*kept, *found)]
        if (
            fit.misfit < most
            and all(abs(fit.exposure - other) > SAME_EXPOSURE for other in known)
            and any(_look_alike(fit.exposure, one.exposure) for one in kept)
            and is_possible(fit)
        ):
            found.append(fit)
    return found


def _look_alike(one: float, other: float) -> bool:
    """Whether a square wave's stripes look the same by two exposures in chips, blur left aside."""
    turns = [math.remainder(sum_, 2.0) for sum_ in (one - other, one + other)]
    return min(map(abs, turns)) <= SAME_EXPOSURE


def _turned(one: float, other: float) -> float:
    """Return the chips by which a square wave's stripes are shifted between two exposures."""
    return float((math.floor(one / 2.0) + math.floor(other / 2.0)) % 2)
