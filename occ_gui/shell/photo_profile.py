"""Profile of a photo, placed beside a simulated one."""

from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.results.match import Comparison


@dataclass(frozen=True, eq=False, slots=True)
class PhotoProfile:
    """A photo's profile in the columns of a simulated one.

    Parameters
    ----------
    comparison
        Both profiles compared, None if ``sentence`` says why that is impossible.
    raw : ndarray of float64, shape (columns of the photo,)
        Mean of each column of the whole photo, in grey levels.
    first_column, scale
        The simulated column under the photo's first one, and simulated columns per photo column.
    sentence
        Why there is no comparison; also empty while the photo is searched for stripes.
    """

    comparison: Comparison | None
    raw: FloatArray
    first_column: float = 0.0
    scale: float = 1.0
    sentence: str = ""
