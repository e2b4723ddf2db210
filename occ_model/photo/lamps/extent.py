"""Cut the light scattered around a lamp off its shape: at a lamp's rim its level falls at once."""

import cv2
import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.photo.lamps.timing import LampTiming

_CELL = 8  # columns over which levels are averaged, about as many as a strip has rows
_PADDING = 3  # cells around a shape within which its rim may lie
_LEVELS = np.linspace(0.08, 0.92, 15)  # between the darkest and the brightest cell
_DARK = 10.0  # grey levels added before ratios are formed: lower levels are noise
_MOST_FALL = 0.65  # maximum ratio of levels outside and inside a rim; a halo falls less
_LEAST_AREA = 0.2  # minimum area within the rim relative to the shape; less is a hot spot


def without_halo(
    spans: IndexArray, timing: LampTiming, means: FloatArray, bounds: IndexArray
) -> IndexArray:
    """Leave out of a lamp's shape what lies beyond the steepest fall of its level.

    ``spans``: shape (strips of the lamp, 4), the shape, as of :func:`spans_of`. ``means``: shape
    (strips, columns), grey levels of the photo. ``bounds``: shape (strips + 1,), the first row of
    each strip, and the number of rows.
    """
    strips = np.searchsorted(bounds, spans[:, 0])
    first, last = max(0, int(strips[0]) - _PADDING), int(strips[-1]) + 1 + _PADDING
    margin = _PADDING * _CELL
    left, right = max(0, int(spans[:, 2].min()) - margin), int(spans[:, 3].max()) + margin
    part = means[first:last, left:right]
    cells = -(-part.shape[1] // _CELL)
    filled = _filled(part, timing)
    levels = cv2.resize(filled, (cells, len(part)), interpolation=cv2.INTER_AREA)
    width = part.shape[1] / cells
    least = _LEAST_AREA * float(((spans[:, 3] - spans[:, 2]) / width).sum())
    shape = _within_rim(np.asarray(levels, dtype=np.float64), least)
    if shape is None:
        return spans
    kept = []
    for strip, (top, bottom, begin, end) in zip(strips.tolist(), spans.tolist(), strict=True):
        here = np.flatnonzero(shape[strip - first])
        if here.size:
            near, far = left + here[0] * width, left + (here[-1] + 1) * width
            # Cells are coarse: the edges of stripes are better where they are near.
            begin = begin if near < begin + 2 * width else round(near)
            end = end if far > end - 2 * width else round(far)
            if end > begin:
                kept.append((top, bottom, begin, end))
    found = np.array(kept, dtype=np.int64).reshape(-1, 4)
    return found if _area(found) >= _LEAST_AREA * _area(spans) else spans


def _area(spans: IndexArray) -> int:
    return int(((spans[:, 1] - spans[:, 0]) * (spans[:, 3] - spans[:, 2])).sum())


def _filled(part: FloatArray, timing: LampTiming) -> FloatArray:
    """Fill the dark stripes of a lamp up to the level of the bright ones beside them."""
    place, rises = timing.edges.place, timing.edges.rises
    dark = np.diff(place)[~rises[:-1] & rises[1:]]
    width = int(dark.max(initial=timing.chip) + 2.0) | 1
    line = np.ones((1, width), dtype=np.uint8)
    return np.asarray(
        cv2.morphologyEx(part, cv2.MORPH_CLOSE, line, borderType=cv2.BORDER_REPLICATE)
    )


def _within_rim(levels: FloatArray, least: float) -> np.ndarray | None:
    """Find the place around the brightest cell at whose rim the level falls most, if it falls."""
    top = np.unravel_index(int(levels.argmax()), levels.shape)
    low, high = float(levels.min()), float(levels.max())
    best, found = _MOST_FALL, None
    ring = np.ones((3, 3), dtype=np.uint8)
    for level in low + (high - low) * _LEVELS:
        _, labels = cv2.connectedComponents((levels > level).astype(np.uint8), connectivity=4)
        place = (labels == labels[top]).astype(np.uint8)
        inner = (place > 0) & (cv2.erode(place, ring, borderValue=1) == 0)
        wider = cv2.dilate(place, ring)
        outer = (cv2.dilate(wider, ring) > 0) & (wider == 0)
        if place.sum() < least or not inner.any() or not outer.any():
            continue
        fall = (float(levels[outer].mean()) + _DARK) / (float(levels[inner].mean()) + _DARK)
        if fall < best:
            best, found = fall, place > 0
    return found
