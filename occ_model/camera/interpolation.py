"""Linear interpolation in a table whose levels are one step apart."""

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray

Places = tuple[NDArray[np.intp], FloatArray]
"""The index of the level below each value, and the fraction of the way to the next level."""


def split_levels(levels: FloatArray) -> Places:
    """Split values in units of levels, from 0; the last level has no next one.

    ``levels`` are overwritten.
    """
    below = levels.astype(np.intp)
    levels -= below
    return below, levels


def interpolate_at(table: FloatArray, places: Places) -> FloatArray:
    """Interpolate a table at the places of values; the result has the values' shape."""
    below, fraction = places
    # At the last level the fraction is 0, so that any difference will do.
    slopes = differences(table).take(below, mode="clip")
    return np.asarray(table.take(below) + fraction * slopes)


def divide_weights(weights: FloatArray, places: Places, count: int) -> FloatArray:
    """Divide each weight between the two levels next to its place; of ``count`` levels in all.

    The product of a table with the result is the weighted sum of the interpolated values.
    """
    below, fraction = places
    above = (weights * fraction).ravel()
    sums = np.asarray(np.bincount(below.ravel(), weights.ravel() - above, count), float)
    sums[1:] += np.bincount(below.ravel(), above, count)[:-1]
    return sums


def differences(tables: FloatArray) -> FloatArray:
    """Return the differences of neighbours, faster than ``np.diff``."""
    return np.asarray(tables[..., 1:] - tables[..., :-1])
