"""The light of columns as a dark level plus a swing times the lit fraction, and its least squares.

The levels c, combinations of shapes S, solve normal equations: the sums over the columns of
w e (S, lit S) are 0, where the error e is the light that is seen of a column less its model
(S, lit S) c, and w its weight.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.photo.stripes.envelope import smooth_shapes
from occ_model.products import combine, row_products

_LEAST_FRACTION = 1e-9  # of the trace of a matrix, added to its diagonal


@dataclass(frozen=True, eq=False, slots=True)
class LitColumns:
    shapes: FloatArray  # shape (shapes, columns); the shapes of which either level is a combination
    lit: FloatArray

    def light(self, levels: FloatArray) -> FloatArray:
        """Return the light of levels, shape (2 shapes,), or of several, (any, 2 shapes)."""
        dark = combine(levels[..., : len(self.shapes)], self.shapes)
        return np.asarray(dark + self.lit * self.swing(levels))

    def swing(self, levels: FloatArray) -> FloatArray:
        """Return the additional light of lit columns."""
        return combine(levels[..., len(self.shapes) :], self.shapes)


class LevelShapes:
    """The Chebyshev polynomials of which either level of a profile is a combination.

    The product of two is half the sum of two others, T_i T_j = (T_(i+j) + T_|i-j|) / 2, so that all
    products follow from one sum for each polynomial.

    ``columns``: of the profile. ``freedom``: number of polynomials. ``kept``: columns of which the
    levels are found, as an index or a mask.
    """

    def __init__(self, columns: int, freedom: int, kept: IndexArray | BoolArray) -> None:
        shapes = smooth_shapes(columns, 2 * freedom - 1)
        self._of_sums = np.ascontiguousarray(shapes[kept].T)
        self.all = np.ascontiguousarray(shapes[:, :freedom].T)
        self.kept = np.ascontiguousarray(self.all[:, kept])
        place = np.arange(freedom)
        self._up, self._down = place[:, None] + place, np.abs(place[:, None] - place)

    def fit(self, lit: FloatArray, weight: FloatArray, change: FloatArray) -> FloatArray:
        """Return the levels that explain a change of the kept columns best.

        ``weight``: shape (kept,), by which light is multiplied before. ``change``: shape (kept,) or
        (any, kept). What the columns leave undetermined is kept small.
        """
        count = len(self._up)
        weights = np.stack([weight**2, weight**2 * lit, (weight * lit) ** 2])
        sums = row_products(weights, self._of_sums)
        dark, both, bright = 0.5 * (sums[:, self._up] + sums[:, self._down])
        matrix = np.empty((2 * count, 2 * count))
        matrix[:count, :count], matrix[count:, count:] = dark, bright
        matrix[:count, count:] = matrix[count:, :count] = both
        matrix.flat[:: len(matrix) + 1] += _LEAST_FRACTION * float(np.trace(matrix))
        towards = [row_products(part * weight * change, self.kept) for part in (1.0, lit)]
        return np.asarray(np.linalg.solve(matrix, np.concatenate(towards, axis=-1).T).T)
