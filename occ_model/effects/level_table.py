"""Tables of a quantity against the grey level, such as the noise of a pixel."""

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import FLAT_SPAN

_LEVELS = 129

Places = tuple[NDArray[np.intp], FloatArray]
"""The index of the level below each value, and the fraction of the way to the next level."""


class LevelTable:
    """Even levels from below the lowest to above the highest value, one of them at ``full``.

    A table has a value for each level along its last axis.
    """

    def __init__(self, low: float, high: float, full: float) -> None:
        self.step = max(high - low, FLAT_SPAN) / (_LEVELS - 3)
        if low < full < high:  # noise ends at ``full``
            low -= self.step * (1.0 - (full - low) / self.step % 1.0)
        self.levels: FloatArray = low + self.step * np.arange(_LEVELS, dtype=np.float64)

    def place(self, values: FloatArray) -> Places:
        low, high = float(self.levels[0]), float(self.levels[-1])
        fraction = (values - low) * ((_LEVELS - 1) / (high - low))
        np.maximum(fraction, 0.0, out=fraction)
        np.minimum(fraction, _LEVELS - 1.001, out=fraction)
        below = fraction.astype(np.intp)
        fraction -= below
        return below, fraction

    def interpolate_at(self, table: FloatArray, places: Places) -> FloatArray:
        """Interpolate one table at the places of values; the result has the values' shape."""
        below, fraction = places
        return np.asarray(table.take(below) + fraction * _differences(table).take(below))

    def interpolate(self, tables: FloatArray, values: FloatArray) -> FloatArray:
        """Interpolate tables (..., levels) at values, shape (..., *values.shape)."""
        below, fraction = self.place(values)
        return np.asarray(tables[..., below] + fraction * _differences(tables)[..., below])

    def interpolate_each(self, tables: FloatArray, values: FloatArray) -> FloatArray:
        """Interpolate the n-th table at the n-th of the values along their first axis."""
        below, fraction = self.place(values)
        below += _LEVELS * np.arange(len(tables)).reshape(-1, *(1,) * (values.ndim - 1))
        return self.interpolate_at(tables.ravel(), (below, fraction))

    def slope(self, table: FloatArray) -> FloatArray:
        ends = np.concatenate([table[:1], table, table[-1:]])
        slope = (ends[2:] - ends[:-2]) / (2.0 * self.step)
        slope[[0, -1]] *= 2.0
        return np.asarray(slope)

    def divide_weights(self, weights: FloatArray, places: Places) -> FloatArray:
        """Divide each weight between the two levels next to its place.

        The product of a table with the result is the weighted sum of the interpolated values.
        """
        below, fraction = places
        above = (weights * fraction).ravel()
        sums = np.asarray(np.bincount(below.ravel(), weights.ravel() - above, _LEVELS), float)
        sums[1:] += np.bincount(below.ravel(), above, _LEVELS)[:-1]
        return sums


def _differences(tables: FloatArray) -> FloatArray:
    """Return the differences of neighbours, faster than ``np.diff``."""
    return np.asarray(tables[..., 1:] - tables[..., :-1])
