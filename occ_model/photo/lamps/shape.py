"""The shape of a lamp: the columns that it fills in each strip."""

from collections.abc import Sequence

import numpy as np

from occ_model.arrays import IndexArray
from occ_model.photo.lamps.edges import Edges, matches
from occ_model.photo.lamps.timing import LampTiming
from occ_model.results.decoding import Region

_LEAST_SWING = 0.4  # minimum swing over the lamp's, or an edge's; less is scattered light
_LEAST_OWN_FRACTION = 0.7  # of the edges between a lamp's outermost ones that are its own
_CUT_TOLERANCE = 0.3  # maximum distance in chips of an edge whose stripe the rim cuts
_MOST_WIDTH = 1.15  # maximum width of a stripe that the rim cuts, relative to a whole one
_SMOOTHING_STRIPS = 2  # strips on either side over which the median of a rim is taken


def spans_of(
    strips: Sequence[Edges], inner: Sequence[int], timing: LampTiming, least: float,
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
    edges: Edges, timing: LampTiming, least: float, columns: int
) -> tuple[float, float] | None:
    """Return the first and the last column of a lamp in one strip; None if it is not seen there."""
    swing = edges.high - edges.low
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
