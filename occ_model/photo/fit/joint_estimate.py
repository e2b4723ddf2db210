"""Refine an explanation's timing, with uncertainties that hold what is not known of the camera.

Which quantity the camera averages and blurs is not known either: each possibility is fitted, and
the estimate is the mean over all of them, weighted by how likely they are.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.joint_fit import JointFit, JointModel
from occ_model.photo.fit.least_squares import StripeFit, StripeModel
from occ_model.photo.fit.other_starts import APART_CHIPS, other_starts
from occ_model.photo.fit.timing import Timing
from occ_model.photo.stripes.evenly_lit import Cells
from occ_model.results import Stripes
from occ_model.transmitter.waveform import Waveform

_CHIPS_LIT = 8
"""Chips within which an LED is surely on for once; a whole period where that is shorter."""

_HOPELESS = 60.0
"""Excess of the misfit from which an exposure is not refined."""

_AS_LIKELY, _RATIO = 9.0, 1.3
"""Excess of the misfit, three deviations, and its ratio, to which another exposure is as likely."""

_TRUSTED = 6.0
"""Differences of the misfit are divided by it: the residual is no mere noise."""

_UNKNOWN_BLUR = 0.03
"""Share of the blur's variance that the model's blur does not describe: compression, clipping and
the rounding to pixels shape an edge too, the more columns it covers. With it the stated errors of
exposures below three columns and above are exceeded equally often on the photographs named below.
"""

_UNKNOWN_RAMP = 0.005
"""Standard deviation of an exposure as a share of it: switching, and processing that follows edges,
change a ramp's shape."""

_TOO_SURE = 1.7
"""Ratio of an exposure's errors to its fit's deviation: no tone curve of a camera is exactly one of
the model's. On 107 simulated photographs whose match was sure (of those with the seeds 20000 to
20170) 75 % of the errors are then within the stated deviation, and 93 % within two: errors are not
normally distributed, so that no factor gives 68 % and 95 %."""

_LEAST_EDGES = 0.3
"""Share of the edges' columns that must be seen without clipping."""

_CONTRADICTED = 0.02
"""Loss of correlation by which a refined fit contradicts the first one: exposures of 0.4 and 8.9
columns, where 5.4 was right, had correlations of 0.944 and 0.988."""

_CONTRADICTION = (
    "The pixels that are lit alike tell another timing than the mean of all pixels: the stated "
    "errors may not hold."
)

_BLURRED = 12.0
"""Columns up to which an exposure may be mistaken for blur."""

_BLURS = (0.2, 0.7, 1.1, 1.5)
"""Standard deviations of blur, in columns, that are tried then."""

_FIXED_BLUR = (7,)
_KNOWN_BLUR = 0.1
"""Standard deviation of a fitted blur, in columns, below which no other is likely."""

_LAST_ROUNDS = 10
_SHORTEST = 0.2
"""Shortest exposure in columns to start from."""


@dataclass(frozen=True, eq=False, slots=True)
class Refined:
    """Refined fits, in order of the exposure, and why their uncertainties may not hold.

    Parameters
    ----------
    fits
        The best one, and those that are as likely with another exposure.
    doubts
        Sentences.
    """

    fits: tuple[StripeFit, ...]
    doubts: tuple[str, ...]


def refined(
    stripes: Stripes,
    cells: Cells,
    explanation: Explanation,
    gamma: float,
    check: Callable[[], object] = lambda: None,
) -> Refined:
    """Refine the fits of an explanation.

    Parameters
    ----------
    stripes
        The stripes.
    cells
        The pixels of their region.
    explanation
        The chips, and first fits.
    gamma
        The gamma that is usual; where the fits hold an estimate of it, it is estimated here too.
    check
        Called every few hundredths of a second; what it raises ends the fits.
    """
    step = explanation.fits[0].timing.step
    chips = explanation.chips
    width = max(1, round(min(len(chips), _CHIPS_LIT) / step))
    profiles = cells.profiles(width)
    if explanation.camera.enhancement == "equalization" or not profiles:
        return Refined(explanation.fits, ())
    with_gamma = explanation.fits[0].covariance[3, 3] > 0.0
    models = [
        JointModel(
            profiles, chips, step, gamma, values_blurred=blurred, wide=with_gamma, check=check
        )
        for blurred in (False, True)
    ]
    if not with_gamma and explanation.camera.averaging == "pixel-value":
        models.append(JointModel(profiles, chips, step, 1.0, check=check))
    model = StripeModel(
        stripes.profile, Waveform(chips), explanation.camera.tone, step,
        explanation.camera.rank_resolution,
    )  # fmt: skip
    found = _modes(models, explanation, model.is_possible)
    seen = models[0].edges_seen(found[0].values)
    if seen < _LEAST_EDGES:
        found = [_with_step_of(mode, explanation) for mode in found]
    fits = [_stripe_fit(model, mode, gamma, with_gamma) for mode in found]
    if fits[0].correlation < explanation.correlation - _CONTRADICTED:
        return Refined(explanation.fits, (_CONTRADICTION, *_doubts(seen)))
    possible = [fit for fit in fits if fit.is_possible] or fits[:1]
    possible.sort(key=lambda fit: fit.timing.exposure)
    return Refined(tuple(possible), tuple(_doubts(seen)))


def _modes(
    models: Sequence[JointModel], explanation: Explanation, is_possible: Callable[[Timing], bool]
) -> list[JointFit]:
    """Find the exposures that are about as likely as the most likely one, that one first."""
    first = models[0]
    best = min(explanation.fits, key=lambda fit: fit.residual).timing
    first.estimate_noise(first.start(best))
    usual = first.fit(first.start(best))
    first.estimate_noise(usual.values)
    for model in models[1:]:
        model.take_noise(first)
    groups = [_possible(models, usual.values)]
    # Of the same model: another one may explain every exposure better.
    least = min(one.fit.misfit for one in groups[0] if one.model is first)
    for start in filter(is_possible, other_starts(explanation, best)):
        other = first.fit(first.start(start))
        exposures = [one.fit.exposure for group in groups for one in group]
        if other.misfit < least + _HOPELESS and all(
            abs(other.exposure - exposure) > APART_CHIPS for exposure in exposures
        ):
            groups.append([_Possible(first, other)])
    likely = min((one for group in groups for one in group), key=lambda one: one.fit.misfit)
    likely.model.estimate_noise(likely.fit.values)
    for model in models:
        model.take_noise(likely.model)
    means = []
    for group in groups:
        most = min(one.fit.misfit for one in group) + _HOPELESS
        means.append(
            _averaged([fit for one in group if one.fit.misfit <= most for fit in one.again()])
        )
    least = min(fit.misfit for fit in means)
    most = _RATIO * least + _AS_LIKELY * _TRUSTED
    # The first one stays: its stripes are those of the others, to the last column.
    kept = [fit for fit in means if fit.misfit < most or fit is means[0]]
    return sorted(kept, key=lambda fit: fit.misfit)


@dataclass(frozen=True, eq=False, slots=True)
class _Possible:
    """A model's fit, and the number of its steps once the noise is known."""

    model: JointModel
    fit: JointFit
    rounds: int = 1

    def again(self) -> list[JointFit]:
        """Fit again, the noise having been estimated, also with each blur where all are likely."""
        free = self.model.fit(self.fit.values, rounds=self.rounds)
        short = free.values[1] < _BLURRED * free.values[0]
        if not short or free.covariance[7, 7] < _KNOWN_BLUR**2:
            return [free]
        others = [_with_blur(free.values, blur) for blur in _BLURS]
        return [free, *(self.model.fit(other, _FIXED_BLUR, rounds=2) for other in others)]


def _possible(models: Sequence[JointModel], values: FloatArray) -> list[_Possible]:
    """Fit each model near an exposure; a short one with every blur, which it may be taken for."""
    columns = float(values[1] / values[0])
    if columns > _BLURRED:
        return [_Possible(one, one.fit(one.adapted(values))) for one in models]
    found = []
    for model in models:
        here = model.adapted(values)
        others = [_with_blur(here, blur) for blur in _BLURS]
        if not model.is_wide:
            # Each blur starts from what is usual of all else: tone and switching can make up for
            # it. Where gamma is asked for, it must not start anew.
            others = [model.with_usual(other) for other in others]
        starts = [here, *others]
        fits = [model.fit(start, rounds=5) for start in starts]
        best = min(fits, key=lambda fit: fit.misfit)
        found.append(_Possible(model, best, _LAST_ROUNDS))
    return found


def _with_blur(values: FloatArray, blur: float) -> FloatArray:
    """Set the blur, and the exposure that leaves the edges' width as it is."""
    values = values.copy()
    step = float(values[0])
    width = (values[1] / step) ** 2 + 12.0 * (values[7] ** 2 - blur**2)
    values[1] = step * math.sqrt(max(float(width), _SHORTEST**2))
    values[7] = blur
    return values


def _averaged(fits: Sequence[JointFit]) -> JointFit:
    """Average over models, each weighted by the density of its best fit."""
    misfits = np.array([fit.misfit for fit in fits])
    weights = np.exp(-0.5 * (misfits - misfits.min()) / _TRUSTED)
    weights /= weights.sum()
    mean = weights @ np.array([fit.values for fit in fits])
    covariance = sum(
        weight * (fit.covariance + np.outer(fit.values - mean, fit.values - mean))
        for weight, fit in zip(weights, fits, strict=True)
    )
    return JointFit(mean, np.asarray(covariance), float(misfits.min()))


def _with_step_of(mode: JointFit, explanation: Explanation) -> JointFit:
    """Take the step from the mean of all pixels: where white hides the edges, it tells more."""
    best = min(explanation.fits, key=lambda fit: fit.residual)
    values, covariance = mode.values.copy(), mode.covariance.copy()
    values[0] = best.timing.step
    covariance[0, :] = covariance[:, 0] = 0.0
    covariance[0, 0] = best.covariance[0, 0]
    return replace(mode, values=values, covariance=covariance)


def _stripe_fit(model: StripeModel, mode: JointFit, gamma: float, with_gamma: bool) -> StripeFit:
    values = mode.values
    covariance = np.zeros((4, 4))
    covariance[:3, :3] = mode.covariance[:3, :3]
    timing = Timing(float(values[0]), float(values[1]), float(values[2]), gamma)
    unknown = math.hypot(
        _UNKNOWN_RAMP * values[1], _blur_deviation(values), _rounding(model, timing) * values[1]
    )
    covariance[1] *= _TOO_SURE
    covariance[:, 1] *= _TOO_SURE
    covariance[1, 1] += unknown**2
    if with_gamma:
        gamma *= math.exp(float(values[3]))
        covariance[3, :3] = covariance[:3, 3] = gamma * mode.covariance[3, :3]
        covariance[3, 3] = gamma**2 * mode.covariance[3, 3]
    timing = Timing(float(values[0]), float(values[1]), float(values[2]), gamma)
    return model.described(timing, covariance)


def _rounding(model: StripeModel, timing: Timing) -> float:
    """Give the share of an exposure by which the rounding of both levels changes it.

    A level is rounded by up to half of one, of standard deviation 1/sqrt(12), the same in all rows
    where there is little noise; a ramp between two levels changes its length as their distance.
    """
    _, swing, _ = model.levels(timing)
    return math.sqrt(2.0 / 12.0) / max(float(np.median(swing)), 1.0)


def _blur_deviation(values: FloatArray) -> float:
    """Give the chips by which blur beside the model's changes an exposure.

    An edge is the exposure's box, of variance t^2/12, convolved with the blur; variances add. So a
    blur of variance sigma^2 that is taken for a part of the exposure makes t^2 larger by
    12 sigma^2.
    """
    step = float(values[0])
    columns, variance = float(values[1]) / step, _UNKNOWN_BLUR * float(values[7]) ** 2
    return step * (math.sqrt(columns**2 + 12.0 * variance) - columns)


def _doubts(seen: float) -> list[str]:
    if seen >= _LEAST_EDGES:
        return []
    return [
        f"White hides the stripes' edges: only {100.0 * seen:.0f} % of their columns are seen "
        f"without clipping; at least {100.0 * _LEAST_EDGES:.0f} % are needed to tell the exposure "
        "time. Expose less."
    ]
