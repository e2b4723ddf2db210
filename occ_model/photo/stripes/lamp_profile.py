"""The column means of a lamp of whatever shape."""

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.errors import ParameterError
from occ_model.photo.reading.load import Photo
from occ_model.results.lamp import Lamp

_LEAST_STRIPS = 3  # above which the outermost ones, cut by the rim, are left out


def lamp_profile(photo: Photo, lamp: Lamp) -> FloatArray:
    """Average each column of a lamp over the rows in which the lamp covers it.

    A round lamp is thus as bright in its outer columns, which cover few rows, as in its middle.
    """
    region = lamp.region
    rows, columns = photo.samples.shape
    if region.last_row > rows or region.last_column > columns:
        raise ParameterError(
            f"The lamp lies at rows up to {region.last_row - 1} and columns up to "
            f"{region.last_column - 1}; allowed: a lamp of this photo, which has {rows} rows and "
            f"{columns} columns."
        )
    sums, counts = np.zeros(region.columns), np.zeros(region.columns)
    spans = lamp.spans[1:-1] if len(lamp.spans) > _LEAST_STRIPS else lamp.spans
    for chosen in (spans, lamp.spans):
        # Where only the outermost strips cover a column, they count.
        missing = counts == 0
        for first, last, left, right in chosen.tolist():
            part = photo.samples[first:last, left:right]
            here = slice(left - region.first_column, right - region.first_column)
            sum_of_rows = cv2.reduce(part, 0, cv2.REDUCE_SUM, dtype=cv2.CV_64F)[0]
            sums[here] += np.where(missing[here], sum_of_rows, 0.0)
            counts[here] += np.where(missing[here], last - first, 0)
    return np.asarray(sums / np.maximum(counts, 1) * (WHITE / photo.white))
