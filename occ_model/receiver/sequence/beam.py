"""The most likely chips behind exposures of many chips: only the best ways are kept.

The states of a trellis double with every chip or two that an exposure covers. The M-algorithm
(Anderson and Mohan, IEEE Trans. Commun. 32:169, 1984) follows the ways of least distance alone, and
drops the others at each chip. A way that was dropped may have been the right one.
"""

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.receiver.sequence.exposures import ChipStatistics
from occ_model.receiver.sequence.max_log import TRUNCATION_DEPTH, Chips
from occ_model.receiver.sequence.trellis import NO_STATE, Word, places_of

_BEAM_WIDTH = 256  # paths kept at each chip


def beam_chips(words: tuple[Word, ...], memory: int, statistics: ChipStatistics) -> Chips:
    """Find chips whose light is near to the rows, and the margins of each.

    A margin is that to the best way kept with the opposite chip, some memories later; where none is
    kept, that to the worst way kept.
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
        best = _best_ways(places, chips[:, :memory], distance)
        places, chips, distance = places[best], chips[best], distance[best] - distance[best[0]]
        values.append(chips[0, -1])
        margins.append(_margin(chips[:, -1], distance))
    later = chips[:, -2::-1]  # the last ones, which no later chip confirms
    values.extend(later[0])
    margins.extend(_margin(column, distance) for column in later.T)
    first = statistics.first - kept + 1
    return Chips(first, np.array(values, dtype=np.uint8), np.array(margins))


def _steps(words: tuple[Word, ...]) -> tuple[ByteArray, IndexArray]:
    """Return the chip and the place of each step out of each place, shape (places, steps)."""
    steps = places_of(words)
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


def _best_ways(places: IndexArray, chips: ByteArray, distance: FloatArray) -> IndexArray:
    """Return the best ways, the best first; of ways that end in one state only the better."""
    order = np.argsort(distance, kind="stable")
    numbers = np.ascontiguousarray(places[order, None]).view(np.uint8)
    state = np.concatenate([numbers, chips[order]], axis=1)
    rows = np.ascontiguousarray(state).view(np.dtype((np.void, state.shape[1]))).ravel()
    _, firsts = np.unique(rows, return_index=True)
    return np.asarray(order[np.sort(firsts)[:_BEAM_WIDTH]])


def _margin(chips: ByteArray, distance: FloatArray) -> float:
    other = distance[chips != chips[0]]
    return float(other[0] if other.size else distance[-1])
