"""Make the trellis of a code: which chips may follow which within an exposure.

A code is a set of words of chips, each from one state of the encoder to another; a header is an
additional word. Where words start in a chip sequence is unknown, and a word may follow any other
that ends in its initial state. A state of the trellis is a place within a word and the last chips.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.receiver.sequence.exposures import weights_of

NO_STATE = -1  # stands where there is no state


@dataclass(frozen=True, slots=True)
class Word:
    """Chips that are sent together and lead from one state of the encoder to another."""

    start_state: int
    chips: tuple[int, ...]
    end_state: int


FREE_CHIPS = (Word(0, (0,), 0), Word(0, (1,), 0))  # any chip may follow any other


@dataclass(frozen=True, eq=False, slots=True)
class Steps:
    """The steps into each state of a trellis, or the steps from each, one column a state.

    A state with fewer steps than others has, in place of those missing, the index after the last
    cost.
    """

    neighbours: IndexArray  # Shape (steps, states): the state at the other end of each step
    costs: IndexArray  # Shape (steps, states): the index of each step's cost


@dataclass(frozen=True, eq=False, slots=True)
class Trellis:
    """The states of a code for exposures of some chips, and the steps between them.

    A step adds a chip. Many steps have the same cost, since only the number of lit chips counts
    where an exposure covers several of them completely.
    """

    memory: int  # Number of chips in a state
    places: IndexArray  # Shape (states,): the place within the words, see steps_from_places
    chips: ByteArray  # Shape (states, memory): the last chips, with the latest first
    weights: FloatArray  # Shape (weights, costs): see weights_of
    entries: Steps  # The steps into each state
    exits: Steps  # The steps from each state

    @property
    def states(self) -> int:
        return len(self.places)


@lru_cache(maxsize=32)
def steps_from_places(words: tuple[Word, ...]) -> tuple[tuple[tuple[int, int], ...], ...]:
    """Return the steps from each place within the words, as pairs of a chip and a place.

    A place is a state of the encoder between words, or a place within a word. Words with the same
    beginning share places, and places from which the same chips can follow are merged.
    """
    count = 1 + max(max(word.start_state, word.end_state) for word in words)
    steps: list[dict[tuple[int, int], int]] = [{} for _ in range(count)]
    for word in words:
        place = word.start_state
        for chip in word.chips[:-1]:
            key = (chip, NO_STATE)
            if key not in steps[place]:
                steps[place][key] = len(steps)
                steps.append({})
            place = steps[place][key]
        steps[place][(word.chips[-1], word.end_state)] = word.end_state
    return _merge(
        [tuple((chip, to) for (chip, _), to in place_steps.items()) for place_steps in steps]
    )


def _merge(steps: list[tuple[tuple[int, int], ...]]) -> tuple[tuple[tuple[int, int], ...], ...]:
    """Merge places from which the same chips can follow, by refining classes until stable."""
    classes, count = [0] * len(steps), 1
    while True:
        class_numbers: dict[tuple[int, frozenset[tuple[int, int]]], int] = {}
        refined_classes = []
        for place_class, place_steps in zip(classes, steps, strict=True):
            key = (place_class, frozenset((chip, classes[to]) for chip, to in place_steps))
            refined_classes.append(class_numbers.setdefault(key, len(class_numbers)))
        if len(class_numbers) == count:
            break
        classes, count = refined_classes, len(class_numbers)
    class_steps = {
        place_class: sorted(key[1])
        for key, place_class in zip(class_numbers, range(count), strict=True)
    }
    # The last two rounds number the classes alike, in the order of their first places.
    return tuple(tuple(class_steps[place_class]) for place_class in range(count))


def count_paths(words: tuple[Word, ...], memory: int) -> int:
    """Return the maximum number of a trellis's states: the number of paths of ``memory`` steps."""
    steps = steps_from_places(words)
    path_counts = [1] * len(steps)
    for _ in range(memory):
        next_counts = [0] * len(steps)
        for place, place_steps in enumerate(steps):
            for _, to in place_steps:
                next_counts[to] += path_counts[place]
        path_counts = next_counts
    return sum(path_counts)


@lru_cache(maxsize=16)
def make_trellis(words: tuple[Word, ...], memory: int) -> Trellis:
    """Make the trellis of a code; ``memory``: one chip less than an exposure can touch."""
    steps = steps_from_places(words)
    reachable: set[tuple[int, tuple[int, ...]]] = {(place, ()) for place in range(len(steps))}
    for _ in range(memory):
        reachable = {
            (to, (chip, *chips)) for place, chips in reachable for chip, to in steps[place]
        }
    states = sorted(reachable)
    state_numbers = {state: number for number, state in enumerate(states)}
    all_steps = [
        (origin, state_numbers[to, (chip, *chips)[:memory]], (chip, *chips))
        for (place, chips), origin in state_numbers.items()
        for chip, to in steps[place]
    ]
    origins, destinations = np.array([step[:2] for step in all_steps]).T
    weights, costs = np.unique(
        weights_of(np.array([exposed for *_, exposed in all_steps], dtype=np.uint8)),
        axis=1, return_inverse=True,
    )  # fmt: skip
    count, no_cost = len(states), weights.shape[1]
    return Trellis(
        memory,
        np.array([place for place, _ in states]),
        np.array([chips for _, chips in states], dtype=np.uint8).reshape(count, memory),
        weights,
        _number_steps(destinations, origins, costs.ravel(), count, no_cost),
        _number_steps(origins, destinations, costs.ravel(), count, no_cost),
    )


def _number_steps(
    ends: IndexArray, others: IndexArray, costs: IndexArray, states: int, no_cost: int
) -> Steps:
    """List the steps of each state, which is at one of their two ends, in a table."""
    order = np.argsort(ends, kind="stable")
    ends = ends[order]
    number = np.arange(len(ends)) - np.searchsorted(ends, ends)
    numbered = Steps(
        np.zeros((int(number.max()) + 1, states), dtype=np.int64),
        np.full((int(number.max()) + 1, states), no_cost),
    )
    numbered.neighbours[number, ends] = others[order]
    numbered.costs[number, ends] = costs[order]
    return numbered
