"""The light of columns: levels that are combinations of shapes, one of them times what is lit.

The levels c solve normal equations: the sums over the columns of w e (S, lit S) are 0, where the
error e is the light that is seen of a column less its model (S, lit S) c, and w its weight. Where
lit fractions, seen light and weights change, so do the levels: the equations' derivative is linear
in the levels' slopes, with the matrix of the equations.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray


@dataclass(frozen=True, eq=False, slots=True)
class LitColumns:
    """Some columns."""

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
