"""Things timed side by side."""

from collections.abc import Callable
from dataclasses import dataclass
from statistics import median
from time import perf_counter

_ROUNDS = 41


@dataclass(frozen=True)
class Row:
    what: str
    measured: str
    wanted: str


def side_by_side(*things: Callable[[], object], rounds: int = _ROUNDS) -> list[float]:
    """Time things in turn, round after round; return the median seconds of each."""
    times: list[list[float]] = [[] for _ in things]
    for thing in things:
        thing()
    for _ in range(rounds):
        for thing, seconds in zip(things, times, strict=True):
            start = perf_counter()
            thing()
            seconds.append(perf_counter() - start)
    return [median(seconds) for seconds in times]
