"""Refine an explanation's timing, with uncertainties that include what is unknown of the camera.

It is also unknown whether the camera averages and blurs light or pixel values: each possibility is
fitted, and the estimate is the mean over all of them, weighted by how likely they are.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.joint_fit import JointFit
from occ_model.photo.fit.joint_model import PRIORS, JointModel
from occ_model.photo.fit.least_squares import StripeFit, StripeModel, exposure_deviation
from occ_model.photo.fit.mean_fit import mean_fit
from occ_model.photo.fit.timing import Timing
from occ_model.photo.stripes.evenly_lit import Cells, EvenProfile
from occ_model.results.match import Stripes

_CHIPS_LIT = 8  # number of chips within which an LED is on at least once, as within any period

_UNKNOWN_RAMP = 0.002  # relative deviation of an exposure by its ramps' shape

_UNKNOWN_BLUR = 0.02
"""Relative standard deviation of a blur's variance: no camera's blur has exactly one of the shapes
tried. An exposure of half a column behind a blur of one column is thus known to 50 %, one of four
columns to 1 %."""

_LEAST_EDGES = 0.1  # minimum fraction of the edges' columns that is seen without clipping

_MOST_UNUSUAL_DEVIATIONS = 3.55
"""Distance of the camera's and the LED's six unknowns from their means, in standard deviations,
which five of a hundred usual cameras exceed (chi-square distribution)."""

_MOST_CORRELATION_LOSS = 0.02
"""Loss of correlation by which a refined fit contradicts the first one: exposures of 0.4 and 8.9
columns, where 5.4 was right, had correlations of 0.944 and 0.988."""

_CONTRADICTION = (
    "The pixels that are lit equally give another exposure than the mean of all pixels: its stated "
    "error may not hold."
)


_ROUNDS = 6  # number of iterations after which the rims are seen in the residual
_COLUMNS_LEFT_OUT = 16  # number of columns at a rim that are left out together
_MOST_RATIO = 3.0  # maximum root mean square of their residual over the median of all
_LEAST_KEPT = 24  # minimum number of columns of a profile


@dataclass(frozen=True, eq=False, slots=True)
class Refined:
    """Refined fits, in order of the exposure, and why their uncertainties may not hold."""

    fits: tuple[StripeFit, ...]
    doubts: tuple[str, ...] = ()
    exposure_doubts: tuple[str, ...] = ()


def refine_fits(
    stripes: Stripes,
    cells: Cells,
    explanation: Explanation,
    gamma: float,
    check: Callable[[], object] = lambda: None,
) -> Refined:
    """Refine the fits of an explanation.

    Gamma is estimated if it was in these fits. What ``check`` raises ends the work.
    """
    step = explanation.fits[0].timing.step
    chips = explanation.chips
    period = len(chips) / step
    width = max(1, round(min(period, _CHIPS_LIT / step)))
    profiles = cells.profiles(width)
    if explanation.camera.enhancement == "equalization" or not profiles:
        return Refined(explanation.fits)
    with_gamma = explanation.fits[0].covariance[3, 3] > 0.0

    def model_by(gamma: float, *, values_blurred: bool = False) -> JointModel:
        return JointModel(
            profiles, chips, step, gamma,
            values_blurred=values_blurred, wide=with_gamma, check=check,
        )  # fmt: skip

    best = min(explanation.fits, key=lambda fit: fit.residual)
    profiles = without_rims(profiles, model_by(gamma), best, stripes.profile)
    models = [model_by(gamma, values_blurred=blurred) for blurred in (False, True)]
    if not with_gamma and explanation.camera.averaging == "pixel-value":
        models.append(model_by(1.0))
    model = StripeModel(stripes.profile, chips, explanation.camera.response, step)
    found = mean_fit(models, best.timing)
    seen = models[0].edges_seen(found.values)
    unusual = models[0].distance_from_usual(found.values)
    if seen < _LEAST_EDGES:
        found = _with_step_of(found, best)
    fit = _stripe_fit(model, widen_covariance(found, unusual), gamma, with_gamma=with_gamma)
    # The mean of all pixels is fitted without blur, which is then a part of the exposure.
    if fit.correlation < explanation.correlation - _MOST_CORRELATION_LOSS:
        doubts = (_CONTRADICTION, *_exposure_doubts(seen))
        return Refined(explanation.fits, _doubts(unusual), doubts)
    return Refined((fit,), _doubts(unusual), _exposure_doubts(seen))


def _with_step_of(found: JointFit, best: StripeFit) -> JointFit:
    """Take the step of the mean of all pixels, which is better known where white hides edges."""
    values, covariance = found.values.copy(), found.covariance.copy()
    values[0] = best.timing.step
    covariance[0, :] = covariance[:, 0] = 0.0
    covariance[0, 0] = best.covariance[0, 0]
    return replace(found, values=values, covariance=covariance)


def widen_covariance(fit: JointFit, unusual: float) -> JointFit:
    """Widen the covariance of all but the step if the camera's unknowns are unusual.

    ``unusual``: their distance from what is usual, in standard deviations. The factor is its ratio
    to the usual distance of six numbers (as Birge, Phys. Rev. 40:207, 1932, for measurements that
    scatter by more than they state).
    """
    ratio = max(1.0, unusual / math.sqrt(len(PRIORS)))
    factor = np.array([1.0, *[ratio] * (len(fit.values) - 1)])
    return replace(fit, covariance=fit.covariance * np.outer(factor, factor))


def _stripe_fit(
    model: StripeModel, found: JointFit, gamma: float, *, with_gamma: bool
) -> StripeFit:
    step, exposure, middle, off, *_, blur, _ = found.values.tolist()
    covariance = np.zeros((4, 4))
    covariance[:3, :3] = found.covariance[:3, :3]
    timing = Timing(step, exposure, middle, gamma)
    low, swing, _ = model.levels(timing)
    unknown = math.hypot(
        math.hypot(_UNKNOWN_RAMP, rounding_error(low, swing)) * exposure,
        exposure_deviation(_UNKNOWN_BLUR * (blur * step) ** 2, exposure),
    )
    covariance[1, 1] += unknown**2
    if with_gamma:
        gamma *= math.exp(off)
        covariance[3, :3] = covariance[:3, 3] = gamma * found.covariance[3, :3]
        covariance[3, 3] = gamma**2 * found.covariance[3, 3]
    timing = replace(timing, gamma=gamma)
    sharp = model.describe(timing, covariance)
    # An edge is as wide as exposure and blur together: their variances add.
    width = step * math.hypot(exposure / step, math.sqrt(12.0) * blur)
    blurred = model.describe(replace(timing, exposure=width), covariance)
    if blurred.correlation <= sharp.correlation:
        return sharp
    return replace(blurred, timing=timing, is_possible=sharp.is_possible)


def rounding_error(low: FloatArray, swing: FloatArray) -> float:
    """Return the relative error of an exposure by the rounding of both levels to grey levels.

    The length of a ramp changes in proportion to the distance of the two levels that it lies
    between. Each is rounded with a standard deviation of 1/sqrt(12), by the same amount in all rows
    where there is little noise. A level that varies along the columns is rounded up here and down
    there: of R roundings, all but one cancel.
    """
    deviations = [1.0 / (math.sqrt(12.0) * max(1.0, np.ptp(one))) for one in (low, low + swing)]
    return math.hypot(*deviations) / max(float(np.median(swing)), 1.0)


def _doubts(unusual: float) -> tuple[str, ...]:
    """Return why all estimates are doubtful: the model explains the stripes by unusual values."""
    if unusual <= _MOST_UNUSUAL_DEVIATIONS:
        return ()
    return (
        "Only an unusual camera or lamp explains the stripes: its tone curve, blur and "
        f"switching are {unusual:.1f} standard deviations from what is usual; at most "
        f"{_MOST_UNUSUAL_DEVIATIONS} are allowed.",
    )


def _exposure_doubts(seen: float) -> tuple[str, ...]:
    if seen >= _LEAST_EDGES:
        return ()
    return (
        f"Saturation hides the stripes' edges: only {100.0 * seen:.0f} % of their columns are "
        f"below it; at least {100.0 * _LEAST_EDGES:.0f} % are needed for the exposure time. Expose "
        "less.",
    )


def without_rims(
    profiles: Sequence[EvenProfile], model: JointModel, first: StripeFit, profile: FloatArray
) -> list[EvenProfile]:
    """Return profiles without the columns at their ends that two fits do not follow.

    These are the fit to the mean of all pixels, ``profile``, and one with blur. Each may follow a
    rim alone: the levels of the latter bend there, and blur makes up for it in the former.
    """
    start = model.start(first.timing)
    model.estimate_noise(start)
    misfit = model.misfit_of_columns(model.fit(start, _ROUNDS).values)
    shows = within_rims(misfit) & within_rims((profile - first.profile) ** 2)
    found = [replace(one, kept=one.kept & shows) for one in profiles]
    return [one for one in found if one.kept.sum() >= _LEAST_KEPT] or list(profiles)


def within_rims(misfit: FloatArray) -> NDArray[np.bool_]:
    """Return which columns lie between the rims, by the misfit of each; NaN where none is seen."""
    starts = np.arange(0, max(1, len(misfit) - _COLUMNS_LEFT_OUT + 1), _COLUMNS_LEFT_OUT)
    seen = ~np.isnan(misfit)
    count = np.add.reduceat(seen.astype(np.float64), starts)
    squares = np.add.reduceat(np.where(seen, misfit, 0.0), starts) / np.maximum(count, 1.0)
    inside = np.flatnonzero(squares <= _MOST_RATIO**2 * np.median(squares[count > 0.0]))
    shows = np.zeros(len(misfit), dtype=bool)
    shows[starts[inside[0]] : np.append(starts, len(misfit))[inside[-1] + 1]] = True
    return shows
