"""Let several readings search their trellises together: each asks, all are answered at once.

A reading is a generator that yields what is to be searched and is sent what was found, so that one
and several readings run the same steps.
"""

from collections import defaultdict
from collections.abc import Generator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias, TypeVar

from occ_model.receiver.sequence.beam import search_beam
from occ_model.receiver.sequence.code_words import MOST_STATES
from occ_model.receiver.sequence.exposures import ChipStatistics
from occ_model.receiver.sequence.search import Chips, find_all_best_chips, least_distances
from occ_model.receiver.sequence.trellis import Word, count_paths, make_trellis


@dataclass(frozen=True, eq=False, slots=True)
class Request:
    """Sequences of rows to search for chips of some words."""

    words: tuple[Word, ...]
    memory: int
    statistics: Sequence[ChipStatistics]
    # Whether the least distance of each is asked for, an array, instead of its chips, a list
    only_distances: bool = False


T = TypeVar("T")

Reading: TypeAlias = Generator[Request, Any, T]


def is_searched_completely(words: tuple[Word, ...], memory: int) -> bool:
    """Return whether the trellis is small enough to keep all of its states."""
    return count_paths(words, memory) <= MOST_STATES


def run_readings(readings: Sequence[Reading[T]]) -> list[T]:
    """Run readings to their ends, and return what each returns."""
    results: dict[int, T] = {}
    answers: dict[int, Any] = dict.fromkeys(range(len(readings)))
    while answers:
        alike: dict[tuple[object, ...], dict[int, Request]] = defaultdict(dict)
        for place, answer in answers.items():
            try:
                request = readings[place].send(answer)
            except StopIteration as end:
                results[place] = end.value
                continue
            alike[request.words, request.memory, request.only_distances][place] = request
        answers = {}
        for requests in alike.values():
            answers |= zip(requests, _answer(list(requests.values())), strict=True)
    return [results[place] for place in range(len(readings))]


def _answer(requests: Sequence[Request]) -> list[Any]:
    """Answer requests that differ only in their rows."""
    first = requests[0]
    statistics = [one for request in requests for one in request.statistics]
    found: Sequence[Chips] | Any
    if not is_searched_completely(first.words, first.memory):
        found = [search_beam(first.words, first.memory, one) for one in statistics]
    elif first.only_distances:
        found = least_distances(make_trellis(first.words, first.memory), statistics)
    else:
        found = find_all_best_chips(make_trellis(first.words, first.memory), statistics)
    answers, place = [], 0
    for request in requests:
        answers.append(found[place : place + len(request.statistics)])
        place += len(request.statistics)
    return answers
