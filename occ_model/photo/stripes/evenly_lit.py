"""Gather the pixels of a lamp that are about equally bright into profiles of their own.

A mean over pixels of which some are clipped is no response of any light. Within a group of pixels
that the lamp lights alike, each column is either clipped, or tells the light exactly. A round lamp
has such groups too, and its profile's swing then does not follow its disc.
"""

from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region

_BANDS = 64
"""Largest number of bands of rows whose pixels are compared."""

_CLIPPED = 0.98
"""Share of white from which a pixel may have been clipped: compression changes it a little."""

_CLIPPED_FRACTION = 0.002
"""Share of clipped pixels from which a profile is no longer fitted as if it had none."""

_SOME, _ALL = 0.005, 0.9
"""Shares of a column's pixels up to which it counts as not clipped, and from which as clipped."""

_BLURRED_COLUMNS = 3
"""Columns beside a clipped one that blur may have darkened."""

_EVEN = 0.6
"""Share of the brightest light from which pixels that are not clipped are one group."""

_USUAL = 0.75
"""Quantile along a row of its brightness, where its ends do not show the lamp."""

_STEPS = (0.2, 0.35, 0.5, 0.65, 0.8)
"""Shares of white that divide pixels into groups where others are clipped."""

_CORES = 2
"""Number of groups into which the pixels that are clipped while lit are divided."""

_MOST_GROUPS = 3
_HALF_WEIGHT_ROWS = 16.0
"""Rows that tell half of what any number of them would: their noise is averaged out, and what the
camera's processing does to the stripes is the same in all of them."""

_LEAST_COLUMNS = 24
_LEAST_CELLS = 0.15
"""Share of a group's usual number of pixels that a column must have to be used."""


@dataclass(frozen=True, eq=False, slots=True)
class EvenProfile:
    """A profile of pixels that the lamp lights about equally.

    Parameters
    ----------
    values : ndarray of float64, shape (columns of the region,)
        Mean of the group's pixels in each column, in grey levels.
    kept : ndarray of bool, shape as ``values``
        The columns in which none of them is clipped.
    clipped : ndarray of bool, shape as ``values``
        The columns in which all of them are: the light is at least what makes white.
    rows
        Number of the photo's rows over which a column's mean is taken, in the median.
    """

    values: FloatArray
    kept: NDArray[np.bool_]
    clipped: NDArray[np.bool_]
    rows: float

    @property
    def tells(self) -> float:
        """How much it tells: its columns, each by the share of noise that its rows average out."""
        return float(self.kept.sum()) * self.rows / (self.rows + _HALF_WEIGHT_ROWS)


@dataclass(frozen=True, eq=False, slots=True)
class Cells:
    """A region's pixels, averaged over bands of rows.

    Parameters
    ----------
    means : ndarray of float32, shape (bands, columns)
        In grey levels.
    clipped : ndarray of float32, shape (bands, columns)
        Share of clipped pixels.
    rows_a_band
        Number of the photo's rows in a band, on average.
    """

    means: NDArray[np.float32]
    clipped: NDArray[np.float32]
    rows_a_band: float

    @classmethod
    def of(cls, photo: Photo, region: Region) -> "Cells":
        """Average a region of a photo over bands of rows."""
        part = photo.samples[
            region.first_row : region.last_row, region.first_column : region.last_column
        ]
        starts = np.linspace(0, len(part), min(_BANDS, len(part)) + 1).astype(np.int64)
        full = (part >= _CLIPPED * photo.white).view(np.uint8)
        means, clipped = [], []
        for first, last in pairwise(starts.tolist()):
            means.append(_row_mean(part[first:last]) * (WHITE / photo.white))
            clipped.append(_row_mean(full[first:last]))
        return cls(
            np.array(means, dtype=np.float32),
            np.array(clipped, dtype=np.float32),
            len(part) / len(means),
        )

    def profiles(self, width: int) -> list[EvenProfile]:
        """Return the profiles of pixels that are lit alike.

        Parameters
        ----------
        width
            Number of columns within which the lamp is surely lit for once.
        """
        width = max(3, min(width, 2 * self.means.shape[1] - 1)) | 1
        lit = cv2.dilate(self.means, np.ones((1, width), dtype=np.uint8))
        lit = cv2.blur(lit, (width, 1), borderType=cv2.BORDER_REFLECT)
        rows = np.quantile(lit, _USUAL, axis=1)
        shows = lit > _EVEN * rows[:, None]
        if float(self.clipped.mean()) < _CLIPPED_FRACTION:
            groups = [rows > _EVEN * rows.max()]
        else:
            groups = self._groups(rows)
        found = [self._profile(shows & group[:, None]) for group in groups]
        profiles = [one for one in found if one is not None]
        profiles.sort(key=lambda one: -one.tells)
        return profiles[:_MOST_GROUPS]

    def _groups(self, rows: FloatArray) -> list[NDArray[np.bool_]]:
        """Divide the bands of rows, where some pixels are clipped."""
        steps = [*(step * WHITE for step in _STEPS), _CLIPPED * WHITE]
        groups = [(low < rows) & (rows <= high) for low, high in pairwise(steps)]
        core = rows > steps[-1]
        if core.any():
            # The brighter a row is lit, the more of it is clipped.
            share = self.clipped.mean(axis=1)
            ranks = np.quantile(share[core], np.linspace(0.0, 1.0, _CORES + 1))
            groups += [core & (low <= share) & (share <= high) for low, high in pairwise(ranks)]
        return [group for group in groups if group.any()]

    def _profile(self, group: NDArray[np.bool_]) -> EvenProfile | None:
        count = group.sum(axis=0, dtype=np.float64)
        if not count.any():
            return None
        seen = count >= max(1.0, _LEAST_CELLS * float(np.median(count[count > 0.0])))
        count = np.maximum(count, 1.0)
        values = np.where(group, self.means, 0.0).sum(axis=0, dtype=np.float64) / count
        share = np.where(group, self.clipped, 0.0).sum(axis=0, dtype=np.float64) / count
        near = cv2.dilate(
            (share > _SOME).astype(np.uint8)[None], np.ones((1, 2 * _BLURRED_COLUMNS + 1), np.uint8)
        )[0]
        kept = seen & (near == 0)
        if kept.sum() < _LEAST_COLUMNS:
            return None
        rows = self.rows_a_band * float(np.median(count[kept]))
        return EvenProfile(values, kept, seen & (share > _ALL), rows)


def _row_mean(rows: NDArray[np.uint8 | np.uint16]) -> FloatArray:
    mean = cv2.reduce(rows, 0, cv2.REDUCE_SUM, dtype=cv2.CV_64F)
    return np.asarray(mean[0] / len(rows), dtype=np.float64)
