"""Compare a photo's profile with a simulated one, column by column."""

import math

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import enhance
from occ_model.errors import MatchError, ParameterError, inflect
from occ_model.photo.stripes.envelope import MEAN_SHAPES, trend_of, weighted_correlation
from occ_model.results.comparison import Comparison

_LEAST_DEVIATION = 1e-9  # standard deviation below which a profile is constant except for rounding

RIM = 6
"""Columns at either end of a photo's stripes where blur mixes the lamp with its surroundings: in
the two sample photos residuals of up to 140 grey levels end within five columns."""

_EDGES_PER_SHAPE = 4  # edges in view per polynomial of uneven light, so that it fits no stripes


def compare(
    flattened: FloatArray,
    simulated: FloatArray,
    first_column: float = 0.0,
    scale: float = 1.0,
    swing: FloatArray | None = None,
) -> Comparison:
    """Compare a photo's profile with a simulated one, column by column.

    The photo's profile is scaled to the simulation's local mean and standard deviation, as uneven
    brightness says nothing about the stripes. Its outermost columns, where blur mixes the lamp with
    its surroundings, are left out.

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
        Height of the photo's stripes before flattening, by which their columns are weighted. None:
        all columns have the same weight.

    Returns
    -------
    Comparison

    Raises
    ------
    ParameterError
        A profile does not have one value for each column.
    MatchError
        Fewer than two columns of the simulation are covered by the photo.
    """
    if not (np.isfinite(first_column) and np.isfinite(scale) and scale > 0.0):
        raise MatchError(
            f"The photo is placed at column {first_column:g}, scaled by {scale:g}; allowed: "
            "numbers, and a scale above 0."
        )
    swing = np.ones(len(flattened)) if swing is None else swing
    for name, profile in (("flattened", flattened), ("simulated", simulated), ("swing", swing)):
        if np.ndim(profile) != 1:
            shape = np.shape(profile)
            raise ParameterError(f"{name} has the shape {shape}; allowed: a value for each column.")
    rim = min(RIM, len(flattened) // 4)
    # Python's floats overflow to infinity without a warning.
    begin, step = float(first_column), float(scale)
    low, high = begin + rim * step, begin + (len(flattened) - 1 - rim) * step
    first = max(0, math.ceil(min(low, len(simulated))))
    last = math.floor(max(min(high, len(simulated) - 1), -1))
    if last <= first:
        raise MatchError(
            f"The photo lies from column {low:.4g} to {high:.4g} of the simulated picture, which "
            f"has {inflect(len(simulated), 'column')}: it covers fewer than two; move or scale it."
        )
    place = (np.arange(first, last + 1) - first_column) / scale
    columns = np.arange(len(flattened))
    photo, height = (np.interp(place, columns, values) for values in (flattened, swing))
    height /= np.sqrt(np.mean(height**2))
    covered = simulated[first : last + 1]
    shapes = int(np.clip(_edges(photo) // _EDGES_PER_SHAPE, 1, MEAN_SHAPES))
    (mean, deviation), (photo_mean, photo_deviation) = (
        trend_of(one, shapes) for one in (covered, photo)
    )
    flattened_photo = (photo - photo_mean) / photo_deviation
    correlation = 0.0
    if min(photo.std(), covered.std()) > _LEAST_DEVIATION:
        correlation = weighted_correlation(flattened_photo, (covered - mean) / deviation, height**2)
    return Comparison(first, mean + deviation * flattened_photo, covered, correlation, height)


def _edges(profile: FloatArray) -> int:
    """Count changes of a profile from well above its mean to well below it, and back."""
    deviation = profile - profile.mean()
    sides = np.sign(deviation[np.abs(deviation) > 0.5 * deviation.std()])
    return int(np.count_nonzero(np.diff(sides)))


def enhance_comparison(comparison: Comparison, enhanced: FloatArray, method: str) -> Comparison:
    """Compare photo and simulation after the receiver's enhancement of both.

    ``enhanced``, shape (columns,), is the simulated profile after it. ``method`` is applied with
    the photo's own histogram; see :class:`occ_model.camera.enhancement.Enhancement`.
    """
    first = comparison.first_column
    photo = enhance(comparison.photo, method).astype(np.float64)
    simulated = enhanced[first : first + len(photo)]
    correlation = weighted_correlation(photo, simulated, np.ones(len(photo)))
    return Comparison(first, photo, simulated, correlation)
