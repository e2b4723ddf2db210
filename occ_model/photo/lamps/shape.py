"""The shape of a lamp: the columns that it fills in each strip."""

from collections.abc import Sequence

import numpy as np

from occ_model.arrays import IndexArray
from occ_model.photo.lamps.edges import LampEdges, matches
from occ_model.photo.lamps.timing import LampTiming
from occ_model.results.decoding import Region

_LEAST_SWING = 0.4  # minimum swing over the lamp's, or an edge's; less is scattered light
_LEAST_OWN_FRACTION = 0.7  # minimum fraction of a lamp's own edges between its outermost ones
_CUT_TOLERANCE = 0.3  # maximum distance in chips of an edge whose stripe the rim cuts
_MOST_WIDTH = 1.15  # maximum width of a stripe that the rim cuts, relative to a whole one
_SMOOTHING_STRIPS = 2  # strips on either side over which the median of a rim is taken


def spans_of(
    strips: Sequence[LampEdges], inner: Sequence[int], timing: LampTiming, least: float,
    bounds: IndexArray, columns: int,
) -> IndexArray:  # fmt: skip
    """Find the columns of a lamp in each strip that shows its edges, ``least`` grey levels high.

    Shape (strips of the lamp, 4), first row, row after the last, first column and column after the
    last.
    """
    spans: dict[int, tuple[float, float]] = {}
    first, last = min(inner), max(inner)
    for strip in range(first, last + 1):
        span = _span(strips[strip], timing, least, columns)
        if span is not None:
            spans[strip] = span
    for outward, begin in ((-1, first - 1), (1, last + 1)):
        strip = begin
        # A round lamp's topmost strips show too few stripes to be found by themselves.
        while (
            0 <= strip < len(strips)
            and (span := _span(strips[strip], timing, least, columns)) is not None
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


def _span(
    edges: LampEdges, timing: LampTiming, least: float, columns: int
) -> tuple[float, float] | None:
    """Return the first and the last column of a lamp in one strip; None if it is not seen there."""
    shared = np.flatnonzero(matches(edges, timing.edges, timing.chip) & (edges.swing > least))
    if len(shared) < 2 or edges.rises[shared].all() or not edges.rises[shared].any():
        return None
    begin, end = int(shared[0]), int(shared[-1])
    if len(shared) < _LEAST_OWN_FRACTION * np.count_nonzero(edges.swing[begin : end + 1] > least):
        return None
    begin, end = (_outermost(edges, at, side, timing) for at, side in ((begin, -1), (end, 1)))
    first, last = float(edges.place[begin]), float(edges.place[end])
    stripe = _MOST_WIDTH * timing.longest_stripe
    if begin == 0 and not edges.rises[begin] and first < stripe:
        first = 0.0  # the border of the picture cuts the stripe
    if end + 1 == len(edges) and edges.rises[end] and columns - last < stripe:
        last = columns - 1.0
    return first, last


def _outermost(edges: LampEdges, at: int, side: int, timing: LampTiming) -> int:
    """Return the outermost edge on a side, from one on.

    The lamp's rim cuts its outer stripes, and so shifts their edges off the lattice.
    """
    off = timing.off_lattice(edges) * timing.spacing
    while 0 <= (beside := at + side) < len(edges):
        apart = abs(edges.place[beside] - edges.place[at])
        ends_stripe = edges.rises[beside] == (side < 0)
        if ends_stripe:
            is_own = apart < _MOST_WIDTH * timing.longest_stripe
        else:
            is_own = apart < 1.5 * timing.spacing and off[beside] < _CUT_TOLERANCE * timing.chip
            is_own &= not timing.is_code
        if not is_own or edges.swing[beside] < _LEAST_SWING * edges.swing[at]:
            break
        at = beside
        if ends_stripe:
            break
    return at


def region_around(spans: IndexArray) -> Region:
    """Return the smallest rectangle that holds all spans of a lamp."""
    return Region(
        int(spans[:, 0].min()), int(spans[:, 1].max()),
        int(spans[:, 2].min()), int(spans[:, 3].max()),
    )  # fmt: skip
