"""Find the most likely chips of a trellis, and the margin of each over its opposite.

The method is the forward and backward recursion over the trellis (Bahl, Cocke, Jelinek and Raviv,
IEEE Trans. Inf. Theory 20:284, 1974) with only the largest term of each sum: max-log-MAP. Its chips
are those of the Viterbi algorithm. A long sequence is cut into overlapping parts, so that numpy can
process all parts at once, those of several sequences too.
"""

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.receiver.sequence.exposures import ChipStatistics
from occ_model.receiver.sequence.trellis import Steps, Trellis

_UNREACHABLE_COST = 1e30  # distance of a state that cannot be reached
TRUNCATION_DEPTH = 5  # memory lengths after which surviving paths have a common beginning
_LONGEST_PART = 128  # chips of a part of a sequence, without the overlaps

_DISTANCES_AT_ONCE = 4096  # distances that are updated at once, to fit the processor's cache


@dataclass(frozen=True, eq=False, slots=True)
class Chips:
    first: int
    values: ByteArray  # Shape (chips,): the chips
    # Shape (chips,): increase of the rows' squared distance with the opposite chip here and the
    # best chips elsewhere
    margins: FloatArray


def find_all_best_chips(trellis: Trellis, statistics: Sequence[ChipStatistics]) -> list[Chips]:
    """Find the chips of several sequences of rows, each exactly as if it were alone."""
    # The first row shows one chip more than the state after it, so a step is prepended.
    parts = [_Parts.of(1 + len(one.energy), trellis.memory) for one in statistics]
    together = max(1, _DISTANCES_AT_ONCE // (trellis.states * max(one.number for one in parts)))
    found: list[Chips] = []
    for first in range(0, len(parts), together):
        these = slice(first, first + together)
        found += _find_chips(trellis, statistics[these], parts[these])
    return found


def _find_chips(
    trellis: Trellis, statistics: Sequence[ChipStatistics], parts: Sequence["_Parts"]
) -> list[Chips]:
    costs, places = _costs(trellis, statistics, 1)
    steps = max(len(one.chips) for one in parts)
    outside = costs.shape[1] - 1
    chips = np.full((steps, sum(one.number for one in parts)), outside)
    columns = np.cumsum([0, *(one.number for one in parts)])
    for its, place, column in zip(parts, places, columns[:-1], strict=True):
        part = chips[: len(its.chips), column : column + its.number]
        np.copyto(part, its.chips + place, where=its.chips < its.count)
    distances = _forward(trellis, costs, chips)
    _add_backward(trellis, costs, chips, distances)
    margins = _margins(trellis, distances, 0)
    found = []
    for one, its, column in zip(statistics, parts, columns[:-1], strict=True):
        inner = slice(its.overlap, its.overlap + its.core)
        later = margins[inner, column : column + its.number].T.ravel()[: its.count]
        # The first state also contains the chips before its own.
        start = distances[its.overlap, :, column]
        earlier = [_margins(trellis, start, age) for age in range(trellis.memory - 1, 0, -1)]
        advantage = np.concatenate([earlier, later])
        found.append(
            Chips(one.first - trellis.memory, (advantage > 0.0).astype(np.uint8), np.abs(advantage))
        )
    return found


def least_distances(trellis: Trellis, statistics: Sequence[ChipStatistics]) -> FloatArray:
    """Return the minimum squared distance of rows from any chips, for several timings."""
    costs, places = _costs(trellis, statistics, 0)
    counts = np.array([len(one.energy) for one in statistics])
    step = np.arange(counts.max())[:, None]
    chips = np.where(step < counts, step + places, costs.shape[1] - 1)
    start = np.zeros((trellis.states, len(statistics)))
    (distances,) = deque(_recursion(costs, chips, trellis.entries, start), maxlen=1)
    energy = np.array([float(one.energy.sum()) for one in statistics])
    return np.asarray(distances.min(axis=0) + energy)


@dataclass(frozen=True, eq=False, slots=True)
class _Parts:
    """Equally long parts of a sequence, each overlapping its neighbours."""

    count: int
    core: int
    overlap: int
    chips: IndexArray
    """The chip of each step of each part, shape (steps, parts); ``count`` outside the sequence."""

    @property
    def number(self) -> int:
        return int(self.chips.shape[1])

    @classmethod
    def of(cls, count: int, memory: int) -> Self:
        overlap = TRUNCATION_DEPTH * (memory + 1)
        parts = -(-count // _LONGEST_PART)
        if parts == 1 or count <= 2 * overlap:
            return cls(count, count, 0, np.arange(count)[:, None])
        core = -(-count // parts)
        steps = np.arange(-overlap, core + overlap)
        chips = steps[:, None] + core * np.arange(parts)
        return cls(count, core, overlap, np.where((chips >= 0) & (chips < count), chips, count))


def _costs(
    trellis: Trellis, statistics: Sequence[ChipStatistics], before: int
) -> tuple[FloatArray, IndexArray]:
    """Return the costs of all sequences' chips, shape (costs + 1, chips), and where each begins.

    The last row is that of no step, the last column a chip outside the sequences. Each sequence has
    ``before`` chips of no cost before its own.
    """
    counts = [before + len(one.energy) for one in statistics]
    places = np.cumsum([0, *counts])
    costs = np.zeros((trellis.weights.shape[1] + 1, int(places[-1]) + 1))
    costs[-1] = _UNREACHABLE_COST
    for place, one in zip(places[:-1], statistics, strict=True):
        part = slice(place + before, place + before + len(one.energy))
        # Not by the matrix product of BLAS, whose threads take longer than the product.
        costs[:-1, part] = np.einsum("kw,kc->wc", trellis.weights, one.sums)
    return costs, places[:-1]


def _recursion(
    costs: FloatArray, chips: IndexArray, steps: Steps, distances: FloatArray
) -> Iterator[FloatArray]:
    """Yield the least distance of each state after each row of chips, shape (states, parts)."""
    shape = (*steps.costs.shape, chips.shape[1])
    candidates, added = np.empty(shape), np.empty(shape)
    costs_of_chips = np.empty((len(costs), chips.shape[1]))
    for chips_of_step in chips:
        costs.take(chips_of_step, axis=1, out=costs_of_chips, mode="wrap")
        distances.take(steps.neighbours, axis=0, out=candidates, mode="wrap")
        candidates += costs_of_chips.take(steps.costs, axis=0, out=added, mode="wrap")
        distances = np.minimum.reduce(candidates, axis=0)
        yield distances


def _forward(trellis: Trellis, costs: FloatArray, chips: IndexArray) -> FloatArray:
    """Return the least distance of the paths to each state, shape (steps, states, parts)."""
    distances = np.empty((len(chips), trellis.states, chips.shape[1]))
    start = np.zeros(distances.shape[1:])
    for step, least in enumerate(_recursion(costs, chips, trellis.entries, start)):
        distances[step] = least
    return distances


def _add_backward(
    trellis: Trellis, costs: FloatArray, chips: IndexArray, forward: FloatArray
) -> None:
    """Add the least distance of the paths from each state onwards, in place."""
    end = np.zeros(forward.shape[1:])
    backward = _recursion(costs, chips[:0:-1], trellis.exits, end)
    for distances, least in zip(forward[-2::-1], backward, strict=True):
        distances += least


def _margins(trellis: Trellis, distances: FloatArray, age: int) -> FloatArray:
    """Return how much farther the paths with a dark chip are, of distances (..., states, parts).

    ``age``: how many chips before the last one of a state.
    """
    lit = np.flatnonzero(trellis.chips[:, age])
    dark = np.flatnonzero(trellis.chips[:, age] == 0)
    axis = min(1, distances.ndim - 1)
    dark_least = distances.take(dark, axis=axis).min(axis=axis)
    return np.asarray(dark_least - distances.take(lit, axis=axis).min(axis=axis))
