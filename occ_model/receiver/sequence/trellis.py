"""Make the trellis of a code: which chips may follow which within an exposure.

A code is a set of words of chips, each from one state of the encoder to another; a header is an
additional word. Where words start in a chip sequence is unknown, and a word may follow any other
that ends in its initial state. A state of the trellis is a place within a word and the last chips.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray

NO_STATE = -1  # marks an unused place of a table


@dataclass(frozen=True, slots=True)
class Word:
    """Chips that are sent together and lead from one state of the encoder to another."""

    start_state: int
    chips: tuple[int, ...]
    end_state: int


FREE_CHIPS = (Word(0, (0,), 0), Word(0, (1,), 0))  # any chip may follow any other


@dataclass(frozen=True, eq=False, slots=True)
class Trellis:
    """The states of a code for exposures of some chips, and the steps between them.

    A step adds a chip. The steps into each state are numbered; unused numbers have ``NO_STATE``.
    """

    memory: int  # Number of chips in a state
    places: IndexArray  # Shape (states,): the place within the words, see steps_from_places
    chips: ByteArray  # Shape (states, memory): the last chips, with the latest first
    origins: IndexArray  # Shape (steps, states): the state from which each step comes
    words: FloatArray  # Shape (words, memory + 1): possible chips of a step, with the latest first
    word_indices: IndexArray  # Shape (steps, states): the word of each step
    # Shape (steps, states): the steps from each state, as indices of the flattened ``origins``
    exits: IndexArray

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
    # Both rounds number the classes equally, in the order of their first places.
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
    state_numbers = {state: place for place, state in enumerate(states)}
    steps_into: list[list[tuple[int, tuple[int, ...]]]] = [[] for _ in states]
    for (place, chips), origin in state_numbers.items():
        for chip, to in steps[place]:
            word = (chip, *chips)
            steps_into[state_numbers[to, word[:memory]]].append((origin, word))
    max_steps = max(map(len, steps_into))
    origins = np.full((max_steps, len(states)), NO_STATE)
    step_words = np.zeros((max_steps * len(states), memory + 1))
    for state, state_steps in enumerate(steps_into):
        for step, (origin, word) in enumerate(state_steps):
            origins[step, state] = origin
            step_words[step * len(states) + state] = word
    words_of_steps, word_indices = np.unique(step_words, axis=0, return_inverse=True)
    return Trellis(
        memory,
        np.array([place for place, _ in states]),
        np.array([chips for _, chips in states], dtype=np.uint8).reshape(len(states), memory),
        origins,
        words_of_steps,
        word_indices.reshape(origins.shape),
        _steps_from_states(origins),
    )


def _steps_from_states(origins: IndexArray) -> IndexArray:
    """Return the steps from each state, as indices of the flattened table of steps into states."""
    flat_origins = origins.ravel()
    steps = np.flatnonzero(flat_origins != NO_STATE)
    steps = steps[np.argsort(flat_origins[steps], kind="stable")]
    sorted_origins = flat_origins[steps]
    starts = np.searchsorted(sorted_origins, np.arange(origins.shape[1]))
    rank = np.arange(len(steps)) - starts[sorted_origins]
    exits = np.full((int(rank.max()) + 1, origins.shape[1]), NO_STATE)
    exits[rank, sorted_origins] = steps
    return exits
