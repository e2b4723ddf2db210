"""What explains a photo's stripes: the timing that fits best for given chips."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.search import Candidate, Search
from occ_model.photo.stripe_fit import StripeFit, StripeModel, Timing
from occ_model.photo.tone import CameraTone
from occ_model.results import Stripes
from occ_model.transmitter.waveform import Waveform

_PROMISING = 0.85
"""Share of the best candidate's correlation from which another is fitted too."""

_MOST_FITS = 8

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
    def rest(self) -> float:
        """Sum of the squares of what the best fit leaves unexplained."""
        return min(fit.rest for fit in self.fits)

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
        None where the chips never change.
    """
    if chips.min() == chips.max():
        return None
    search = Search(stripes.evened, chips)
    candidates = search.candidates(search.steps() if steps is None else steps, gamma)
    starts = _promising(candidates)
    best: Explanation | None = None
    for camera in cameras:
        model = StripeModel(stripes.profile, Waveform(chips), camera.tone, starts[0].step)
        fits = _as_good([model.fit(start, with_gamma) for start in starts])
        found = Explanation(chips, tuple(fits), camera)
        if best is None or found.rest < best.rest:
            best = found
    return best


def _promising(candidates: Sequence[Candidate]) -> list[Timing]:
    """Choose the timings that a fit may end well from, the best first."""
    enough = _PROMISING * candidates[0].correlation
    return [one.timing for one in candidates if one.correlation >= enough][:_MOST_FITS]


def _as_good(fits: Sequence[StripeFit]) -> list[StripeFit]:
    """Keep the best fit and those as good with another exposure, from the shortest exposure."""
    least = min(fit.rest for fit in fits)
    good = sorted((fit for fit in fits if fit.rest <= _AS_GOOD * least), key=lambda fit: fit.rest)
    kept: list[StripeFit] = []
    for fit in good:
        exposures = [other.timing.exposure for other in kept]
        if all(abs(fit.timing.exposure - other) > _SAME_EXPOSURE for other in exposures):
            kept.append(fit)
    return sorted(kept, key=lambda fit: fit.timing.exposure)
