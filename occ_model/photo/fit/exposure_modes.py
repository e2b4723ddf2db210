"""Find the exposures with which chips explain stripes about as well as with the likeliest one.

Edges show the width of an exposure and of blur together, so that one may be mistaken for the other.
"""

import math
from collections.abc import Callable, Sequence

from occ_model.arrays import FloatArray
from occ_model.photo.fit.best_timing import SAME_EXPOSURE, Explanation
from occ_model.photo.fit.initial_search import EXPOSURES
from occ_model.photo.fit.joint_fit import JointFit, averaged, distinct
from occ_model.photo.fit.joint_model import JointModel
from occ_model.photo.fit.seen_stripes import BlurShape
from occ_model.photo.fit.timing import Timing

_MOST_EXCESS_MISFIT = 60.0  # excess of the misfit above which an exposure is not refined
_MOST_SHAPED_EXCESS = 20.0  # and above which another shape of the blur makes no model the likeliest

_MOST_EXCESS, _MOST_RATIO = 9.0, 1.3
"""Excess of the misfit (three standard deviations), and its ratio, up to which another exposure is
as likely."""

_MOST_COLUMNS = 12.0  # exposure in columns below which blur may be taken for it
_BLURS = (0.2, 0.7, 1.1, 1.5)  # standard deviations of blur, in columns, that are tried

_BLUR_FRACTIONS: dict[BlurShape, tuple[float, ...]] = {
    "normal": (0.9,),
    "box": (0.1, 0.5, 0.75),
    "exponential": (0.1, 0.5, 0.75),
}
"""Fractions of an edge's variance due to blur from which fits start, by the shape of the blur. A
box of blur and an exposure look alike, and each shape has several minima: starts at one half alone
took a blur of 1.3 columns and an exposure of 2.2 for one of 1.1 and 3.5, with a larger misfit."""

_HOPELESS_RATIO = 6.0
"""Ratio of misfits to the least one above which a fit that begins elsewhere is not finished."""

_ROUNDS, _LAST_ROUNDS = 5, 10  # before the noise is known, and then
_SHORTEST_EXPOSURE = 0.2  # shortest exposure in columns to start from

_LONGEST_EXPOSURE = 4.2  # longest exposure in chips to start from

_MOST_SCANNED = 2
_MOST_MISFIT_RATIO = 4.0  # maximum misfit ratio of a starting value
_HELD_INDICES = (0, 3, 4, 5, 6, 7, 8)  # of the parameters held while exposures are compared
_ROUGH_ROUNDS = 3  # number of iterations that separate promising exposures from others


def fits_near(models: Sequence[JointModel], values: FloatArray) -> list[JointFit]:
    """Fit each model near an exposure; a short one with every blur, which it may be taken for."""
    if not _is_short(values):
        return [model.fit(model.adapted(values)) for model in models]
    found = []
    for model in models:
        here = model.adapted(values)
        others = [_with_blur(here, blur) for blur in _BLURS]
        if not model.is_wide:
            # Each blur starts from what is usual of all else: tone and switching can make up for
            # it. Where gamma is to be fitted, it must not start anew.
            others = [model.with_usual(other) for other in others]
        best = model.fit(here, rounds=_ROUNDS)
        for start in others:
            other = model.fit(start, _ROUNDS, hopeless=_HOPELESS_RATIO * best.misfit)
            best = min(best, other, key=lambda fit: fit.misfit)
        found.append(best)
    return found


def of_each_shape(model: JointModel, free: JointFit) -> list[JointFit]:
    """Fit also with each shape of the blur, where it may be taken for the exposure.

    Each minimum counts once, however many starts end in it.
    """
    if not _is_short(free.values):
        return [free]
    hopeless = _HOPELESS_RATIO * free.misfit

    def fits(starts: Sequence[FloatArray], rounds: int, shape: BlurShape) -> list[JointFit]:
        tried = [model.fit(start, rounds, shape, hopeless) for start in starts]
        return [fit for fit in tried if fit.misfit <= hopeless]

    width = float(free.values[1] / free.values[0]) ** 2 / 12.0 + float(free.values[7]) ** 2
    found = {
        shape: fits(
            [_with_blur(free.values, math.sqrt(part * width)) for part in fractions], 4, shape
        )
        for shape, fractions in _BLUR_FRACTIONS.items()
    }
    found["normal"].append(free)
    if found["box"]:
        box = min(found["box"], key=lambda fit: fit.misfit)
        found["box"] += fits(_exchanged(box.values), _LAST_ROUNDS, "box")
    best = min((fit for fits in found.values() for fit in fits), key=lambda fit: fit.misfit)
    for shape, others in found.items():
        # A blur of the wrong shape bends the tone curve: each begins from the best one, too.
        others.append(model.fit(best.values, rounds=_LAST_ROUNDS, shape=shape))
    return [fit for fits in found.values() for fit in distinct(fits)]


def _is_short(values: FloatArray) -> bool:
    """Whether blur may be taken for the exposure."""
    return bool(values[1] < _MOST_COLUMNS * values[0])


def _exchanged(found: FloatArray) -> list[FloatArray]:
    """Exchange exposure and blur: two boxes make the same edge in either order."""
    step, exposure, blur = float(found[0]), float(found[1]), float(found[7])
    starts = []
    # Blur far below a column is hardly seen, so that a box of a column is exchanged, too.
    for box in (max(math.sqrt(12.0) * blur, _SHORTEST_EXPOSURE), 1.0):
        values = found.copy()
        values[1], values[7] = step * box, exposure / step / math.sqrt(12.0)
        starts.append(values)
    return starts


def _with_blur(values: FloatArray, blur: float) -> FloatArray:
    """Set the blur, and the exposure that leaves the edges' width as it is."""
    values = values.copy()
    step = float(values[0])
    width = (values[1] / step) ** 2 + 12.0 * (values[7] ** 2 - blur**2)
    values[1] = step * math.sqrt(max(float(width), _SHORTEST_EXPOSURE**2))
    values[7] = blur
    return values


def exposure_modes(
    models: Sequence[JointModel], explanation: Explanation, is_possible: Callable[[Timing], bool]
) -> list[JointFit]:
    """Find the exposures that are about as likely as the most likely one, that one first."""
    first = models[0]
    best = min(explanation.fits, key=lambda fit: fit.residual).timing
    first.estimate_noise(first.start(best))
    usual = first.fit(first.start(best)).values
    first.estimate_noise(usual)
    for model in models[1:]:
        model.take_noise(first)
    fits = list(zip(models, fits_near(models, usual), strict=True))
    # By the model that explains this exposure best: another one may explain none of them.
    model, found = min(fits, key=lambda pair: pair[1].misfit)
    groups = [fits]
    for start in scanned_starts(model, found.values, is_possible):
        other = model.fit(start)
        exposures = [fit.exposure for group in groups for _, fit in group]
        is_other = all(abs(other.exposure - each) > SAME_EXPOSURE for each in exposures)
        if is_other and other.misfit < found.misfit + _MOST_EXCESS_MISFIT:
            groups.append([(model, other)])
    everything = [pair for group in groups for pair in group]
    likely, found = min(everything, key=lambda pair: pair[1].misfit)
    likely.estimate_noise(found.values)
    for model in models:
        model.take_noise(likely)
    means, rounds = [], _LAST_ROUNDS if _is_short(usual) else 1
    for group in groups:
        means.append(_mean_again(group, rounds))
        rounds = 1
    least = min(fit.misfit for fit in means)
    most = _MOST_RATIO * least + _MOST_EXCESS
    return distinct([fit for fit in means if fit.misfit < most])


def _mean_again(group: Sequence[tuple[JointModel, JointFit]], rounds: int) -> JointFit:
    """Fit one exposure by its models again, the noise having been estimated; return the mean."""
    most = min(fit.misfit for _, fit in group) + _MOST_EXCESS_MISFIT
    again = [(model, model.fit(fit.values, rounds)) for model, fit in group if fit.misfit <= most]
    least = min(fit.misfit for _, fit in again)
    fits: list[JointFit] = []
    for model, free in again:
        is_likely = free.misfit < least + _MOST_SHAPED_EXCESS
        fits += of_each_shape(model, free) if is_likely else [free]
    return averaged([fit.unbiased for fit in fits])


def scanned_starts(
    model: JointModel, found: FloatArray, is_possible: Callable[[Timing], bool]
) -> list[FloatArray]:
    """Return the parameters of the best other exposures of all, the camera being as usual.

    The first search compares exposures by a profile without blur and by one tone curve: it may keep
    only a wrong one, whose errors look small. The noise of ``model`` is that of the exposure found.
    """
    usual = model.with_usual(found)

    def rough(exposure: float, hopeless: float = math.inf) -> tuple[float, FloatArray]:
        values = usual.copy()
        values[1] = exposure
        return model.rough(values, _HELD_INDICES, _ROUGH_ROUNDS, hopeless)

    most = _MOST_MISFIT_RATIO * rough(float(found[1]))[0]
    fits = sorted(
        (rough(one, _HOPELESS_RATIO * most) for one in EXPOSURES if one < _LONGEST_EXPOSURE),
        key=lambda fit: fit[0],
    )
    kept: list[FloatArray] = []
    for misfit, values in fits:
        apart = all(abs(values[1] - other[1]) > SAME_EXPOSURE for other in [found, *kept])
        if misfit < most and apart and is_possible(model.timing(values)):
            kept.append(values)
    return kept[:_MOST_SCANNED]
