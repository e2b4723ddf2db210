"""The shape of a lamp: the columns that it fills in each strip, without the light around it."""

from collections.abc import Sequence

import cv2
import numpy as np

from occ_model.arrays import FloatArray, IndexArray, Pixels
from occ_model.photo.lamps.edges import Edges, matches
from occ_model.photo.lamps.timing import LampTiming
from occ_model.results.decoding import Region

_LEAST_SWING = 0.4  # minimum swing over the lamp's, or an edge's; less is scattered light
_LEAST_OWN_FRACTION = 0.7  # of the edges between a lamp's outermost ones that are its own
_CUT_TOLERANCE = 0.3  # maximum distance in chips of an edge whose stripe the rim cuts
_MOST_WIDTH = 1.15  # maximum width of a stripe that the rim cuts, relative to a whole one
_SMOOTHING_STRIPS = 2  # strips on either side over which the median of a rim is taken

_CELL = 8  # columns over which levels are averaged, about as many as a strip has rows
_PADDING = 3  # cells around a shape within which its rim may lie
_LEVELS = np.linspace(0.08, 0.92, 15)  # between the darkest and the brightest cell
_ADDED_LEVEL = 10.0  # grey levels added before ratios are formed: lower levels are noise
_MOST_LEVEL_RATIO = 0.65  # maximum ratio of levels outside and inside a rim; a halo falls less
_LEAST_AREA = 0.2  # minimum area within the rim relative to the shape; less is a hot spot


def spans_of(
    strips: Sequence[Edges], inner: Sequence[int], timing: LampTiming, bounds: IndexArray,
    columns: int,
) -> IndexArray:  # fmt: skip
    """Find the columns of a lamp in each strip that shows its edges.

    Shape (strips of the lamp, 4), first row, row after the last, first column and column after the
    last.
    """
    spans: dict[int, tuple[float, float]] = {}
    first, last = min(inner), max(inner)
    for strip in range(first, last + 1):
        span = _span(strips[strip], timing, columns)
        if span is not None:
            spans[strip] = span
    for outward, begin in ((-1, first - 1), (1, last + 1)):
        strip = begin
        # A round lamp's topmost strips show too few stripes to be found by themselves.
        while (
            0 <= strip < len(strips) and (span := _span(strips[strip], timing, columns)) is not None
        ):
            spans[strip] = span
            strip += outward
    return rectangles(spans, bounds, columns)


def rectangles(
    spans: dict[int, tuple[float, float]], bounds: IndexArray, columns: int
) -> IndexArray:
    """Smooth the columns over neighbouring strips, and write them as rectangles."""
    if not spans:
        return np.zeros((0, 4), dtype=np.int64)
    shown = np.arange(min(spans), max(spans) + 1)
    known = np.array(sorted(spans))
    sides = np.array([spans[strip] for strip in known.tolist()])
    apart = np.abs(shown[:, None] - known)
    near = apart <= np.maximum(_SMOOTHING_STRIPS, apart.min(axis=1, keepdims=True))
    smooth = np.array([np.median(sides[beside], axis=0) for beside in near])
    left = np.maximum(np.floor(smooth[:, 0]), 0).astype(np.int64)
    right = np.minimum(np.ceil(smooth[:, 1]) + 1, columns).astype(np.int64)
    return np.column_stack([bounds[shown], bounds[shown + 1], left, np.maximum(right, left + 1)])


def _span(edges: Edges, timing: LampTiming, columns: int) -> tuple[float, float] | None:
    """Return the first and the last column of a lamp in one strip; None if it is not seen there."""
    swing = edges.high - edges.low
    least = _LEAST_SWING * float(np.median(timing.edges.high - timing.edges.low))
    shared = np.flatnonzero(matches(edges, timing.edges, timing.chip) & (swing > least))
    if len(shared) < 2 or edges.rises[shared].all() or not edges.rises[shared].any():
        return None
    begin, end = int(shared[0]), int(shared[-1])
    if len(shared) < _LEAST_OWN_FRACTION * np.count_nonzero(swing[begin : end + 1] > least):
        return None
    begin, end = _with_cut_stripes(edges, begin, end, timing)
    first, last = float(edges.place[begin]), float(edges.place[end])
    stripe = _MOST_WIDTH * timing.longest_stripe
    if begin == 0 and not edges.rises[begin] and first < stripe:
        first = 0.0  # the border of the picture cuts the stripe
    elif begin > 0 and _is_rim(edges, begin - 1, begin, stripe):
        first = float(edges.place[begin - 1])
    if end + 1 == len(edges) and edges.rises[end] and columns - last < stripe:
        last = columns - 1.0
    elif end + 1 < len(edges) and _is_rim(edges, end + 1, end, stripe):
        last = float(edges.place[end + 1])
    return first, last


def _with_cut_stripes(edges: Edges, begin: int, end: int, timing: LampTiming) -> tuple[int, int]:
    """Add the inner edges of the outermost stripes, which the rim shifts because it cuts them."""
    swing = edges.high - edges.low

    def is_own(at: int, beside: int) -> bool:
        if not 0 <= at < len(edges) or swing[at] < _LEAST_SWING * swing[beside]:
            return False
        outward = edges.rises[at] == (at > beside)  # a bright stripe lies beyond it
        start = timing.rise if edges.rises[at] else timing.fall
        turns = (float(edges.place[at]) - start) / timing.spacing
        near = abs(edges.place[at] - edges.place[beside]) < 1.5 * timing.spacing
        off = abs(turns - round(turns)) * timing.spacing
        return bool(outward and near and off < _CUT_TOLERANCE * timing.chip)

    if timing.is_code:
        return begin, end
    return begin - is_own(begin - 1, begin), end + is_own(end + 1, end)


def _is_rim(edges: Edges, at: int, beside: int, stripe: float) -> bool:
    """Whether an edge beside a lamp's is that of a bright stripe which the lamp's rim cuts."""
    swing = edges.high - edges.low
    near = abs(edges.place[at] - edges.place[beside]) < stripe
    return bool(
        near and edges.rises[at] == (at < beside) and swing[at] > _LEAST_SWING * swing[beside]
    )


def around(spans: IndexArray) -> Region:
    return Region(
        int(spans[:, 0].min()), int(spans[:, 1].max()),
        int(spans[:, 2].min()), int(spans[:, 3].max()),
    )  # fmt: skip


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
    part = means[first:last, left:right].astype(np.float32)
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


def _filled(part: Pixels, timing: LampTiming) -> Pixels:
    """Fill the dark stripes of a lamp up to the level of the bright ones beside them."""
    place, rises = timing.edges.place, timing.edges.rises
    dark = np.diff(place)[~rises[:-1] & rises[1:]]
    width = int(dark.max(initial=timing.chip) + 2.0) | 1
    line = np.ones((1, width), dtype=np.uint8)
    return np.asarray(
        cv2.morphologyEx(part, cv2.MORPH_CLOSE, line, borderType=cv2.BORDER_REPLICATE), np.float32
    )


def _within_rim(levels: FloatArray, least: float) -> np.ndarray | None:
    """Find the place around the brightest cell at whose rim the level falls most, if it falls."""
    top = np.unravel_index(int(levels.argmax()), levels.shape)
    low, high = float(levels.min()), float(levels.max())
    best, found = _MOST_LEVEL_RATIO, None
    ring = np.ones((3, 3), dtype=np.uint8)
    for level in low + (high - low) * _LEVELS:
        _, labels = cv2.connectedComponents((levels > level).astype(np.uint8), connectivity=4)
        place = (labels == labels[top]).astype(np.uint8)
        inner = (place > 0) & (cv2.erode(place, ring, borderValue=1) == 0)
        wider = cv2.dilate(place, ring)
        outer = (cv2.dilate(wider, ring) > 0) & (wider == 0)
        if place.sum() < least or not inner.any() or not outer.any():
            continue
        fall = (float(levels[outer].mean()) + _ADDED_LEVEL) / (
            float(levels[inner].mean()) + _ADDED_LEVEL
        )
        if fall < best:
            best, found = fall, place > 0
    return found
