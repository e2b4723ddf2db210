"""Quantities that are tabulated over the grey levels, such as the noise of a pixel."""

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import FLAT_SPAN

_LEVELS = 129

Places = tuple[NDArray[np.intp], FloatArray]
"""The level below each value, and how far the value lies towards the next one."""


class LevelTable:
    """Levels from the lowest to the highest value, both with a margin, one of them at ``full``.

    A table of any quantity has a value for each, along its last axis.
    """

    def __init__(self, low: float, high: float, full: float) -> None:
        self.step = max(high - low, FLAT_SPAN) / (_LEVELS - 3)
        if low < full < high:  # where noise ends
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

    def at(self, table: FloatArray, places: Places) -> FloatArray:
        """Interpolate one table, shape as ``places``."""
        below, fraction = places
        return np.asarray(table.take(below) + fraction * _steps(table).take(below))

    def look(self, tables: FloatArray, values: FloatArray) -> FloatArray:
        """Interpolate tables at values: (..., *values.shape)."""
        below, fraction = self.place(values)
        return np.asarray(tables[..., below] + fraction * _steps(tables)[..., below])

    def look_each(self, tables: FloatArray, values: FloatArray) -> FloatArray:
        """Interpolate a table of its own for each of the values along their first axis."""
        below, fraction = self.place(values)
        below += _LEVELS * np.arange(len(tables)).reshape(-1, *(1,) * (values.ndim - 1))
        return self.at(tables.ravel(), (below, fraction))

    def slope(self, table: FloatArray) -> FloatArray:
        ends = np.concatenate([table[:1], table, table[-1:]])
        slope = (ends[2:] - ends[:-2]) / (2.0 * self.step)
        slope[[0, -1]] *= 2.0
        return np.asarray(slope)

    def divided(self, weights: FloatArray, places: Places) -> FloatArray:
        """Divide weights among the levels beside their places.

        The product of a table with it is the weighted sum of what is interpolated there.
        """
        below, fraction = places
        above = (weights * fraction).ravel()
        found = np.asarray(np.bincount(below.ravel(), weights.ravel() - above, _LEVELS), float)
        found[1:] += np.bincount(below.ravel(), above, _LEVELS)[:-1]
        return found


def _steps(tables: FloatArray) -> FloatArray:
    """Return the differences of neighbours, faster than NumPy."""
    return np.asarray(tables[..., 1:] - tables[..., :-1])
