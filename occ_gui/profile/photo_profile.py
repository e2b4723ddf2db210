"""What of a photo is drawn beside a simulated profile."""

from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.results import Comparison


@dataclass(frozen=True, eq=False, slots=True)
class PhotoProfile:
    """A photo's profile as it lies on a simulated one.

    Parameters
    ----------
    comparison
        The two side by side, None where ``sentence`` says why they cannot be compared.
    raw : ndarray of float64, shape (columns of the photo,)
        Mean of each column of the whole photo, in grey levels.
    first_column, scale
        The simulation's column under the photo's first, and its columns to one of the photo.
    sentence
        Why there is no comparison; empty also while it is still being worked on.
    """

    comparison: Comparison | None
    raw: FloatArray
    first_column: float = 0.0
    scale: float = 1.0
    sentence: str = ""
