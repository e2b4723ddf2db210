"""Split the edges of one strip of a photo into those of single lamps.

The edges of a lamp that repeats a pulse form two arithmetic progressions, that of the rising and
that of the falling ones. The edges of a lamp that sends a code lie on two lattices with the length
of a chip. Where one lamp ends and another begins, the progressions or lattices break.
"""

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.chips.edges import coherence
from occ_model.photo.lamps.edges import LampEdges, equal_within, matches

_TOLERANCE = 0.04  # maximum distance of an edge from its place, in periods and, besides, in columns
_COLUMN_TOLERANCE = 0.8  # columns by which pixels and noise may shift an edge
LEAST_EDGES = 4  # minimum number of edges of a lamp: two rising and two falling ones
_LEAST_MORE_EDGES = 4  # edges by which a code must exceed a progression, as a rim adds two
_MOST_GAP_RATIO = 5.0  # ratio to the median distance of edges of a gap between lamps

_LONG_PROGRESSION, _LEAST_EXPLAINED_FRACTION = 6, 0.9
"""Number of edges of a long progression, and fraction of a code's edges above which progressions
explain all of them."""

_LEAST_CODE_EDGES = 7  # minimum number of edges of a code
_MOST_EDGES = 400  # number of edges in a strip above which they are those of a texture

_LEAST_COHERENCE, _COLUMN_COHERENCE = 0.9, 0.5
"""Minimum coherence of edges with the lattice of a code of long chips, and its decrease in columns
per chip: pixels and blur shift the edges of short ones."""

_SHORTEST_CHIP_RATIO, _LONGEST_CHIP_RATIO, _CHIP_LENGTHS = 0.72, 1.4, 200
"""Chip lengths that are tried, relative to the distances of near edges, and their number."""

_MOST_OFF = 0.2  # maximum distance of a code's edge from its lattice in chips
_LONGEST_RUN = 5.5  # longest run of a code in chips; beyond it another lamp begins
_LEAST_STEP_RATIO = 0.4  # minimum ratio of neighbouring steps of one lamp

_MOST_DISTANCE = 2  # maximum distance of a lamp's segments in strips: noise may hide one

LEAST_EQUAL_FRACTION, _LEAST_EQUAL = 0.65, 3
"""Minimum fraction and number of equal edges of two segments: in a strip, noise or a rim can join
the edges of two lamps, and such a segment must not join the lamps."""

LEAST_STRIPS = 2  # minimum number of strips of a lamp: in one, noise makes edges equal
LEAST_EDGES_OF_STRIP = 12  # from which even a single strip shows a lamp

_LEAST_STRIP_FRACTION = 0.2  # minimum fraction of a group's strips that show an edge


@dataclass(frozen=True, eq=False, slots=True)
class Segment:
    """Edges of one lamp in one strip."""

    strip: int
    edges: LampEdges  # the edges, without those of the lamp's rim
    period: float | None  # columns of a cycle of a pulse that repeats; None for a code
    chip: float  # columns of a chip; half a period where a pulse repeats


def segments_of(
    edges: LampEdges, strip: int, tolerance: float = 1.0, codes: bool = True
) -> list[Segment]:
    """Split the edges of a strip into those of single lamps."""
    found: list[Segment] = []
    # What is left of a strip is searched again, mostly at the same edges.
    chip_within = cache(lambda first, last: chip_of(edges.part(first, last)))
    waiting = [(0, len(edges), progressions_of(edges.place, tolerance))]
    while waiting:
        first, last, progressions = waiting.pop()
        longest = max(progressions, key=lambda one: one[1] - one[0], default=(first, first, 0.0))
        begin, end, period = longest
        coded = _code_within(edges, first, last, chip_within) if codes else None
        if (
            coded is not None
            and coded[1] - coded[0] >= end - begin + _LEAST_MORE_EDGES
            and not _are_pulses(progressions, *coded[:2])
        ):
            begin, end, chip = coded
            part = edges.part(begin, end)
            found.append(_segment(strip, part, chip))
        elif period:
            found.append(Segment(strip, edges.part(begin, end), period, 0.5 * period))
        else:
            continue
        for left, right in ((first, begin), (end, last)):
            if right - left >= LEAST_EDGES:
                waiting.append((left, right, clip_spans(progressions, left, right)))
    return found


def _segment(strip: int, edges: LampEdges, chip: float) -> Segment:
    """Describe edges on a lattice: a chip is the longest length that divides all distances.

    If all edges of a kind are equally far apart, they are those of a repeated pulse.
    """
    apart = [np.diff(edges.place[edges.rises == kind]) / chip for kind in (True, False)]
    turns = np.rint(np.concatenate(apart)).astype(np.int64)
    longest = max(int(np.gcd.reduce(turns)), 1) * chip
    if (turns * chip == longest).all():
        return Segment(strip, edges, longest, 0.5 * longest)
    return Segment(strip, edges, None, longest)


def _are_pulses(progressions: list[tuple[int, int, float]], first: int, last: int) -> bool:
    """Whether long progressions explain nearly all edges: those of lamps of similar periods."""
    inside = clip_spans(progressions, first, last)
    long = sum(end - begin for begin, end, _ in inside if end - begin >= _LONG_PROGRESSION)
    return long >= _LEAST_EXPLAINED_FRACTION * (last - first)


def clip_spans(
    progressions: list[tuple[int, int, float]], first: int, last: int
) -> list[tuple[int, int, float]]:
    """Clip progressions to the edges from ``first`` on and before ``last``."""
    parts = [(max(a, first), min(b, last), period) for a, b, period in progressions]
    return [part for part in parts if part[1] - part[0] >= LEAST_EDGES]


def progressions_of(place: FloatArray, tolerance: float) -> list[tuple[int, int, float]]:
    """Find runs of edges of which every second is a period farther: first edge, end, period."""
    apart = (place[2:] - place[:-2]).tolist()
    found = []
    begin = 0
    while begin < len(apart) - 1:
        total, end = apart[begin], begin + 1
        while end < len(apart):
            period = total / (end - begin)
            if abs(apart[end] - period) > tolerance * (_TOLERANCE * period + _COLUMN_TOLERANCE):
                break
            total += apart[end]
            end += 1
        if end - begin > 1:
            found.append((begin, end + 2, total / (end - begin)))
        begin = max(begin + 1, end - 2)
    return found


def _code_within(
    edges: LampEdges, first: int, last: int, chip_within: Callable[[int, int], float | None]
) -> tuple[int, int, float] | None:
    """Find the longest stretch of edges that lie on a lattice, with the columns of a chip."""
    if not _LEAST_CODE_EDGES <= last - first <= _MOST_EDGES:
        return None
    best: tuple[int, int, float] | None = None
    for begin, end in _stretches(edges.part(first, last)):
        part = first + begin, first + end
        chip = chip_within(*part)
        if chip is not None:
            part = _drop_strangers(edges, *part, chip)
            if best is None or part[1] - part[0] > best[1] - best[0]:
                best = (*part, chip)
    return best


def _drop_strangers(edges: LampEdges, first: int, last: int, chip: float) -> tuple[int, int]:
    """Leave out outer edges that lie far away, or off the lattice of chips."""
    turns = np.exp(2j * np.pi * edges.place[first:last] / chip)
    off = np.zeros(last - first)
    for which in (edges.rises[first:last], ~edges.rises[first:last]):
        off[which] = np.abs(np.angle(turns[which] * np.conj(turns[which].sum())))
    gaps = np.diff(edges.place[first:last])
    wrong = off > 2.0 * np.pi * _MOST_OFF
    begin, end = 0, last - first
    while end - begin > LEAST_EDGES and (wrong[begin] or gaps[begin] > _LONGEST_RUN * chip):
        begin += 1
    while end - begin > LEAST_EDGES and (wrong[end - 1] or gaps[end - 2] > _LONGEST_RUN * chip):
        end -= 1
    return first + begin, first + end


def _stretches(edges: LampEdges) -> list[tuple[int, int]]:
    """Split edges at wide gaps, and where steps become much smaller or larger."""
    gaps, swings = np.diff(edges.place), edges.swing
    ratio = np.minimum(swings[1:], swings[:-1]) / np.maximum(swings[1:], swings[:-1])
    cuts = (
        np.flatnonzero((gaps > _MOST_GAP_RATIO * np.median(gaps)) | (ratio < _LEAST_STEP_RATIO)) + 1
    )
    return list(itertools.pairwise([0, *cuts.tolist(), len(edges)]))


def chip_of(edges: LampEdges) -> float | None:
    """Find the columns of a chip of which all distances between edges are multiples.

    Rising and falling edges have a lattice each: a camera's tone curve and saturation shift them
    oppositely. The outermost edges may be those of the lamp's rim.
    """
    if len(edges) < _LEAST_CODE_EDGES:
        return None
    near, usual = np.quantile(np.diff(edges.place[1:-1]), [0.1, 0.25]).tolist()
    chips = np.geomspace(_SHORTEST_CHIP_RATIO * near, _LONGEST_CHIP_RATIO * usual, _CHIP_LENGTHS)
    coherent = coherence(edges.part(1, len(edges) - 1), 1.0 / chips)
    best = int(np.argmax(coherent))
    chip = float(chips[best])
    return chip if coherent[best] >= _LEAST_COHERENCE - _COLUMN_COHERENCE / chip else None


def groups_of(segments: Sequence[Segment]) -> list[list[Segment]]:
    """Group the segments of each lamp; they are in the order of their strips.

    A group of a single strip is texture or a border, unless it has many edges.
    """
    labels = list(range(len(segments)))

    def group(index: int) -> int:
        while labels[index] != index:
            index = labels[index]
        return index

    for index, segment in enumerate(segments):
        for other in range(index - 1, -1, -1):
            apart = segment.strip - segments[other].strip
            if apart > _MOST_DISTANCE:
                break
            if apart and _agree(segment, segments[other]):
                labels[group(other)] = group(index)
    groups: dict[int, list[Segment]] = {}
    for index, segment in enumerate(segments):
        groups.setdefault(group(index), []).append(segment)
    return [one for one in groups.values() if _are_many(one)]


def _are_many(group: Sequence[Segment]) -> bool:
    most = max(len(one.edges) for one in group)
    return most >= LEAST_EDGES_OF_STRIP or len({one.strip for one in group}) >= LEAST_STRIPS


def _agree(one: Segment, other: Segment) -> bool:
    """Whether most edges of two segments are equal; of pulses, only in the columns of both."""
    chip = min(one.chip, other.chip)
    off = equal_within(chip)
    first = max(one.edges.place[0], other.edges.place[0]) - off
    last = min(one.edges.place[-1], other.edges.place[-1]) + off
    if last < first:
        return False
    here, there = one.edges, other.edges
    if one.period is not None and other.period is not None:
        here, there = (
            each.where((each.place >= first) & (each.place <= last)) for each in (here, there)
        )
    most = max(len(here), len(there))
    if min(len(here), len(there)) < LEAST_EQUAL_FRACTION * most:
        return False
    near = np.count_nonzero(matches(here, there, chip))
    return bool(near >= max(_LEAST_EQUAL, LEAST_EQUAL_FRACTION * most))


def common_edges(group: Sequence[Segment]) -> tuple[LampEdges, np.ndarray]:
    """Return the edges common to several segments of a group, and the number of segments of each.

    The rim of a round lamp lies at other columns in each strip, and so is not among them.
    """
    off = equal_within(float(np.median([one.chip for one in group])))
    every = LampEdges.join([one.edges for one in group])
    rows: list[tuple[float, bool, float, float, int]] = []
    strips = len({one.strip for one in group})
    least = max(min(LEAST_STRIPS, strips), _LEAST_STRIP_FRACTION * len(group))
    for kind in (True, False):
        kept = every.where(every.rises == kind)
        ends = np.flatnonzero(np.diff(kept.place) > off) + 1
        for first, last in itertools.pairwise([0, *ends.tolist(), len(kept)]):
            if last - first >= least:
                same = kept.part(first, last)
                place, low, high = (
                    float(np.median(each)) for each in (same.place, same.low, same.high)
                )
                rows.append((place, kind, low, high, last - first))
    rows.sort()
    columns = [np.array(column) for column in zip(*rows, strict=True)] or [np.zeros(0)] * 5
    return LampEdges(columns[0], columns[1].astype(bool), columns[2], columns[3]), columns[4]
