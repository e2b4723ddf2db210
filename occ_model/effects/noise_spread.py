"""The standard deviation of noise, for many pixels."""

from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.picture_rows import Rows
from occ_model.camera.row_interpolation import smooth_columns
from occ_model.camera.sensor import saturation_value
from occ_model.effects.effect import NoiseEffect
from occ_model.scene.scene import Scene

_PER_LEVEL = 4
"""Entries of the table to a grey level."""

_TABULATED: FloatArray = np.arange(256 * _PER_LEVEL + 1) / _PER_LEVEL

_TOLERANCE = 0.01
"""Largest error of an interpolated deviation, in grey levels."""


class NoiseSpread:
    """The standard deviation of all noise of some effects together, in grey levels."""

    def __init__(self, effects: Sequence[NoiseEffect], scene: Scene) -> None:
        self._effects = effects
        self._scene = scene
        self._table = self._exact(_TABULATED).astype(np.float32)
        self._steps = np.append(np.diff(self._table), np.float32(0.0))
        self._full = np.float32(saturation_value(scene))
        self._known: tuple[Pixels | None, Pixels] = (None, self._table)

    def __call__(self, values: Pixels) -> Pixels:
        """Return the deviations of pixels with some mean values before saturation, same shape.

        Those of more than one row are read from a table, in quarters of a grey level. A full pixel,
        whose value need not be one of them, has none.
        """
        if len(values) == 1:
            return self._exact(values.astype(np.float64)).astype(np.float32)
        place = np.minimum(values, np.float32(_TABULATED[-1]))
        np.maximum(place, np.float32(0.0), out=place)
        place *= np.float32(_PER_LEVEL)
        entry = place.astype(np.int32)
        place -= entry
        place *= self._steps[entry]
        place += self._table[entry]
        place[values >= self._full] = 0.0
        return place

    def scale(self, normal: Pixels, rows: Rows, each_row: Rows) -> None:
        """Multiply numbers by the deviations of the pixels of some rows.

        ``rows``, ``each_row``: the mean values, as they are known and without weights.
        """
        known, spread = self._known
        if rows.nodes is not known:  # most rows are like the previous rows
            spread = self(rows.nodes)
            self._known = (rows.nodes, spread)
        rims = [self(rim.values) for rim in rows.rims]
        if rows.weights is None or smooth_columns(spread, _TOLERANCE).all():
            rows.combine(np.multiply, normal, spread, rims)
        else:
            each_row.combine(np.multiply, normal, self(each_row.nodes), rims)

    def _exact(self, values: FloatArray) -> FloatArray:
        squares = sum(effect.spread(self._scene, values) ** 2 for effect in self._effects)
        return np.asarray(np.sqrt(squares))
