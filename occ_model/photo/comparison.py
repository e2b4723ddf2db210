"""Compare a photo's profile with a simulated one, column by column."""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import enhance
from occ_model.errors import MatchError, ParameterError
from occ_model.results.match import Comparison

_LEAST_DEVIATION = 1e-9
"""Standard deviation below which a profile differs by rounding only."""


def compare(
    flattened: FloatArray,
    simulated: FloatArray,
    first_column: float = 0.0,
    scale: float = 1.0,
    swing: FloatArray | None = None,
) -> Comparison:
    """Compare a photo's profile with a simulated one, column by column.

    The photo's profile is scaled to the simulation's mean and standard deviation: the brightness of
    a photo says nothing about its stripes.

    Parameters
    ----------
    flattened : ndarray of float64, shape (columns of the photo,)
        The photo's profile without its uneven light, at any levels.
    simulated : ndarray of float64, shape (columns,)
        The simulated profile in grey levels.
    first_column
        The column of the simulation on which the photo's first column lies.
    scale
        Columns of the simulation per column of the photo.
    swing : ndarray of float64, shape (columns of the photo,), or None
        Height of the photo's stripes before they were flattened: faint ones count as much less as
        they were stretched. None: all count alike.

    Returns
    -------
    Comparison

    Raises
    ------
    ParameterError
        A profile has not one value for each column.
    MatchError
        Fewer than two columns of the simulation are covered by the photo.
    """
    if not (np.isfinite(first_column) and np.isfinite(scale) and scale > 0.0):
        raise MatchError(
            f"The photo is to lie at column {first_column:g}, scaled by {scale:g}; allowed: "
            "numbers, and a scale above 0."
        )
    swing = np.ones(len(flattened)) if swing is None else swing
    for name, profile in (("flattened", flattened), ("simulated", simulated), ("swing", swing)):
        if np.ndim(profile) != 1:
            shape = np.shape(profile)
            raise ParameterError(f"{name} has the shape {shape}; allowed: a value for each column.")
    first = max(0, int(np.ceil(min(first_column, len(simulated)))))
    last = min(len(simulated) - 1, int(np.floor(first_column + (len(flattened) - 1) * scale)))
    if last <= first:
        raise MatchError("The photo lies beside the simulated picture; move it over the panel.")
    place = (np.arange(first, last + 1) - first_column) / scale
    columns = np.arange(len(flattened))
    seen, height = (np.interp(place, columns, of) for of in (flattened, swing))
    height /= np.sqrt(np.mean(height**2))
    under = simulated[first : last + 1]
    correlation, mean, gain = _agreement(seen, under, height)
    return Comparison(first, mean[1] + gain * (seen - mean[0]), under, correlation, height)


def enhance_comparison(comparison: Comparison, enhanced: FloatArray, method: str) -> Comparison:
    """Compare photo and simulation after the receiver's enhancement of both.

    Parameters
    ----------
    enhanced : ndarray of float64, shape (columns,)
        The simulated profile after it.
    method
        The enhancement, by the photo's own histogram: see
        :class:`occ_model.camera.enhancement.Enhancement`.
    """
    first = comparison.first_column
    photo = enhance(comparison.photo, method).astype(np.float64)
    under = enhanced[first : first + len(photo)]
    return Comparison(first, photo, under, _agreement(photo, under, np.ones(len(photo)))[0])


def _agreement(
    seen: FloatArray, under: FloatArray, height: FloatArray
) -> tuple[float, tuple[float, float], float]:
    """Return the correlation of two profiles, their means, and the ratio of their deviations.

    Correlation and ratio are 0 where one of them has no stripes.
    """
    weights = height**2 / np.sum(height**2)
    means = float(weights @ seen), float(weights @ under)
    a, b = seen - means[0], under - means[1]
    one, other = float(np.sqrt(weights @ a**2)), float(np.sqrt(weights @ b**2))
    if min(one, other) < _LEAST_DEVIATION:
        return 0.0, means, 0.0
    return float(weights @ (a * b)) / (one * other), means, other / one
