"""Search a trellis that has too many states by its most likely paths only.

The number of states of a trellis doubles with every one or two chips in an exposure. If there are
too many, the M-algorithm (Anderson and Mohan, IEEE Trans. Commun. 32:169, 1984) keeps only the
paths of least distance at each chip. A dropped path may be the correct one.
"""

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.receiver.sequence.exposures import ChipStatistics, weights_of
from occ_model.receiver.sequence.search import TRUNCATION_DEPTH, Chips
from occ_model.receiver.sequence.trellis import NO_STATE, Word, steps_from_places

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
    values, margins = [], []
    for sums in statistics.sums.T:
        origin, choice = np.nonzero(position_after[positions] != NO_STATE)
        new_chips = chip_after[positions[origin], choice]
        chips = np.concatenate([new_chips[:, None], chips[origin, :-1]], axis=1)
        positions = position_after[positions[origin], choice]
        added = np.einsum("kp,k->p", weights_of(chips[:, :reach]), sums)
        distance = distance[origin] + added
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
