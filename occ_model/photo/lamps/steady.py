"""Find what is bright and has no stripes: lamps of constant light, windows, screens."""

from collections.abc import Sequence

import cv2
import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.photometry import WHITE
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp

_BRIGHT = 0.6  # fraction of white above which a place is bright
_ABOVE_MEDIAN = 1.6  # ratio to the picture's median above which a place is bright
_LEAST_AREA = 3e-4  # minimum area of a lamp relative to the picture
_MOST_COLUMNS = 512  # to which a picture is reduced: there are no fine stripes


def steady_lamps(means: FloatArray, bounds: IndexArray, blinking: Sequence[Lamp]) -> list[Lamp]:
    """Find the bright places without stripes in strips of a photo, as of :func:`strips_of`."""
    strips, columns = means.shape
    narrow = min(columns, _MOST_COLUMNS)
    levels = cv2.resize(means, (narrow, strips), interpolation=cv2.INTER_AREA)
    least = max(_BRIGHT * WHITE, min(_ABOVE_MEDIAN * float(np.median(levels)), 0.98 * WHITE))
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
        region = Region(
            int(spans[0, 0]), int(spans[-1, 1]), int(spans[:, 2].min()), int(spans[:, 3].max())
        )
        found.append(Lamp(region, spans, float(np.median(levels[place])), modulated=False))
    return found


def _spans(place: np.ndarray, bounds: IndexArray, scale: float) -> IndexArray:
    rows = []
    for strip in np.flatnonzero(place.any(axis=1)).tolist():
        here = np.flatnonzero(place[strip])
        first, last = int(here[0] * scale), int(np.ceil((here[-1] + 1) * scale))
        rows.append((int(bounds[strip]), int(bounds[strip + 1]), first, last))
    return np.array(rows, dtype=np.int64)
