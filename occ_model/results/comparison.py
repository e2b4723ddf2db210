"""A photo's profile beside a simulated one."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray

_TYPICAL_QUANTILE = 0.95  # of the residual's magnitude, to scale an axis regardless of single edges


@dataclass(frozen=True, eq=False, slots=True)
class Comparison:
    """A photo's profile beside a simulated one, by columns of the simulation.

    Parameters
    ----------
    first_column
        First column of the simulation that the photo covers.
    photo : ndarray of float64, shape (columns,)
        The photo's profile corrected for uneven light, in the simulation's grey levels.
    simulated : ndarray of float64, shape (columns,)
        The simulation's profile in these columns.
    correlation
        Correlation of the two; 0 if one of them is flat.
    height : ndarray of float64, shape (columns,), or None
        Height of the photo's stripes, relative to its RMS, as a weight of columns; None for equal
        weights.
    """

    first_column: int
    photo: FloatArray
    simulated: FloatArray
    correlation: float
    height: FloatArray | None = None

    @property
    def residual(self) -> FloatArray:
        """The photo's profile minus the simulated one, in grey levels, shape (columns,).

        It is scaled by the height of the photo's stripes.
        """
        residual = self.photo - self.simulated
        return residual if self.height is None else residual * self.height

    @property
    def largest_residual(self) -> float:
        """Largest magnitude of the residual, in grey levels."""
        return float(np.abs(self.residual).max())

    @property
    def usual_residual(self) -> float:
        """Magnitude of the residual, in grey levels, that 95 % of the columns do not exceed."""
        return float(np.quantile(np.abs(self.residual), _TYPICAL_QUANTILE))

    @property
    def rmse(self) -> float:
        """Root mean square of the residual, in grey levels."""
        return float(np.sqrt(np.mean(self.residual**2)))
