"""Tables of a quantity against the grey level, such as the noise of a pixel."""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.interpolation import Places, differences, split_levels
from occ_model.camera.photometry import FLAT_SPAN

_LEVELS = 129


class LevelTable:
    """Even levels from below the lowest to above the highest value, one of them at ``full``.

    A table has a value for each level along its last axis.
    """

    def __init__(self, low: float, high: float, full: float) -> None:
        self.step = max(high - low, FLAT_SPAN) / (_LEVELS - 3)
        if low < full < high:  # noise ends at ``full``
            low -= self.step * (1.0 - (full - low) / self.step % 1.0)
        self.levels: FloatArray = low + self.step * np.arange(_LEVELS, dtype=np.float64)

    @property
    def contrast(self) -> float:
        """The brightest minus the darkest level."""
        return float(self.levels[-1] - self.levels[0])

    def place(self, values: FloatArray) -> Places:
        fraction = (values - self.levels[0]) * ((_LEVELS - 1) / self.contrast)
        np.maximum(fraction, 0.0, out=fraction)
        np.minimum(fraction, _LEVELS - 1.001, out=fraction)
        return split_levels(fraction)

    def interpolate(self, tables: FloatArray, values: FloatArray) -> FloatArray:
        """Interpolate tables (..., levels) at values, shape (..., *values.shape)."""
        below, fraction = self.place(values)
        return np.asarray(tables[..., below] + fraction * differences(tables)[..., below])

    def slope(self, table: FloatArray) -> FloatArray:
        return np.asarray(np.gradient(table, self.step))
