"""Find the timings with which given chips fit a photo's stripes best."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.fit.camera_response import CameraResponse
from occ_model.photo.fit.initial_search import TimingCandidate, TimingSearch
from occ_model.photo.fit.least_squares import StripeFit, StripeModel
from occ_model.photo.fit.timing import Timing
from occ_model.photo.stripes.envelope import remove_trend
from occ_model.results.match import Stripes

_LEAST_SURE_CORRELATION = 0.9  # correlation above which a candidate is not a coincidence
_LEAST_CORRELATION_RATIO = 0.85  # minimum correlation of candidates over that of the best
_BEST, _SHORTEST = 4, 4  # candidates that are fitted: best ones, and shortest exposures
_ROUGH_ROUNDS = 4  # iterations after which only good fits are continued
_HOPELESS_RATIO = 20.0  # ratio of its residual to the best one above which a fit is not continued
_MOST_RESIDUAL_RATIO = 4.0  # maximum ratio of a rough fit to the best one for it to be continued

_MOST_FINISHED = 6  # maximum number of fits that are continued to the end

_MOST_EQUAL_RATIO = 1.05  # maximum ratio of residuals of fits that are equally good
_EQUALIZED_RATIO = 0.5  # ratio of residuals below which a picture was equalized

EXPLAINED_CORRELATION = 0.98  # correlation of a fit above which no other chips are tried

CLIPPED_FRACTION = 0.02
"""Saturated fraction of the pixels up to which saturation hardly changes the width of the
stripes."""

_SAME_EXPOSURE = 0.04  # difference in chips below which two exposures are the same


@dataclass(frozen=True, eq=False, slots=True)
class Explanation:
    """Chips, and the fits with which they explain a photo's stripes."""

    chips: ByteArray
    # The best fit, and those that are as good with another exposure, in order of the exposure.
    fits: tuple[StripeFit, ...]
    camera: CameraResponse

    @property
    def correlation(self) -> float:
        return max(fit.correlation for fit in self.fits)

    def nearest(self, exposure: Callable[[StripeFit], float], wanted: float | None) -> StripeFit:
        """Choose the fit whose exposure time is nearest to a wanted one, or else the shortest."""
        if wanted is None:
            return self.fits[0]
        return min(self.fits, key=lambda fit: abs(np.log(exposure(fit) / wanted)))


def explain(
    stripes: Stripes,
    chips: ByteArray,
    cameras: Sequence[CameraResponse],
    gamma: float,
    with_gamma: bool = False,
    steps: Sequence[FloatArray | None] = (None,),
    *,
    check: Callable[[], object] = lambda: None,
) -> Explanation | None:
    """Find the timings with which given chips fit a photo's stripes best.

    None is returned if the chips never change, or no fit has levels that a picture can have.
    ``steps``: chips per column to try, in groups; None for all that are possible. A group is tried
    only if those before it do not surely fit. What ``check`` raises ends the search.
    """
    if chips.min() == chips.max():
        return None
    search = TimingSearch(remove_trend(stripes.profile), chips)
    candidates: list[TimingCandidate] = []
    for group in steps:
        candidates = search.candidates(group, gamma, check)
        if candidates[0].correlation >= _LEAST_SURE_CORRELATION:
            break
    if candidates[0].correlation < _LEAST_SURE_CORRELATION:
        # Removing a trend of the mean distorts the stripes of chips that are mostly on or off.
        others = TimingSearch(stripes.flattened, chips).candidates(steps[-1], gamma, check)
        candidates = max(candidates, others, key=lambda found: found[0].correlation)
    return explain_from(_choose_starts(candidates), stripes, chips, cameras, with_gamma, check)


def explain_from(
    starts: Sequence[Timing],
    stripes: Stripes,
    chips: ByteArray,
    cameras: Sequence[CameraResponse],
    with_gamma: bool,
    check: Callable[[], object],
) -> Explanation | None:
    """Fit each camera's response from some timings, and keep the one with the least residual.

    The response of an equalized picture is kept only if its residual is less than half of the
    others'. What ``check`` raises ends the fits.
    """
    found: list[tuple[float, list[StripeFit], CameraResponse]] = []
    for camera in cameras:
        if found and stripes.saturated <= CLIPPED_FRACTION:  # responses then differ little
            starts = [fit.timing for fit in found[0][1]]
        model = StripeModel(stripes.profile, chips, camera.response, starts[0].step, check)
        fits = _fit_from_each(model, starts, with_gamma)
        ratio = _EQUALIZED_RATIO if camera.enhancement == "equalization" else 1.0
        if fits:
            found.append((fits[0].residual / ratio, fits, camera))
    if not found:
        return None
    _, fits, camera = min(found, key=lambda one: one[0])
    least = min(fit.residual for fit in fits)
    good = [fit for fit in fits if fit.residual <= _MOST_EQUAL_RATIO * least]
    good.sort(key=lambda fit: fit.timing.exposure)
    return Explanation(chips, tuple(good), camera)


def _fit_from_each(
    model: StripeModel, starts: Sequence[Timing], with_gamma: bool
) -> list[StripeFit]:
    """Fit from several timings: roughly from all of them, to the end from the promising ones."""
    rough: list[StripeFit] = []
    for start in starts:
        hopeless = _HOPELESS_RATIO * min((fit.residual for fit in rough), default=math.inf)
        rough.append(model.fit(start, with_gamma, _ROUGH_ROUNDS, hopeless))
    # A fit that needs negative light at first may end without.
    rough.sort(key=lambda fit: (not fit.is_possible, fit.residual))
    good = [fit for fit in rough if fit.residual <= _MOST_RESIDUAL_RATIO * rough[0].residual]
    apart = _first_of_each_exposure(good)[:_MOST_FINISHED]
    fits = [model.fit(fit.timing, with_gamma) for fit in apart]
    return _first_of_each_exposure(
        sorted((one for one in fits if one.is_possible), key=lambda fit: fit.residual)
    )


def _choose_starts(candidates: Sequence[TimingCandidate]) -> list[Timing]:
    """Choose the timings to start fits from: the best ones, and those of the shortest exposures.

    Many exposures give similar stripes, so that the search alone does not find the best.
    """
    enough = _LEAST_CORRELATION_RATIO * candidates[0].correlation
    good = [one.timing for one in candidates if one.correlation >= enough]
    shortest = sorted(good, key=lambda timing: timing.exposure)
    return list(dict.fromkeys([*good[:_BEST], *shortest[:_SHORTEST]]))


def _first_of_each_exposure(fits: Sequence[StripeFit]) -> list[StripeFit]:
    """Keep the first fit of each exposure."""
    kept: list[StripeFit] = []
    for fit in fits:
        exposures = [other.timing.exposure for other in kept]
        if all(abs(fit.timing.exposure - other) > _SAME_EXPOSURE for other in exposures):
            kept.append(fit)
    return kept
