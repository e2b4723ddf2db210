"""Average the rows of a photo in strips, and find what is bright in them and has no stripes."""

from collections.abc import Callable, Sequence

import cv2
import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.photometry import WHITE
from occ_model.photo.lamps.shape import region_around
from occ_model.photo.reading.load import Photo, column_means
from occ_model.results.lamp import Lamp

_MOST_STRIPS = 480
_ROWS, _LEAST_ROWS, _FEW_STRIPS = 8, 4, 32
"""Rows of a strip, and the least number of them in small photos, to make up to ``_FEW_STRIPS``
strips: a bar of light has at least two."""

_FINE_COLUMNS, _CELL_COLUMNS = 2000, 4
"""Number of columns above which columns are averaged in cells of so many: sensors with many pixels
have colour filters of 2 by 2 or 4 by 4 pixels of one colour, and what is interpolated from them
leaves a pattern that repeats after 4 columns on the steep edges of a lamp."""

_BRIGHT_FRACTION = 0.6  # fraction of white above which a place is bright
_BRIGHT_RATIO = 1.6  # ratio to the picture's median above which a place is bright
_LEAST_AREA = 3e-4  # minimum area of a lamp relative to the picture
_MOST_COLUMNS = 512  # to which a picture is reduced, as steady lamps have no fine stripes


def strips_of(photo: Photo, report: Callable[[float], object]) -> tuple[FloatArray, IndexArray]:
    """Average the rows of a photo in strips.

    ``means``: shape (strips, columns), grey levels. ``bounds``: shape (strips + 1,), the first row
    of each strip, and the number of rows.
    """
    rows, columns = photo.samples.shape
    count = max(rows // _ROWS, min(rows // _LEAST_ROWS, _FEW_STRIPS), 1)
    count = min(count, _MOST_STRIPS)
    bounds = np.arange(count + 1, dtype=np.int64) * rows // count
    means = np.empty((count, columns))
    for strip in range(count):
        means[strip] = column_means(photo, int(bounds[strip]), int(bounds[strip + 1]))
        report((strip + 1) / count)
    if columns >= _FINE_COLUMNS:
        smooth = cv2.blur(means, (_CELL_COLUMNS, 1), borderType=cv2.BORDER_REPLICATE)
        means = np.asarray(smooth, dtype=np.float64)
    return means, bounds


def steady_lamps(means: FloatArray, bounds: IndexArray, blinking: Sequence[Lamp]) -> list[Lamp]:
    """Find the bright places without stripes; the strips are those of :func:`strips_of`."""
    strips, columns = means.shape
    narrow = min(columns, _MOST_COLUMNS)
    levels = cv2.resize(means, (narrow, strips), interpolation=cv2.INTER_AREA)
    least = max(
        _BRIGHT_FRACTION * WHITE, min(_BRIGHT_RATIO * float(np.median(levels)), 0.98 * WHITE)
    )
    taken = np.zeros((strips, narrow), dtype=bool)
    for lamp in blinking:
        for first, last, left, right in lamp.spans.tolist():
            rows = slice(*np.searchsorted(bounds, [first, last]).tolist())
            taken[rows, max(left * narrow // columns - 2, 0) : right * narrow // columns + 3] = True
    bright = (levels >= least).astype(np.uint8)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(bright, connectivity=4)
    found = []
    for label in range(1, count):
        place = labels == label
        area = int(stats[label, cv2.CC_STAT_AREA])
        is_blinking = 2 * np.count_nonzero(taken[place]) > area  # most of it
        if area < _LEAST_AREA * labels.size or is_blinking:
            continue
        spans = _spans(place, bounds, columns / narrow)
        level = float(np.median(levels[place]))
        found.append(Lamp(region_around(spans), spans, level, modulated=False))
    return found


def _spans(place: np.ndarray, bounds: IndexArray, scale: float) -> IndexArray:
    rows = []
    for strip in np.flatnonzero(place.any(axis=1)).tolist():
        here = np.flatnonzero(place[strip])
        first, last = int(here[0] * scale), int(np.ceil((here[-1] + 1) * scale))
        rows.append((int(bounds[strip]), int(bounds[strip + 1]), first, last))
    return np.array(rows, dtype=np.int64)
