"""Average the timing of chips over models of the camera and shapes of the blur.

The width of edges is that of exposure and blur together, so that one may be mistaken for the other.
"""

import math
from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.fit.joint_fit import JointFit, average_fits, keep_distinct
from occ_model.photo.fit.joint_model import JointModel
from occ_model.photo.fit.seen_stripes import BlurShape
from occ_model.photo.fit.timing import Timing

_MOST_EXCESS_MISFIT = 60.0  # excess of the misfit above which a model is left out
_MOST_SHAPED_EXCESS = 20.0  # the same, above which other shapes of the blur are not tried

_MOST_COLUMNS = 12.0  # exposure in columns below which blur may be taken for it

_BLURS = (0.2, 0.7, 1.1, 1.5)  # standard deviations of blur, in columns, that are tried

_BLUR_FRACTIONS: dict[BlurShape, tuple[float, ...]] = {
    "normal": (0.9,),
    "box": (0.1, 0.5, 0.75),
    "exponential": (0.1, 0.5, 0.75),
}
"""Fractions of an edge's variance due to blur from which fits start, by the shape of the blur. A
box of blur and an exposure look alike, and each shape has several minima: starts at one half alone
found a blur of 1.1 columns and an exposure of 3.5, with a larger misfit, instead of 1.3 and 2.2."""

_HOPELESS_RATIO = 6.0
"""Ratio of misfits to the least one above which a fit that begins elsewhere is not finished."""

_NEAR_ROUNDS, _ROUNDS, _LAST_ROUNDS = 5, 4, 10  # from each blur and shape, and at last
_SHORTEST_EXPOSURE = 0.2  # shortest exposure in columns to start from


def mean_fit(models: Sequence[JointModel], timing: Timing) -> JointFit:
    """Fit each model from a timing, and return the mean over those that are about as likely."""
    first = models[0]
    start = first.start(timing)
    first.estimate_noise(start)
    usual = first.fit(start).values
    first.estimate_noise(usual)
    for model in models[1:]:
        model.take_noise(first)
    fits = [_fit_near(model, model.adapt(usual)) for model in models]
    # Use the model that explains the stripes best: another one may explain none of them.
    likely, found = min(zip(models, fits, strict=True), key=lambda pair: pair[1].misfit)
    likely.estimate_noise(found.values)
    for model in models:
        model.take_noise(likely)
    most = found.misfit + _MOST_EXCESS_MISFIT
    rounds = _LAST_ROUNDS if _is_short(usual) else 1
    again = [
        (model, model.fit(fit.values, rounds))
        for model, fit in zip(models, fits, strict=True)
        if fit.misfit <= most
    ]
    least = min(fit.misfit for _, fit in again)
    shaped: list[JointFit] = []
    for model, free in again:
        is_likely = free.misfit < least + _MOST_SHAPED_EXCESS
        shaped += _fit_each_shape(model, free) if is_likely else [free]
        hopeless = _HOPELESS_RATIO * free.misfit
        other = model.fit(mirror_exposure(free.values), _LAST_ROUNDS, hopeless=hopeless)
        is_apart = abs(other.exposure - free.exposure) > free.deviation
        if is_apart and other.misfit < least + _MOST_SHAPED_EXCESS:
            shaped.append(other)
    return average_fits([fit.unbiased for fit in shaped])


def mirror_exposure(values: FloatArray) -> FloatArray:
    """Return parameters whose exposure is on the other side of the nearest whole chips.

    As far from them, both make about the same stripes.
    """
    values = values.copy()
    values[1] = abs(2.0 * np.rint(values[1]) - values[1])
    return values


def _fit_near(model: JointModel, here: FloatArray) -> JointFit:
    """Fit near some parameters, from every blur if the exposure is short enough to look like it."""
    if not _is_short(here):
        return model.fit(here)
    best = model.fit(here, rounds=_NEAR_ROUNDS)
    for blur in _BLURS:
        # Each starts from what is usual of all else: tone and switching can make up for a blur.
        start = model.with_usual(with_blur(here, blur))
        other = model.fit(start, _NEAR_ROUNDS, hopeless=_HOPELESS_RATIO * best.misfit)
        best = min(best, other, key=lambda fit: fit.misfit)
    return best


def _fit_each_shape(model: JointModel, free: JointFit) -> list[JointFit]:
    """Fit with each shape of the blur if the exposure is so short that it looks like blur.

    Of the fits that end in the same minimum one is returned.
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
            [with_blur(free.values, math.sqrt(part * width)) for part in fractions], _ROUNDS, shape
        )
        for shape, fractions in _BLUR_FRACTIONS.items()
    }
    found["normal"].append(free)
    if found["box"]:
        box = min(found["box"], key=lambda fit: fit.misfit)
        found["box"] += fits(_exchange_blur(box.values), _LAST_ROUNDS, "box")
    best = min((fit for fits in found.values() for fit in fits), key=lambda fit: fit.misfit)
    for shape, others in found.items():
        # Each shape also starts from the best fit, as a wrong shape bends the tone curve.
        others.append(model.fit(best.values, rounds=_LAST_ROUNDS, shape=shape))
    return [fit for fits in found.values() for fit in keep_distinct(fits)]


def _is_short(values: FloatArray) -> bool:
    """Whether blur may be taken for the exposure."""
    return bool(values[1] < _MOST_COLUMNS * values[0])


def _exchange_blur(found: FloatArray) -> list[FloatArray]:
    """Exchange exposure and blur: two boxes make the same edge in either order."""
    step, exposure, blur = float(found[0]), float(found[1]), float(found[7])
    starts = []
    # Blur far below a column is hardly seen, so that a box of one column is tried, too.
    for box in (max(math.sqrt(12.0) * blur, _SHORTEST_EXPOSURE), 1.0):
        values = found.copy()
        values[1], values[7] = step * box, exposure / step / math.sqrt(12.0)
        starts.append(values)
    return starts


def with_blur(values: FloatArray, blur: float) -> FloatArray:
    """Set the blur, and the exposure that leaves the edges' width as it is."""
    values = values.copy()
    step = float(values[0])
    width = (values[1] / step) ** 2 + 12.0 * (values[7] ** 2 - blur**2)
    values[1] = step * math.sqrt(max(float(width), _SHORTEST_EXPOSURE**2))
    values[7] = blur
    return values
