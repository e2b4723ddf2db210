"""The light of columns by levels, one of them times what is lit, and the levels' normal equations.

The levels c, combinations of shapes S, solve normal equations: the sums over the columns of
w e (S, lit S) are 0, where the error e is the light that is seen of a column less its model
(S, lit S) c, and w its weight.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.products import combined, row_products

_LEAST_FRACTION = 1e-9  # of the trace of a matrix, added to its diagonal


@dataclass(frozen=True, eq=False, slots=True)
class LitColumns:
    shapes: FloatArray  # shape (shapes, columns); the shapes of which either level is a combination
    lit: FloatArray

    def light(self, levels: FloatArray) -> FloatArray:
        """Return the light of levels, shape (2 shapes,), or of several, (any, 2 shapes)."""
        dark = combined(levels[..., : len(self.shapes)], self.shapes)
        return np.asarray(dark + self.lit * self.swing(levels))

    def swing(self, levels: FloatArray) -> FloatArray:
        """Return the additional light of lit columns."""
        return combined(levels[..., len(self.shapes) :], self.shapes)

    def sums(self, values: FloatArray) -> FloatArray:
        """Sum what levels multiply times values, shape (columns,) or (any, columns)."""
        both = [row_products(part, self.shapes) for part in (values, self.lit * values)]
        return np.concatenate(both, axis=-1)


class NormalEquations:
    """The matrices of least squares for two levels, the second one times what is lit.

    Of Chebyshev polynomials the product is half the sum of two others,
    T_i T_j = (T_(i+j) + T_|i-j|) / 2: all products follow from one sum for each polynomial.

    ``shapes``: shape (columns, 2 freedom - 1), the polynomials at some columns. ``freedom``: the
    number of them of which either level is a combination.
    """

    def __init__(self, shapes: FloatArray, freedom: int) -> None:
        self._shapes, self._freedom = np.ascontiguousarray(shapes.T), freedom
        place = np.arange(freedom)
        self._up, self._down = place[:, None] + place, np.abs(place[:, None] - place)

    def matrix(self, weight: FloatArray, lit: FloatArray) -> FloatArray:
        """Return the matrix for the weights and the lit fractions of the columns."""
        count = self._freedom
        weights = np.stack([weight, weight * lit, weight * lit**2])
        sums = row_products(weights, self._shapes)
        dark, both, bright = 0.5 * (sums[:, self._up] + sums[:, self._down])
        matrix = np.empty((2 * count, 2 * count))
        matrix[:count, :count], matrix[count:, count:] = dark, bright
        matrix[:count, count:] = matrix[count:, :count] = both
        return matrix


def solved(matrix: FloatArray, sums: FloatArray) -> FloatArray:
    """Solve normal equations for sums, shape (levels,) or (any, levels).

    What they leave undetermined is kept small.
    """
    regular = matrix.copy()
    regular.flat[:: len(regular) + 1] += _LEAST_FRACTION * float(np.trace(matrix))
    return np.asarray(np.linalg.solve(regular, sums.T).T)
