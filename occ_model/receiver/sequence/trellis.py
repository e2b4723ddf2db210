"""Make the trellis of a code: which chips may follow which within an exposure.

A code is a set of words of chips, each from one state of the encoder to another; a header is an
additional word. The places at which words start in a chip sequence are unknown, and any word may
follow any other that ends in its initial state. Each state of the trellis is a place within a word,
with the chips before it.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray

NO_STATE = -1  # marks an unused place of a table


@dataclass(frozen=True, slots=True)
class Word:
    """Chips that are sent together, leading from one state of the encoder to another."""

    before: int
    chips: tuple[int, ...]
    after: int


FREE_CHIPS = (Word(0, (0,), 0), Word(0, (1,), 0))  # any chip may follow any other


@dataclass(frozen=True, eq=False, slots=True)
class Trellis:
    """The states of a code for exposures of some chips, and the steps between them.

    A step adds a chip. The steps into a state are numbered; missing ones are ``NO_STATE``.
    """

    memory: int  # Number of chips in a state
    places: IndexArray  # Shape (states,): the place within the words, see steps_from_places
    chips: ByteArray  # Shape (states, memory): the last chips, with the latest first
    before: IndexArray  # Shape (steps, states): the state from which each step comes
    words: FloatArray  # Shape (words, memory + 1): possible chips of a step, with the latest first
    word_of: IndexArray  # Shape (steps, states): the word of each step
    # Shape (ways, states): the steps from each state, as indices of the flattened ``before``
    after: IndexArray

    @property
    def states(self) -> int:
        return len(self.places)


@lru_cache(maxsize=32)
def steps_from_places(words: tuple[Word, ...]) -> tuple[tuple[tuple[int, int], ...], ...]:
    """Return the steps from each place within the words, as pairs of a chip and a place.

    Places are the encoder's states between words, and those within words. Words with the same
    beginning have common places, and places from which the same chips can follow are merged.
    """
    count = 1 + max(max(word.before, word.after) for word in words)
    steps: list[dict[tuple[int, int], int]] = [{} for _ in range(count)]
    for word in words:
        place = word.before
        for chip in word.chips[:-1]:
            key = (chip, NO_STATE)
            if key not in steps[place]:
                steps[place][key] = len(steps)
                steps.append({})
            place = steps[place][key]
        steps[place][(word.chips[-1], word.after)] = word.after
    return _merge([tuple((chip, to) for (chip, _), to in one.items()) for one in steps])


def _merge(steps: list[tuple[tuple[int, int], ...]]) -> tuple[tuple[tuple[int, int], ...], ...]:
    """Merge places from which the same chips can follow, by refining classes until stable."""
    classes, count = [0] * len(steps), 1
    while True:
        seen: dict[tuple[int, frozenset[tuple[int, int]]], int] = {}
        finer = []
        for own, one in zip(classes, steps, strict=True):
            key = (own, frozenset((chip, classes[to]) for chip, to in one))
            finer.append(seen.setdefault(key, len(seen)))
        if len(seen) == count:
            break
        classes, count = finer, len(seen)
    merged = {own: sorted(key[1]) for key, own in zip(seen, range(count), strict=True)}
    # The classes have the same numbers in both rounds, each that of its first place.
    return tuple(tuple(merged[own]) for own in range(count))


def count_most_states(words: tuple[Word, ...], memory: int) -> int:
    """Return the maximum number of a trellis's states: that of paths of ``memory`` steps."""
    steps = steps_from_places(words)
    ways = [1] * len(steps)
    for _ in range(memory):
        on = [0] * len(steps)
        for place, one in enumerate(steps):
            for _, to in one:
                on[to] += ways[place]
        ways = on
    return sum(ways)


@lru_cache(maxsize=16)
def make_trellis(words: tuple[Word, ...], memory: int) -> Trellis:
    """Make the trellis of a code; ``memory``: one chip less than an exposure can touch."""
    steps = steps_from_places(words)
    reached: set[tuple[int, tuple[int, ...]]] = {(place, ()) for place in range(len(steps))}
    for _ in range(memory):
        reached = {(to, (chip, *chips)) for place, chips in reached for chip, to in steps[place]}
    states = sorted(reached)
    number = {state: place for place, state in enumerate(states)}
    into: list[list[tuple[int, tuple[int, ...]]]] = [[] for _ in states]
    for (place, chips), state in number.items():
        for chip, to in steps[place]:
            word = (chip, *chips)
            into[number[to, word[:memory]]].append((state, word))
    most = max(map(len, into))
    before = np.full((most, len(states)), NO_STATE)
    words_of = np.zeros((most * len(states), memory + 1))
    for state, found in enumerate(into):
        for step, (origin, word) in enumerate(found):
            before[step, state] = origin
            words_of[step * len(states) + state] = word
    different, word_of = np.unique(words_of, axis=0, return_inverse=True)
    return Trellis(
        memory,
        np.array([place for place, _ in states]),
        np.array([chips for _, chips in states], dtype=np.uint8).reshape(len(states), memory),
        before,
        different,
        word_of.reshape(before.shape),
        _steps_from_states(before),
    )


def _steps_from_states(before: IndexArray) -> IndexArray:
    """Return the steps from each state, as indices of the flattened table of steps into states."""
    flat = before.ravel()
    used = np.flatnonzero(flat != NO_STATE)
    used = used[np.argsort(flat[used], kind="stable")]
    origins = flat[used]
    starts = np.searchsorted(origins, np.arange(before.shape[1]))
    rank = np.arange(len(used)) - starts[origins]
    after = np.full((int(rank.max()) + 1, before.shape[1]), NO_STATE)
    after[rank, origins] = used
    return after
