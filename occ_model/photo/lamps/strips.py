"""Average the rows of a photo in strips: a lamp's stripes are the same in all its rows."""

from collections.abc import Callable

import cv2
import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.photometry import WHITE
from occ_model.photo.reading.load import Photo

_MOST_STRIPS = 160
_LEAST_ROWS = 8

_FINE, _CELL = 2000, 4
"""Number of columns above which columns are averaged in cells of so many: sensors with many pixels
have colour filters of 2 by 2 or 4 by 4 pixels of one colour, and what is interpolated from them
leaves a pattern that repeats after 4 columns on the steep edges of a lamp."""


def strips_of(photo: Photo, report: Callable[[float], object]) -> tuple[FloatArray, IndexArray]:
    """Average the rows of a photo in strips.

    ``means``: shape (strips, columns), grey levels. ``bounds``: shape (strips + 1,), the first row
    of each strip, and the number of rows.
    """
    rows, columns = photo.samples.shape
    count = int(np.clip(rows // _LEAST_ROWS, 1, _MOST_STRIPS))
    bounds = np.arange(count + 1, dtype=np.int64) * rows // count
    means = np.empty((count, columns))
    for strip in range(count):
        part = photo.samples[bounds[strip] : bounds[strip + 1]]
        sums = cv2.reduce(part, 0, cv2.REDUCE_SUM, dtype=cv2.CV_64F)
        means[strip] = sums[0] * (WHITE / photo.white / len(part))
        report((strip + 1) / count)
    if columns >= _FINE:
        smooth = cv2.blur(means, (_CELL, 1), borderType=cv2.BORDER_REPLICATE)
        means = np.asarray(smooth, dtype=np.float64)
    return means, bounds
