"""Find the most likely chips of a trellis, and the margin of each over its opposite.

The method is the forward and backward recursion over the trellis (Bahl, Cocke, Jelinek and Raviv,
IEEE Trans. Inf. Theory 20:284, 1974) with only the largest term of each sum: max-log-MAP. Its chips
are those of the Viterbi algorithm. A long sequence is cut into overlapping parts, so that numpy can
process all parts at once.

The number of states of a trellis doubles with every one or two chips in an exposure. If there are
too many, the M-algorithm (Anderson and Mohan, IEEE Trans. Commun. 32:169, 1984) follows only the
paths of least distance and drops the others at each chip. A dropped path may have been the correct
one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.receiver.sequence.exposures import ChipStatistics, features_of
from occ_model.receiver.sequence.trellis import NO_STATE, Trellis, Word, steps_from_places

_UNREACHABLE_COST = 1e30  # distance of a state that cannot be reached
TRUNCATION_DEPTH = 5  # memories of a trellis after which surviving paths have a common beginning
_LONGEST_PART = 128  # chips of a part of a sequence, without the overlaps


@dataclass(frozen=True, eq=False, slots=True)
class Chips:
    first: int
    values: ByteArray  # Shape (chips,): the chips
    # Shape (chips,): growth of the rows' squared distance if this chip were the opposite and the
    # others were the best for it
    margins: FloatArray


def find_best_chips(trellis: Trellis, statistics: ChipStatistics) -> Chips:
    """Find the chips whose light is closest to the rows, from the first that a row can show."""
    # The first row shows one chip more than the state after it contains, so a step is prepended.
    features = np.pad(statistics.features, ((1, 0), (0, 0)))
    parts = _Parts.of(len(features), trellis.memory)
    costs = _costs(trellis, features)
    outside = np.where(costs[:1] < _UNREACHABLE_COST, 0.0, _UNREACHABLE_COST)
    costs = np.concatenate([costs, outside])
    forward = _forward(trellis, costs, parts)
    both = _add_backward(trellis, costs, forward, parts)
    values, margins = _decide(trellis, both, parts)
    return Chips(statistics.first - trellis.memory, values, margins)


def least_distances(trellis: Trellis, statistics: Sequence[ChipStatistics]) -> FloatArray:
    """Return the minimum squared distance of rows from any chips, for several timings."""
    count = max(len(one.features) for one in statistics)
    features = np.zeros((count, len(statistics), statistics[0].features.shape[1]))
    for place, one in enumerate(statistics):
        features[: len(one.features), place] = one.features
    now = np.zeros((len(statistics), trellis.states))
    for cost in _costs(trellis, features):
        now = np.minimum.reduce(now.take(trellis.before, axis=1, mode="wrap") + cost, axis=1)
    energy = np.array([float(one.energy.sum()) for one in statistics])
    return np.asarray(now.min(axis=1) + energy)


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
    of_words = features @ features_of(trellis.words).T
    costs = of_words.take(trellis.word_of, axis=-1)
    costs[..., trellis.before == NO_STATE] = _UNREACHABLE_COST
    return np.asarray(costs)


def _forward(trellis: Trellis, costs: FloatArray, parts: _Parts) -> FloatArray:
    """Return the least distance of the paths to each state, shape (chips, parts, states).

    ``costs``: the costs of the whole sequence, and last those of a chip that no row shows.
    """
    shape = (parts.chips.shape[1], *costs.shape[1:])
    least = np.empty((len(parts.chips), shape[0], trellis.states))
    now, ways, cost = np.zeros(least.shape[1:]), np.empty(shape), np.empty(shape)
    for step, chips in enumerate(parts.chips):
        costs.take(chips, axis=0, out=cost, mode="wrap")
        now.take(trellis.before, axis=1, out=ways, mode="wrap")
        ways += cost
        now = np.minimum.reduce(ways, axis=1, out=least[step])
    return least


def _add_backward(
    trellis: Trellis, costs: FloatArray, forward: FloatArray, parts: _Parts
) -> FloatArray:
    """Add the least distance of the paths from each state onwards, in place."""
    steps, states = costs.shape[1:]
    count = parts.chips.shape[1]
    now = np.zeros((count, states))
    ways = np.empty((count, steps * states + 1))
    ways[:, NO_STATE] = _UNREACHABLE_COST
    on, into = np.empty((count, *trellis.after.shape)), np.empty((count, steps, states))
    for step in range(len(parts.chips) - 2, -1, -1):
        costs.take(parts.chips[step + 1], axis=0, out=into, mode="wrap")
        into += now[:, None]
        ways[:, :-1] = into.reshape(count, -1)
        ways.take(trellis.after, axis=1, out=on, mode="wrap")
        np.minimum.reduce(on, axis=1, out=now)
        forward[step] += now
    return forward


def _decide(trellis: Trellis, distance: FloatArray, parts: _Parts) -> tuple[ByteArray, FloatArray]:
    """Decide each chip by the least distance of the paths through each state."""

    def margins(of_states: FloatArray, age: int) -> FloatArray:
        lit = trellis.chips[:, age] == 1
        dark = of_states[..., ~lit].min(axis=-1)
        return np.asarray(dark - of_states[..., lit].min(axis=-1))

    inner = distance[parts.overlap : parts.overlap + parts.core]
    # The first state also contains the chips before its own.
    first = [margins(inner[0], age)[0] for age in range(trellis.memory - 1, 0, -1)]
    later = margins(inner, 0).T.ravel()[: parts.count]
    lit = np.concatenate([first, later])
    return (lit > 0.0).astype(np.uint8), np.abs(lit)


_BEAM_WIDTH = 256  # paths kept at each chip


def search_beam(words: tuple[Word, ...], memory: int, statistics: ChipStatistics) -> Chips:
    """Find chips whose light is close to the rows, and the margin of each.

    The margin is the distance to the best path kept with the opposite chip, some memories later, or
    to the worst path kept if there is none.
    """
    chip_after, place_after = _steps(words)
    reach = memory + 1
    kept = max(TRUNCATION_DEPTH * reach, reach)
    places = np.arange(len(chip_after))
    chips = np.zeros((len(places), kept), dtype=np.uint8)
    distance = np.zeros(len(places))
    quadratic = _quadratic(statistics.features, reach)
    values, margins = [], []
    for v, g in zip(statistics.features[:, :reach], quadratic, strict=True):
        origin, choice = np.nonzero(place_after[places] != NO_STATE)
        added = chip_after[places[origin], choice]
        chips = np.concatenate([added[:, None], chips[origin, :-1]], axis=1)
        places = place_after[places[origin], choice]
        window = chips[:, :reach].astype(np.float64)
        distance = distance[origin] + np.einsum("ij,ij->i", window @ g - 2.0 * v, window)
        best = _select_best_paths(places, chips[:, :memory], distance)
        places, chips, distance = places[best], chips[best], distance[best] - distance[best[0]]
        values.append(chips[0, -1])
        margins.append(_margin(chips[:, -1], distance))
    later = chips[:, -2::-1]  # the last ones, which no later chip confirms
    values.extend(later[0])
    margins.extend(_margin(column, distance) for column in later.T)
    first = statistics.first - kept + 1
    return Chips(first, np.array(values, dtype=np.uint8), np.array(margins))


def _steps(words: tuple[Word, ...]) -> tuple[ByteArray, IndexArray]:
    """Return the chip and the destination of each step from each place, shape (places, steps)."""
    steps = steps_from_places(words)
    most = max(map(len, steps))
    chips = np.zeros((len(steps), most), dtype=np.uint8)
    places = np.full((len(steps), most), NO_STATE)
    for place, ways in enumerate(steps):
        for number, (chip, to) in enumerate(ways):
            chips[place, number], places[place, number] = chip, to
    return chips, places


def _quadratic(features: FloatArray, reach: int) -> FloatArray:
    """Return the matrix G of each chip, shape (chips, reach, reach), as an upper triangle."""
    matrices = np.zeros((len(features), reach, reach))
    upper, lower = np.triu_indices(reach, 1)
    diagonal = np.arange(reach)
    matrices[:, diagonal, diagonal] = features[:, reach : 2 * reach]
    matrices[:, upper, lower] = features[:, 2 * reach :]
    return matrices


def _select_best_paths(places: IndexArray, chips: ByteArray, distance: FloatArray) -> IndexArray:
    """Return the best paths in order, and only the best of those that end in the same state."""
    order = np.argsort(distance, kind="stable")
    numbers = np.ascontiguousarray(places[order, None]).view(np.uint8)
    state = np.concatenate([numbers, chips[order]], axis=1)
    rows = np.ascontiguousarray(state).view(np.dtype((np.void, state.shape[1]))).ravel()
    _, firsts = np.unique(rows, return_index=True)
    return np.asarray(order[np.sort(firsts)[:_BEAM_WIDTH]])


def _margin(chips: ByteArray, distance: FloatArray) -> float:
    other = distance[chips != chips[0]]
    return float(other[0] if other.size else distance[-1])
