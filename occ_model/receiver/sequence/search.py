"""Find the most likely chips of a trellis, and the margin of each over its opposite.

The method is the forward and backward recursion over the trellis (Bahl, Cocke, Jelinek and Raviv,
IEEE Trans. Inf. Theory 20:284, 1974) with only the largest term of each sum: max-log-MAP. Its chips
are those of the Viterbi algorithm. A long sequence is cut into overlapping parts, so that numpy can
process all parts at once.

The number of states of a trellis doubles with every one or two chips in an exposure. If there are
too many, the M-algorithm (Anderson and Mohan, IEEE Trans. Commun. 32:169, 1984) keeps only the
paths of least distance at each chip. A dropped path may be the correct one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.receiver.sequence.exposures import ChipStatistics, features_of
from occ_model.receiver.sequence.trellis import NO_STATE, Trellis, Word, steps_from_places

_UNREACHABLE_COST = 1e30  # distance of a state that cannot be reached
TRUNCATION_DEPTH = 5  # memory lengths after which surviving paths have a common beginning
_LONGEST_PART = 128  # chips of a part of a sequence, without the overlaps


@dataclass(frozen=True, eq=False, slots=True)
class Chips:
    first: int
    values: ByteArray  # Shape (chips,): the chips
    # Shape (chips,): increase of the rows' squared distance with the opposite chip here and the
    # best chips elsewhere
    margins: FloatArray


def find_best_chips(trellis: Trellis, statistics: ChipStatistics) -> Chips:
    """Find the chips whose light is closest to the rows, from the first chip in the first row."""
    # The first row shows one chip more than the state after it, so a step is prepended.
    features = np.pad(statistics.features, ((1, 0), (0, 0)))
    parts = _Parts.of(len(features), trellis.memory)
    costs = _costs(trellis, features)
    outside_costs = np.where(costs[:1] < _UNREACHABLE_COST, 0.0, _UNREACHABLE_COST)
    costs = np.concatenate([costs, outside_costs])
    forward = _forward(trellis, costs, parts)
    distances = _add_backward(trellis, costs, forward, parts)
    values, margins = _decide(trellis, distances, parts)
    return Chips(statistics.first - trellis.memory, values, margins)


def least_distances(trellis: Trellis, statistics: Sequence[ChipStatistics]) -> FloatArray:
    """Return the minimum squared distance of rows from any chips, for several timings."""
    count = max(len(one.features) for one in statistics)
    features = np.zeros((count, len(statistics), statistics[0].features.shape[1]))
    for timing, one in enumerate(statistics):
        features[: len(one.features), timing] = one.features
    distances = np.zeros((len(statistics), trellis.states))
    for cost in _costs(trellis, features):
        distances = np.minimum.reduce(
            distances.take(trellis.origins, axis=1, mode="wrap") + cost, axis=1
        )
    energy = np.array([float(one.energy.sum()) for one in statistics])
    return np.asarray(distances.min(axis=1) + energy)


@dataclass(frozen=True, eq=False, slots=True)
class _Parts:
    """Equally long parts of a sequence, each overlapping its neighbours."""

    count: int
    core: int
    overlap: int
    chips: IndexArray
    """The chip of each step of each part, shape (steps, parts); ``count`` outside the sequence."""

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


def _costs(trellis: Trellis, features: FloatArray) -> FloatArray:
    """Return the squared distance of each step, shape (chips, ..., steps, states)."""
    word_costs = features @ features_of(trellis.words).T
    costs = word_costs.take(trellis.word_indices, axis=-1)
    costs[..., trellis.origins == NO_STATE] = _UNREACHABLE_COST
    return np.asarray(costs)


def _forward(trellis: Trellis, costs: FloatArray, parts: _Parts) -> FloatArray:
    """Return the least distance of the paths to each state, shape (chips, parts, states).

    ``costs``: the costs of the sequence's chips, followed by those of a chip outside it.
    """
    shape = (parts.chips.shape[1], *costs.shape[1:])
    least_distances = np.empty((len(parts.chips), shape[0], trellis.states))
    distances, candidates, cost = (
        np.zeros(least_distances.shape[1:]),
        np.empty(shape),
        np.empty(shape),
    )
    for step, chips in enumerate(parts.chips):
        costs.take(chips, axis=0, out=cost, mode="wrap")
        distances.take(trellis.origins, axis=1, out=candidates, mode="wrap")
        candidates += cost
        distances = np.minimum.reduce(candidates, axis=1, out=least_distances[step])
    return least_distances


def _add_backward(
    trellis: Trellis, costs: FloatArray, forward: FloatArray, parts: _Parts
) -> FloatArray:
    """Add the least distance of the paths from each state onwards, in place."""
    steps, states = costs.shape[1:]
    count = parts.chips.shape[1]
    distances = np.zeros((count, states))
    step_costs = np.empty((count, steps * states + 1))
    step_costs[:, NO_STATE] = _UNREACHABLE_COST
    next_costs, costs_of_step = (
        np.empty((count, *trellis.exits.shape)),
        np.empty((count, steps, states)),
    )
    for step in range(len(parts.chips) - 2, -1, -1):
        costs.take(parts.chips[step + 1], axis=0, out=costs_of_step, mode="wrap")
        costs_of_step += distances[:, None]
        step_costs[:, :-1] = costs_of_step.reshape(count, -1)
        step_costs.take(trellis.exits, axis=1, out=next_costs, mode="wrap")
        np.minimum.reduce(next_costs, axis=1, out=distances)
        forward[step] += distances
    return forward


def _decide(trellis: Trellis, distance: FloatArray, parts: _Parts) -> tuple[ByteArray, FloatArray]:
    """Decide each chip by the least distance of the paths through each state."""

    def margins(distances: FloatArray, age: int) -> FloatArray:
        advantage = trellis.chips[:, age] == 1
        dark = distances[..., ~advantage].min(axis=-1)
        return np.asarray(dark - distances[..., advantage].min(axis=-1))

    inner = distance[parts.overlap : parts.overlap + parts.core]
    # The first state also contains the chips before its own.
    first_margins = [margins(inner[0], age)[0] for age in range(trellis.memory - 1, 0, -1)]
    later_margins = margins(inner, 0).T.ravel()[: parts.count]
    advantage = np.concatenate([first_margins, later_margins])
    return (advantage > 0.0).astype(np.uint8), np.abs(advantage)


_BEAM_WIDTH = 256  # paths kept at each chip


def search_beam(words: tuple[Word, ...], memory: int, statistics: ChipStatistics) -> Chips:
    """Find chips whose light is close to the rows, and the margin of each.

    The margin is the distance, some memory lengths later, to the best remaining path with the
    opposite chip, or to the worst remaining path if there is none.
    """
    chip_after, position_after = _steps(words)
    reach = memory + 1
    path_length = max(TRUNCATION_DEPTH * reach, reach)
    positions = np.arange(len(chip_after))
    chips = np.zeros((len(positions), path_length), dtype=np.uint8)
    distance = np.zeros(len(positions))
    quadratic = _quadratic(statistics.features, reach)
    values, margins = [], []
    for v, g in zip(statistics.features[:, :reach], quadratic, strict=True):
        origin, choice = np.nonzero(position_after[positions] != NO_STATE)
        new_chips = chip_after[positions[origin], choice]
        chips = np.concatenate([new_chips[:, None], chips[origin, :-1]], axis=1)
        positions = position_after[positions[origin], choice]
        window = chips[:, :reach].astype(np.float64)
        distance = distance[origin] + np.einsum("ij,ij->i", window @ g - 2.0 * v, window)
        best = _select_best_paths(positions, chips[:, :memory], distance)
        positions, chips, distance = (
            positions[best],
            chips[best],
            distance[best] - distance[best[0]],
        )
        values.append(chips[0, -1])
        margins.append(_margin(chips[:, -1], distance))
    last_chips = chips[:, -2::-1]  # not yet decided when the sequence ends
    values.extend(last_chips[0])
    margins.extend(_margin(column, distance) for column in last_chips.T)
    first = statistics.first - path_length + 1
    return Chips(first, np.array(values, dtype=np.uint8), np.array(margins))


def _steps(words: tuple[Word, ...]) -> tuple[ByteArray, IndexArray]:
    """Return the chip and the destination of each step, shape (positions, steps)."""
    steps = steps_from_places(words)
    max_steps = max(map(len, steps))
    chips = np.zeros((len(steps), max_steps), dtype=np.uint8)
    destinations = np.full((len(steps), max_steps), NO_STATE)
    for position, position_steps in enumerate(steps):
        for number, (chip, destination) in enumerate(position_steps):
            chips[position, number], destinations[position, number] = chip, destination
    return chips, destinations


def _quadratic(features: FloatArray, reach: int) -> FloatArray:
    """Return the matrix G of each chip, shape (chips, reach, reach), as an upper triangle."""
    matrices = np.zeros((len(features), reach, reach))
    upper, lower = np.triu_indices(reach, 1)
    diagonal = np.arange(reach)
    matrices[:, diagonal, diagonal] = features[:, reach : 2 * reach]
    matrices[:, upper, lower] = features[:, 2 * reach :]
    return matrices


def _select_best_paths(positions: IndexArray, chips: ByteArray, distance: FloatArray) -> IndexArray:
    """Return the best paths in order, and only the best of those that end in the same state."""
    order = np.argsort(distance, kind="stable")
    numbers = np.ascontiguousarray(positions[order, None]).view(np.uint8)
    state = np.concatenate([numbers, chips[order]], axis=1)
    rows = np.ascontiguousarray(state).view(np.dtype((np.void, state.shape[1]))).ravel()
    _, firsts = np.unique(rows, return_index=True)
    return np.asarray(order[np.sort(firsts)[:_BEAM_WIDTH]])


def _margin(chips: ByteArray, distance: FloatArray) -> float:
    other = distance[chips != chips[0]]
    return float(other[0] if other.size else distance[-1])
