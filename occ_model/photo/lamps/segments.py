"""Split the edges of one strip of a photo into those of single lamps.

The edges of a lamp that repeats a pulse form two arithmetic progressions, that of the rising and
that of the falling ones. The edges of a lamp that sends a code lie on two lattices with the length
of a chip. Where one lamp ends and another begins, the progressions or lattices break.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.lamps.edges import Edges

_TOLERANCE = 0.04
"""Share of a period by which an edge may lie off its place, besides that of a column."""

_COLUMN = 0.8
"""Columns by which an edge may lie off its place: pixels and noise."""

_LEAST_EDGES = 4
"""Fewest edges of a lamp: two rising and two falling ones."""

_RIM_EDGES = 3
"""Edges by which a code must explain more than a progression does: a lamp's rim has two of them."""

_WIDE = 5.0
"""Ratio to the median distance of edges from which a gap lies between two lamps."""

_CODE_EDGES = 7
"""Fewest edges from which the length of a chip is told."""

_ON_LATTICE = 0.9
"""Coherence of edges with a lattice of chips from which they are those of one code."""

_CHIPS = np.geomspace(0.72, 1.4, 160)
"""Lengths of a chip that are tried, as a ratio to the shortest distance of two edges."""

_OFF_LATTICE = 0.2
"""Share of a chip by which a code's edge may lie off its lattice."""

_LONGEST_RUN = 5.5
"""Chips of the longest run within a code; beyond it another lamp begins."""

_UNLIKE = 0.4
"""Ratio of neighbouring steps' sizes from which they are those of two lamps."""


@dataclass(frozen=True, eq=False, slots=True)
class Segment:
    """Edges of one lamp in one strip.

    Parameters
    ----------
    strip
        The number of the strip.
    edges
        The edges, without those of the lamp's rim.
    period
        Columns of a cycle of a pulse that repeats; None for a code.
    chip
        Columns of a chip; half a period where a pulse repeats.
    """

    strip: int
    edges: Edges
    period: float | None
    chip: float


def segments_of(
    edges: Edges, strip: int, tolerance: float = 1.0, codes: bool = True
) -> list[Segment]:
    """Split the edges of a strip into those of single lamps.

    Parameters
    ----------
    edges
        The edges.
    strip
        The number of the strip.
    tolerance
        Factor of the distance by which edges may lie off their place.
    codes
        Whether some may be those of a code.
    """
    found: list[Segment] = []
    _split(_Rules(edges, strip, tolerance, codes), 0, len(edges), found)
    return sorted(found, key=lambda one: float(one.edges.place[0]))


@dataclass(frozen=True, eq=False, slots=True)
class _Rules:
    """The edges of a strip, and how they are judged."""

    edges: Edges
    strip: int
    tolerance: float
    codes: bool


def _split(rules: _Rules, first: int, last: int, found: list[Segment]) -> None:
    """Take out the longest progression, or a code, and go on to both its sides."""
    edges = rules.edges
    if last - first < _LEAST_EDGES:
        return
    begin, end, period = _longest_progression(edges.place, first, last, rules.tolerance)
    coded = _code_around(edges, first, last) if rules.codes else None
    if coded is not None and coded[1] - coded[0] >= end - begin + _RIM_EDGES:
        begin, end, chip = coded
        period = None
    elif period is not None:
        chip = 0.5 * period
    else:
        return
    found.append(Segment(rules.strip, edges.part(begin, end), period, chip))
    _split(rules, first, begin, found)
    _split(rules, end, last, found)


def _longest_progression(
    place: FloatArray, first: int, last: int, tolerance: float
) -> tuple[int, int, float | None]:
    """Find the most neighbouring edges whose every second one is a period farther."""
    apart = (place[first + 2 : last] - place[first : last - 2]).tolist()
    best = (first, first, None)
    begin = 0
    while begin < len(apart) - 1:
        period, end = apart[begin], begin + 1
        while end < len(apart) and abs(apart[end] - period) <= tolerance * (
            _TOLERANCE * period + _COLUMN
        ):
            end += 1
            period = sum(apart[begin:end]) / (end - begin)
        if end - begin > 1 and end - begin + 2 > best[1] - best[0]:
            best = (first + begin, first + end + 2, period)
        begin = max(begin + 1, end - 2)
    return best


def _code_around(edges: Edges, first: int, last: int) -> tuple[int, int, float] | None:
    """Find the longest stretch of edges without a wide gap that lie on a lattice of chips."""
    best: tuple[int, int, float] | None = None
    for begin, end in _stretches(edges, first, last):
        chip = chip_of(edges.part(begin, end))
        if chip is None:
            continue
        begin, end = _without_strangers(edges, begin, end, chip)
        if best is None or end - begin > best[1] - best[0]:
            best = begin, end, chip
    return best


def _without_strangers(edges: Edges, first: int, last: int, chip: float) -> tuple[int, int]:
    """Leave out outer edges that lie far away, or off the lattice of chips."""
    turns = np.exp(2j * np.pi * edges.place[first:last] / chip)
    off = np.zeros(last - first)
    for which in (edges.rises[first:last], ~edges.rises[first:last]):
        off[which] = np.abs(
            np.angle(
                turns[which] / max(abs(turns[which].sum()), 1e-9) * np.conj(turns[which].sum())
            )
        )
    gaps = np.diff(edges.place[first:last])
    wrong = off > 2.0 * np.pi * _OFF_LATTICE
    begin, end = 0, last - first
    while end - begin > _LEAST_EDGES and (wrong[begin] or gaps[begin] > _LONGEST_RUN * chip):
        begin += 1
    while end - begin > _LEAST_EDGES and (wrong[end - 1] or gaps[end - 2] > _LONGEST_RUN * chip):
        end -= 1
    return first + begin, first + end


def _stretches(edges: Edges, first: int, last: int) -> list[tuple[int, int]]:
    """Split edges at wide gaps, and where steps become much smaller or larger."""
    gaps = np.diff(edges.place[first:last])
    swings = (edges.high - edges.low)[first:last]
    ratio = np.minimum(swings[1:], swings[:-1]) / np.maximum(swings[1:], swings[:-1])
    cuts = np.flatnonzero((gaps > _WIDE * np.median(gaps)) | (ratio < _UNLIKE)) + 1
    ends = [0, *cuts.tolist(), last - first]
    return [(first + a, first + b) for a, b in zip(ends, ends[1:], strict=False)]


def chip_of(edges: Edges) -> float | None:
    """Find the columns of a chip of which all distances between edges are multiples.

    Rising and falling edges have a lattice each: a camera's tone curve and saturation shift them
    oppositely. The outermost edges may be those of the lamp's rim.
    """
    if len(edges) < _CODE_EDGES:
        return None
    chips = float(np.quantile(np.diff(edges.place[1:-1]), 0.25)) * _CHIPS
    coherence = coherence_of(edges.part(1, len(edges) - 1), chips)
    best = int(np.argmax(coherence))
    return float(chips[best]) if coherence[best] >= _ON_LATTICE else None


def coherence_of(edges: Edges, chips: FloatArray) -> FloatArray:
    """Give how well edges lie on the lattices of some lengths of a chip, from 0 to 1."""
    turns = np.exp(2j * np.pi * edges.place[None, :] / chips[:, None])
    sums = sum(np.abs(turns[:, one].sum(axis=1)) for one in (edges.rises, ~edges.rises))
    return np.asarray(sums / len(edges))
