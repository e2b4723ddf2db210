"""Whether the rows of a region show the same stripes, as a rolling shutter makes them."""

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.envelope import without_trend
from occ_model.results.decoding import Region

_BANDS = 8  # number of bands of rows that are compared


def rows_alike(photo: Photo, region: Region) -> float:
    """Return the correlation of a band of rows with the other ones, in the median of the bands.

    Slow changes along the columns are removed: the shape of the lamp differs between the rows. A
    rolling shutter's stripes are the same in all rows but for noise; those of a picture's objects
    are not where they lean, end, or are broken. The result is from -1 to 1, and 1 for one row.
    """
    part = photo.samples[
        region.first_row : region.last_row, region.first_column : region.last_column
    ]
    bands = min(_BANDS, len(part))
    if bands < 2:
        return 1.0
    means = cv2.resize(part, (part.shape[1], bands), interpolation=cv2.INTER_AREA)
    even = np.array([without_trend(band) for band in means.astype(np.float64)])
    return float(np.median([_correlation(even, band) for band in range(bands)]))


def _correlation(even: FloatArray, band: int) -> float:
    others = np.delete(even, band, axis=0).mean(axis=0)
    energy = float(np.sqrt((even[band] ** 2).sum() * (others**2).sum()))
    return float(even[band] @ others) / energy if energy > 0.0 else 0.0
