"""Average pixels of a lamp that are about equally bright into separate profiles.

The mean over pixels of which some are clipped is not the response to any light. In a group of
pixels that the lamp lights equally, each column is either clipped or the response to one light. The
swing of such a profile does not depend on the shape of a round lamp.
"""

from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.photo.reading.load import Photo, means_along
from occ_model.photo.stripes.find import BANDS
from occ_model.results.decoding import Region

_CLIPPED_LEVEL = 0.98  # fraction of white above which a pixel may have been clipped
_LEAST_CLIPPED = 0.002  # clipped fraction above which a profile is divided into groups
_UNCLIPPED = 0.005  # clipped fraction of a column's pixels up to which the column is used
_BLURRED_COLUMNS = 3  # columns next to a clipped one that blur may have darkened
_LEAST_LIGHT = 0.6  # minimum brightness of an unclipped group relative to the brightest
_QUANTILE = 0.75  # quantile of the brightness along a row, whose ends may not show the lamp
_GROUP_LEVELS = (0.2, 0.35, 0.5, 0.65, 0.8)  # limits of the groups if pixels clip, over white
_CLIPPED_GROUPS = 2  # number of groups of pixels that are clipped while the lamp is on

_MOST_GROUPS = 3
_HALF_WEIGHT_ROWS = 16.0
"""Number of rows with half of the information of infinitely many, as errors that are common to all
rows do not average out."""

_LEAST_COLUMNS = 24
_LEAST_CELLS = 0.15  # minimum number of pixels in a column relative to the group's median


@dataclass(frozen=True, eq=False, slots=True)
class EvenProfile:
    """A profile of pixels that the lamp lights about equally."""

    # Mean of the group's pixels in each column, in grey levels, shape (columns of the region,)
    values: FloatArray
    kept: NDArray[np.bool_]  # Whether no pixel of a column is clipped, shape as ``values``
    rows: float

    @property
    def information(self) -> float:
        """Number of columns times the fraction of noise that the rows average out."""
        return float(self.kept.sum()) * self.rows / (self.rows + _HALF_WEIGHT_ROWS)


@dataclass(frozen=True, eq=False, slots=True)
class Cells:
    """A region's pixels, averaged over bands of rows."""

    means: NDArray[np.float32]  # shape (bands, columns); in grey levels
    clipped: NDArray[np.float32]  # shape (bands, columns); fraction of clipped pixels
    rows_a_band: float

    @classmethod
    def of(cls, photo: Photo, region: Region) -> "Cells":
        """Average a region of a photo over bands of rows."""
        part = region.crop(photo.samples)
        starts = np.linspace(0, len(part), min(BANDS, len(part)) + 1).astype(np.int64)
        is_clipped = (part >= _CLIPPED_LEVEL * photo.white).view(np.uint8)
        means, clipped = [], []
        for first, last in pairwise(starts.tolist()):
            means.append(means_along(part[first:last], 0) * (WHITE / photo.white))
            clipped.append(means_along(is_clipped[first:last], 0))
        return cls(
            np.array(means, dtype=np.float32),
            np.array(clipped, dtype=np.float32),
            len(part) / len(means),
        )

    def profiles(self, width: int) -> list[EvenProfile]:
        """Return the profiles of pixels that are lit equally.

        ``width``: number of columns within which the lamp is certainly lit at least once.
        """
        width = max(3, min(width, 2 * self.means.shape[1] - 1)) | 1
        lit = cv2.dilate(self.means, np.ones((1, width), dtype=np.uint8))
        lit = cv2.blur(lit, (width, 1), borderType=cv2.BORDER_REFLECT)
        rows = np.quantile(lit, _QUANTILE, axis=1)
        shows_lamp = lit > _LEAST_LIGHT * rows[:, None]
        if float(self.clipped.mean()) < _LEAST_CLIPPED:
            groups = [rows > _LEAST_LIGHT * rows.max()]
        else:
            groups = self._groups(rows)
        candidates = [self._profile(shows_lamp & group[:, None]) for group in groups]
        profiles = [profile for profile in candidates if profile is not None]
        profiles.sort(key=lambda profile: -profile.information)
        return profiles[:_MOST_GROUPS]

    def _groups(self, rows: FloatArray) -> list[NDArray[np.bool_]]:
        steps = [*(step * WHITE for step in _GROUP_LEVELS), _CLIPPED_LEVEL * WHITE]
        groups = [(low < rows) & (rows <= high) for low, high in pairwise(steps)]
        core = rows > steps[-1]
        if core.any():
            # The brighter a row is, the more of it is clipped.
            fraction = self.clipped.mean(axis=1)
            ranks = np.quantile(fraction[core], np.linspace(0.0, 1.0, _CLIPPED_GROUPS + 1))
            groups += [
                core & (low <= fraction) & (fraction <= high) for low, high in pairwise(ranks)
            ]
        return [group for group in groups if group.any()]

    def _profile(self, group: NDArray[np.bool_]) -> EvenProfile | None:
        count = group.sum(axis=0, dtype=np.float64)
        if not count.any():
            return None
        has_pixels = count >= max(1.0, _LEAST_CELLS * float(np.median(count[count > 0.0])))
        count = np.maximum(count, 1.0)
        values = np.where(group, self.means, 0.0).sum(axis=0, dtype=np.float64) / count
        fraction = np.where(group, self.clipped, 0.0).sum(axis=0, dtype=np.float64) / count
        is_near_clipped = cv2.dilate(
            (fraction > _UNCLIPPED).astype(np.uint8)[None],
            np.ones((1, 2 * _BLURRED_COLUMNS + 1), np.uint8),
        )[0]
        kept = has_pixels & (is_near_clipped == 0)
        if kept.sum() < _LEAST_COLUMNS:
            return None
        rows = self.rows_a_band * float(np.median(count[kept]))
        return EvenProfile(values, kept, rows)
