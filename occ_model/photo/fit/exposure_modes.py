"""Find the exposures with which chips explain stripes about as well as with the likeliest one."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from occ_model.arrays import FloatArray
from occ_model.photo.fit.averaged_fits import averaged, distinct
from occ_model.photo.fit.best_timing import SAME_EXPOSURE, Explanation
from occ_model.photo.fit.blur_or_exposure import Possible, possible_near
from occ_model.photo.fit.joint_fit import JointFit, JointModel
from occ_model.photo.fit.other_starts import alike_among, alike_starts, scanned_starts
from occ_model.photo.fit.timing import Timing

_MOST_EXCESS_MISFIT = 60.0  # excess of the misfit above which an exposure is not refined

_MOST_EXCESS, _MOST_RATIO = 9.0, 1.3
"""Excess of the misfit (three standard deviations), and its ratio, up to which another exposure is
as likely."""

_MOST_SQUARE_WAVE_RATIO = 3.0
"""The same ratio for a square wave, whose stripes at such exposures differ by blur and saturation
only: an exposure of 2.2 chips had 1.5 to 2.4 times the misfit of 0.23, where 2.15 was right (seed
730036)."""


def exposure_modes(
    models: Sequence[JointModel], explanation: Explanation, is_possible: Callable[[Timing], bool]
) -> tuple[list[JointFit], list[JointFit]]:
    """Find the exposures that are about as likely as the most likely one, that one first.

    Besides, for a square wave, those that are less likely, but not surely distinguishable.
    """
    first = models[0]
    best = min(explanation.fits, key=lambda fit: fit.residual).timing
    first.estimate_noise(first.start(best))
    usual = first.fit(first.start(best))
    first.estimate_noise(usual.values)
    for model in models[1:]:
        model.take_noise(first)
    groups = [possible_near(models, usual.values)]
    is_square, alike = len(explanation.chips) == 2, list[JointFit]()
    # By the model that explains this exposure best: another one may explain none of them.
    found = min(groups[0], key=lambda one: one.fit.misfit)
    least = found.fit.misfit
    for start in _other_starts(found, explanation, is_possible):
        other = found.model.fit(start)
        exposures = [one.fit.exposure for group in groups for one in group]
        exposures += [fit.exposure for fit in alike]
        if any(abs(other.exposure - exposure) <= SAME_EXPOSURE for exposure in exposures):
            continue
        if other.misfit < least + _MOST_EXCESS_MISFIT:
            groups.append([Possible(found.model, other)])
        elif is_square and other.misfit < _MOST_SQUARE_WAVE_RATIO * least:
            alike.append(other)
    likely = min((one for group in groups for one in group), key=lambda one: one.fit.misfit)
    likely.model.estimate_noise(likely.fit.values)
    for model in models:
        model.take_noise(likely.model)
    means, tried = [], list[JointFit]()
    for group in groups:
        most = min(one.fit.misfit for one in group) + _MOST_EXCESS_MISFIT
        fits = [fit for one in group if one.fit.misfit <= most for fit in one.again()]
        means.append(averaged([fit.unbiased for fit in fits]))
        tried += fits
    least = min(fit.misfit for fit in means)
    most = _MOST_RATIO * least + _MOST_EXCESS
    # A square wave's first one stays: its stripes are those of the others, to the last column.
    stays = means[0] if is_square else None
    kept = [fit for fit in means if fit.misfit < most or fit is stays]
    if is_square:
        alike += alike_among(
            tried,
            [*kept, *alike],
            _MOST_SQUARE_WAVE_RATIO * least,
            lambda fit: is_possible(first.timing(fit.values)),
        )
    return distinct(kept), alike


def _other_starts(
    found: Possible, explanation: Explanation, is_possible: Callable[[Timing], bool]
) -> list[FloatArray]:
    """Return the parameters to start from, for other exposures than the one found."""
    model = found.model
    if len(explanation.chips) != 2:
        return scanned_starts(model, found.fit.values, is_possible)
    best = min(explanation.fits, key=lambda fit: fit.residual).timing
    starts = [model.start(one) for one in alike_starts(best) if is_possible(one)]
    # What looks the same does so by the exposure without blur, which the first fits include.
    _, exposure, middle = found.fit.values[:3].tolist()
    for one in alike_starts(replace(best, exposure=exposure, middle=middle)):
        if is_possible(one):
            values = model.adapted(found.fit.values)
            values[1:3] = one.exposure, one.middle
            starts.append(values)
    return starts
