"""Read the chips from stripes of which only the period is known.

For each number of chips the best ones follow from the harmonics of the period; the smallest number
whose chips explain the stripes is taken.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.chips.edges import (
    LEAST_COHERENCE_RATIO,
    LEAST_COLUMNS,
    Edges,
    coherence,
    edges_of,
)
from occ_model.photo.fit.chip_runs import canonical
from occ_model.photo.fit.chips_of_harmonics import (
    ReadPattern,
    best_chips,
    chips_by_descent,
    harmonics_of,
    refine_timing,
)
from occ_model.photo.stripes.envelope import remove_trend
from occ_model.photo.stripes.period import Harmonics

MOST_CHIPS = 128  # maximum number of chips in a period

_LEAST_COHERENCE = 0.6  # minimum coherence of edges with the best lattice of chips
_LONGEST_FOR_EDGES = 1.5  # exposure in chips above which edges may be off the lattice of chips
_MOST_COUNTS = 12  # maximum number of lattices that are tried
_LEAST_UNEXPLAINED = 0.04  # fraction of the harmonics' power at which the search ends
_MOST_EQUAL_RATIO = 1.5  # unexplained power over the least one up to which fewer chips are taken

_LEAST_CROSSINGS = 4

_MOST_UNEXPLAINED = 0.15  # maximum unexplained fraction of the harmonics' power
_MOST_NEIGHBOUR_RATIO = 0.5  # maximum unexplained power over that of neighbouring numbers

_PARTS = (1, 2, 3, 4)
_LEAST_CHIPS = 5
_MOST_PER_COUNT = 2
_LEAST_HARMONIC_CORRELATION = 0.85
"""For other chips, where those read explain the stripes badly: divisors of the number read, minimum
number, sequences for each number, and minimum correlation of their harmonics."""

_NEIGHBOURS = (-3, -2, -1, 1, 2, 3)  # differences of the numbers of chips compared


def read_patterns(
    profile: FloatArray,
    flattened: FloatArray,
    period: float,
    check: Callable[[], object] = lambda: None,
    *,
    is_clipped: bool = False,
) -> list[ReadPattern]:
    """Read repeating sequences of chips that explain the stripes, with as few chips as possible.

    Each way of reading, first that by edges, gives one sequence or none. Chips may be misread if
    the exposure is shorter than a column's readout: the place of an edge within a column is then
    unknown. ``is_clipped``: whether white pixels may lengthen bright runs by more than an edge's
    ramp.
    """
    harmonics = harmonics_of(remove_trend(profile), period)
    most = min(MOST_CHIPS, int(period / LEAST_COLUMNS))
    counts = _counts_by_edges(edges_of(flattened), period, most)
    column = None if is_clipped else 1.0 / period
    found = [_fewest(harmonics, counts, column, check)]
    by_edges = found[0]
    if (
        by_edges is None
        or _unexplained(by_edges) > _LEAST_UNEXPLAINED
        or by_edges.exposure > _LONGEST_FOR_EDGES
    ):
        found.append(_chips_by_harmonics(harmonics, most, column, check))
    read = [_join_chips(one) for one in found if one is not None]
    return list({one.chips.tobytes(): one for one in read}.values())


def read_otherwise(
    profile: FloatArray,
    period: float,
    read: Sequence[ReadPattern],
    check: Callable[[], object] = lambda: None,
) -> list[ReadPattern]:
    """Read other sequences of as many chips as were read, or of a half, third or quarter of them.

    It is of use if the chips read explain the stripes badly: an exposure of two or three chips
    leaves little of some harmonics, and is easily taken for that of a single chip.
    """
    harmonics = harmonics_of(remove_trend(profile), period)
    lengths = [one.times * len(one.chips) for one in read]
    counts = {length // part for length in lengths for part in _PARTS if length % part == 0}
    known = {canonical(one.chips).tobytes() for one in read}
    found: dict[bytes, ReadPattern] = {}
    for count in sorted(counts):
        if count < _LEAST_CHIPS:
            continue
        for one in chips_by_descent(harmonics, count, check)[:_MOST_PER_COUNT]:
            short = _join_chips(one)
            if one.explained > _LEAST_HARMONIC_CORRELATION and short.chips.tobytes() not in known:
                found[short.chips.tobytes()] = short
    return list(found.values())


def _fewest(
    harmonics: Harmonics, counts: Sequence[int], column: float | None, check: Callable[[], object]
) -> ReadPattern | None:
    """Find the fewest chips that explain the harmonics about as well as the best number does.

    ``column`` is the fraction of a period that a column takes, where no pixel is white.
    """
    read = []
    for count in counts:
        check()
        rough = best_chips(harmonics, count)
        if rough is not None:
            read.append(refine_timing(harmonics, rough, column and count * column))
            if _unexplained(read[-1]) <= _LEAST_UNEXPLAINED:
                return read[-1]
    left = [_unexplained(one) for one in read]
    most_left = _most_unexplained(left)
    return next((one for one, rest in zip(read, left, strict=True) if rest <= most_left), None)


def _most_unexplained(left: Sequence[float]) -> float:
    """Return the fraction of the power that the fewest chips may leave unexplained."""
    return min(
        _MOST_UNEXPLAINED, max(_LEAST_UNEXPLAINED, _MOST_EQUAL_RATIO * min(left, default=1.0))
    )


def _counts_by_edges(edges: Edges, period: float, most: int) -> list[int]:
    """Return the numbers of chips in a period on whose lattices all edges lie, the fewest first."""
    count = np.arange(2, most + 1)
    if len(edges) < _LEAST_CROSSINGS or count.size == 0:
        return []
    coherent = coherence(edges, count / period)
    if coherent.max() < _LEAST_COHERENCE:
        return []
    good: list[int] = count[coherent >= LEAST_COHERENCE_RATIO * coherent.max()].tolist()
    divisors = [part for part in range(2, good[0]) if good[0] % part == 0]
    # An exposure of nearly a chip shifts edges off the lattice of the chips, onto a finer one.
    return [*divisors, *good[:_MOST_COUNTS]]


def _chips_by_harmonics(
    harmonics: Harmonics, most: int, column: float | None, check: Callable[[], object]
) -> ReadPattern | None:
    """Find the smallest number of chips that explains the harmonics far better than its neighbours.

    This method needs no edges: an exposure of several chips leaves none.
    """
    read = {}
    for count in range(2, most + 1):
        check()
        read[count] = best_chips(harmonics, count)
    left = {count: 1.0 if one is None else _unexplained(one) for count, one in read.items()}
    most_left = _most_unexplained(list(left.values()))
    for count, one in read.items():
        beside = [left[count + step] for step in _NEIGHBOURS if count + step in left]
        stands_out = bool(beside) and left[count] <= _MOST_NEIGHBOUR_RATIO * float(
            np.median(beside)
        )
        if one is not None and left[count] <= most_left and stands_out:
            return refine_timing(harmonics, one, column and count * column)
    return None


def _unexplained(read: ReadPattern) -> float:
    return 1.0 - max(read.explained, 0.0) ** 2


def _join_chips(read: ReadPattern) -> ReadPattern:
    """Join chips into longer ones if all runs are multiples of them; return the canonical form."""
    once = canonical(read.chips)
    changes = np.flatnonzero(once != np.roll(once, 1))
    shared = int(np.gcd.reduce(np.diff(changes, append=changes[0] + len(once))))
    chips = canonical(np.roll(once, -int(changes[0]))[::shared])
    # The period found may hold the chips several times.
    return replace(read, chips=chips, times=len(read.chips) // len(once))
