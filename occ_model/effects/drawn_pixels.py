"""How drawn pixels change without their noise, or with another mean, at each level of their law.

A pixel keeps its random number, and so changes from a quantile of one law to that of another.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.grey_law import GreyLaw, law_of_known_gains
from occ_model.camera.interpolation import interpolate_at
from occ_model.camera.photometry import WHITE
from occ_model.effects.normal_noise import rounding_growth

_GAINS, _GAIN_WEIGHTS = np.polynomial.hermite_e.hermegauss(7)
_TINY = 1e-12


@dataclass(frozen=True, eq=False, slots=True)
class DrawnPixels:
    """What drawn pixels become by a curve of the grey levels, at each level of the law.

    Variances and changes are those about the mean.
    """

    mean: FloatArray
    squared_steps: FloatArray  # Mean sum of the squares of all steps up to a pixel's level
    step: FloatArray  # Mean change of the pixels that change at all if their mean changes a little
    spread: FloatArray  # Standard deviation beyond that of two levels next to each other

    variances: tuple[FloatArray, FloatArray]  # Added by the drawn numbers, and by the gains
    # Mean square if no number is drawn, and if all gains are 1
    changes: tuple[FloatArray, FloatArray]


def step_of(means: FloatArray, squared_steps: FloatArray) -> FloatArray:
    """Return the mean change of the pixels that change at all, from the changes of both means."""
    return np.asarray(np.abs(squared_steps) / np.maximum(np.abs(means), _TINY))


def growth_by_steps(means: FloatArray, squared_steps: FloatArray) -> FloatArray:
    """Return what steps of one size add to the mean square change of pixels.

    Where the mean changes by less than a step, a fraction of the pixels moves by a whole one.
    """
    step = np.maximum(step_of(means, squared_steps), _TINY)
    return np.asarray(step**2 * rounding_growth(np.abs(means) / step))


@lru_cache(maxsize=8)
def drawn_pixels(law: GreyLaw, curve: bytes, *, is_rounded: bool) -> DrawnPixels:
    """Tabulate the pixels of a law after a curve of 256 grey levels.

    Pixels that are not drawn are rounded to grey levels, and enhanced, if ``is_rounded``.
    """
    noise, greys = law.noise, np.frombuffer(curve)
    known = law_of_known_gains(noise, float(law.values[-1]))
    steps = np.zeros(256)
    steps[law.greys[1:]] = np.cumsum(np.diff(greys[law.greys]) ** 2)
    mean, square, squared_steps = (law.mean_of(each) for each in (greys, greys**2, steps))
    of_known = [known.mean_of(each) for each in (greys, greys**2, steps)]
    gain = np.maximum(1.0 + noise.gain_variation * _GAINS[:, None], 0.0) ** (1.0 / noise.gamma)
    values = law.values * gain
    places, at_mean = known.places(values), known.places(law.values)
    own_mean, own_square, own_steps = (interpolate_at(each, places) for each in of_known)
    undrawn = np.minimum(values, WHITE * min(noise.full / noise.white, 1.0) ** (1.0 / noise.gamma))
    if is_rounded:
        undrawn = greys[np.rint(undrawn).astype(np.int64)]
    moved = own_mean - interpolate_at(of_known[0], at_mean)
    moved_steps = own_steps - interpolate_at(of_known[2], at_mean)
    read = _mean(np.maximum(own_square - own_mean**2, 0.0))
    step = step_of(np.gradient(mean), np.gradient(squared_steps))
    return DrawnPixels(
        mean,
        squared_steps,
        step,
        spread=np.sqrt(np.maximum(square - mean**2 - step**2 / 4.0, 0.0)),
        variances=(read, _variance(own_mean)),
        changes=(
            read + _variance(own_mean - undrawn),
            _variance(moved) + _mean(growth_by_steps(moved, moved_steps)),
        ),
    )


def _mean(of_gains: FloatArray) -> FloatArray:
    return np.asarray(_GAIN_WEIGHTS @ of_gains / _GAIN_WEIGHTS.sum())


def _variance(of_gains: FloatArray) -> FloatArray:
    return np.asarray(np.maximum(_mean(of_gains**2) - _mean(of_gains) ** 2, 0.0))
