"""The light of columns by levels, one of them times what is lit, and the levels' normal equations.

The levels c, combinations of shapes S, solve normal equations: the sums over the columns of
w e (S, lit S) are 0, where the error e is the light that is seen of a column less its model
(S, lit S) c, and w its weight. Where lit fractions, seen light and weights change, so do the
levels: the equations' derivative is linear in their slopes, with the matrix of the equations.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray

_LEAST_FRACTION = 1e-9  # of the trace of a matrix, added to its diagonal
_MOST_STEPS, _HALVINGS = 40, 10  # Newton's, and those that find the fraction of one of them


@dataclass(frozen=True, eq=False, slots=True)
class LitColumns:
    shapes: FloatArray  # shape (shapes, columns); the shapes of which either level is a combination
    lit: FloatArray

    def light(self, levels: FloatArray) -> FloatArray:
        """Return the light of levels, shape (2 shapes,), or of several, (any, 2 shapes)."""
        dark = levels[..., : len(self.shapes)] @ self.shapes
        return np.asarray(dark + self.lit * self.swing(levels))

    def swing(self, levels: FloatArray) -> FloatArray:
        """Return the light that being lit adds."""
        return np.asarray(levels[..., len(self.shapes) :] @ self.shapes)

    def sums(self, values: FloatArray) -> FloatArray:
        """Sum what levels multiply times values, shape (columns,) or (any, columns)."""
        both = values @ self.shapes.T, (self.lit * values) @ self.shapes.T
        return np.concatenate(both, axis=-1)

    def slopes(self, levels: FloatArray, of_levels: FloatArray, by_lit: FloatArray) -> FloatArray:
        """Return the light's slopes, shape (parameters, columns).

        ``by_lit``: shape (first parameters, columns), the lit fractions' slopes over the first of
        the parameters, on which they depend.
        """
        slopes = self.light(of_levels)
        slopes[: len(by_lit)] += self.swing(levels) * by_lit
        return slopes

    def pulls(
        self,
        levels: FloatArray,
        weight: FloatArray,
        error: FloatArray,
        by_lit: FloatArray,
        by_tone: FloatArray,
    ) -> FloatArray:
        """Return the slopes of the sums that are 0, the levels being fixed.

        ``weight``, ``error``: shape (columns,), the weight of each column's light, and what is seen
        of it less its model. ``by_tone``: shape (other parameters, columns), the slopes of weight
        times error over what changes the light that is seen. Shape (parameters, 2 shapes).
        """
        pull = -weight * self.swing(levels)
        of_dark = (pull * by_lit) @ self.shapes.T
        of_lit = ((self.lit * pull + weight * error) * by_lit) @ self.shapes.T
        return np.vstack([np.hstack([of_dark, of_lit]), self.sums(by_tone)])


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
    regular = _with_diagonal(matrix, _LEAST_FRACTION * float(np.trace(matrix)))
    return np.asarray(np.linalg.solve(regular, sums.T).T)


def _with_diagonal(matrix: FloatArray, least: float) -> FloatArray:
    found = matrix.copy()
    found.flat[:: len(found) + 1] += least
    return found


def at_least_one(
    matrix: FloatArray,
    sums: FloatArray,
    columns: FloatArray,
    weight: float,
    below: NDArray[np.bool_],
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Solve normal equations for levels by which further columns are at least 1.

    What a column is below 1 is squared and counts ``weight``. The misfit is quadratic piece by
    piece: Newton's steps lead to its minimum, each as long as the misfit decreases.

    ``columns``: shape (levels, further columns). ``below``: which of them are guessed to be below
    1. The equations in which those that are count as seen at 1, the levels, and which ones are.
    """
    most = float(np.trace(matrix) + weight * np.sum(columns**2))
    matrix = _with_diagonal(matrix, _LEAST_FRACTION * most)

    def counted(below: NDArray[np.bool_]) -> tuple[FloatArray, FloatArray]:
        some = columns[:, below]
        together = matrix + weight * some @ some.T
        return together, np.linalg.solve(together, sums + weight * some.sum(axis=1))

    def fraction(levels: FloatArray, change: FloatArray) -> float:
        """Return the fraction of a change that leads to its least misfit."""
        light, by_change = levels @ columns, change @ columns
        slope, rise = change @ (matrix @ levels - sums), change @ matrix @ change
        low, high = 0.0, 1.0
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            short = np.maximum(1.0 - light - middle * by_change, 0.0)
            is_beyond = slope + middle * rise > weight * short @ by_change
            low, high = (low, middle) if is_beyond else (middle, high)
        return high

    together, wanted = counted(below)
    levels = wanted
    for _ in range(_MOST_STEPS):
        if np.array_equal(wanted @ columns < 1.0, below):
            return together, wanted, below
        if levels is not wanted:
            levels = levels + fraction(levels, wanted - levels) * (wanted - levels)
        below = levels @ columns < 1.0
        together, wanted = counted(below)
    return together, levels, below
