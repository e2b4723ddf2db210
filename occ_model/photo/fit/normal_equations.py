"""The normal equations of levels that are combinations of Chebyshev polynomials."""

import numpy as np

from occ_model.arrays import FloatArray


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
        count, once = self._freedom, weight * lit
        matrix = np.empty((2 * count, 2 * count))
        matrix[:count, :count] = self._products(weight)
        matrix[:count, count:] = matrix[count:, :count] = self._products(once)
        matrix[count:, count:] = self._products(once * lit)
        return matrix

    def _products(self, weight: FloatArray) -> FloatArray:
        sums = self._shapes @ weight
        return np.asarray(0.5 * (sums[self._up] + sums[self._down]))


def solved(matrix: FloatArray, sums: FloatArray) -> FloatArray:
    """Solve normal equations for sums, shape (levels,) or (any, levels).

    What they leave undetermined is kept small.
    """
    regular = matrix.copy()
    regular.flat[:: len(regular) + 1] += 1e-9 * float(np.trace(matrix))
    return np.asarray(np.linalg.solve(regular, sums.T).T)
