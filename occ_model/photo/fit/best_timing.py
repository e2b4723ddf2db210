"""What explains a photo's stripes: the timing that fits best for given chips."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.fit.camera_response import CameraTone
from occ_model.photo.fit.initial_search import Candidate, Search
from occ_model.photo.fit.least_squares import StripeFit, StripeModel
from occ_model.photo.fit.timing import Timing
from occ_model.photo.stripes.envelope import without_trend
from occ_model.results import Stripes
from occ_model.transmitter.waveform import Waveform

_SURELY = 0.9
"""Correlation from which a candidate is no chance."""

_PROMISING = 0.85
"""Share of the best candidate's correlation from which another is fitted too."""

_BEST, _SHORTEST = 4, 4
"""How many of the best candidates are fitted, and of the shortest exposures."""

_AROUND = (0.85, 0.93, 1.07, 1.15)
"""Shares of an exposure that a fit is tried again with."""

_VALLEY = 1e-3
"""Chips within which fits are the same."""

_AS_GOOD = 1.05
"""By what factor a fit may leave more unexplained than the best and still explain as well."""

_SAME_EXPOSURE = 0.04
"""Chips within which two fits found the same exposure."""


@dataclass(frozen=True, eq=False, slots=True)
class Explanation:
    """Chips and the fits that explain a photo's stripes with them.

    Parameters
    ----------
    chips : ndarray of uint8, shape (chips,)
        One period.
    fits
        The best fit and those that are as good with another exposure, from the shortest exposure.
    camera
        What the camera made of the light.
    """

    chips: ByteArray
    fits: tuple[StripeFit, ...]
    camera: CameraTone

    @property
    def correlation(self) -> float:
        """Of the best fit."""
        return max(fit.correlation for fit in self.fits)

    def nearest(self, exposure: Callable[[StripeFit], float], wanted: float | None) -> StripeFit:
        """Choose among fits that are as good: the exposure nearest to one noted, or the shortest.

        Parameters
        ----------
        exposure
            Gives a fit's exposure time in seconds.
        wanted
            Seconds, or None.
        """
        if wanted is None:
            return self.fits[0]
        return min(self.fits, key=lambda fit: abs(np.log(exposure(fit) / wanted)))


def explain(
    stripes: Stripes,
    chips: ByteArray,
    cameras: Sequence[CameraTone],
    gamma: float,
    with_gamma: bool = False,
    steps: FloatArray | None = None,
) -> Explanation | None:
    """Find the timings with which known chips explain a photo's stripes.

    Parameters
    ----------
    stripes
        The stripes.
    chips : ndarray of uint8, shape (chips,)
        One period of what was sent.
    cameras
        What the camera may have made of the light, each of which is tried.
    gamma
        The camera's.
    with_gamma
        Whether it is fitted too.
    steps : ndarray of float64
        Chips a column to try; by default all that are possible.

    Returns
    -------
    Explanation or None
        None where the chips never change, or no fit of them can be a picture.
    """
    if chips.min() == chips.max():
        return None
    candidates = _candidates(without_trend(stripes.profile), chips, steps, gamma)
    if candidates[0].correlation < _SURELY:
        # Chips that are mostly on, or mostly off, swing about no mean: their levels tell more.
        others = _candidates(stripes.flattened, chips, steps, gamma)
        candidates = max(candidates, others, key=lambda found: found[0].correlation)
    starts = _promising(candidates)
    best: tuple[StripeModel, list[StripeFit], CameraTone] | None = None
    for camera in cameras:
        model = StripeModel(
            stripes.profile, Waveform(chips), camera.tone, starts[0].step, camera.rank_resolution
        )
        fits = _apart([model.fit(start, with_gamma) for start in starts])
        if fits and (best is None or fits[0].residual < best[1][0].residual):
            best = model, fits, camera
    if best is None:
        return None
    model, fits, camera = best
    polished = _apart([_polished(model, fit, with_gamma) for fit in _as_good(fits)])
    return Explanation(chips, tuple(_as_good(polished)), camera) if polished else None


def _candidates(
    even: FloatArray, chips: ByteArray, steps: FloatArray | None, gamma: float
) -> list[Candidate]:
    search = Search(even, chips)
    return search.candidates(search.steps() if steps is None else steps, gamma)


def _promising(candidates: Sequence[Candidate]) -> list[Timing]:
    """Choose the timings that a fit may end well from: the best, and the shortest exposures.

    Many exposures make much the same stripes, so that the search cannot tell which is best.
    """
    enough = _PROMISING * candidates[0].correlation
    good = [one.timing for one in candidates if one.correlation >= enough]
    shortest = sorted(good, key=lambda timing: timing.exposure)
    return list(dict.fromkeys([*good[:_BEST], *shortest[:_SHORTEST]]))


def _apart(fits: Sequence[StripeFit]) -> list[StripeFit]:
    """Keep one possible fit of each exposure, the best first."""
    kept: list[StripeFit] = []
    for fit in sorted((one for one in fits if one.is_possible), key=lambda fit: fit.residual):
        exposures = [other.timing.exposure for other in kept]
        if all(abs(fit.timing.exposure - other) > _SAME_EXPOSURE for other in exposures):
            kept.append(fit)
    return kept


def _polished(model: StripeModel, fit: StripeFit, with_gamma: bool) -> StripeFit:
    """Fit again round a fit, and take the middle of what is about as likely.

    The lit fraction has corners, and few columns see an edge: what is left unexplained has many
    small valleys, and which of them is the deepest says little.
    """
    around = [replace(fit.timing, exposure=share * fit.timing.exposure) for share in _AROUND]
    fits = [fit, *(model.fit(timing, with_gamma) for timing in around)]
    best = min(fits, key=lambda one: one.residual)
    exposures = [one.timing.exposure for one in fits if one.residual <= best.likely]
    spread = 0.5 * (max(exposures) - min(exposures))
    if spread < _VALLEY:
        return best
    middle = replace(best.timing, exposure=0.5 * (max(exposures) + min(exposures)))
    return model.fit(middle, with_gamma, spread)


def _as_good(fits: Sequence[StripeFit]) -> list[StripeFit]:
    """Keep the best fit and those as good with another exposure, from the shortest exposure."""
    least = min(fit.residual for fit in fits)
    good = [fit for fit in fits if fit.residual <= _AS_GOOD * least]
    return sorted(good, key=lambda fit: fit.timing.exposure)
