"""Do the same for many seeds, on two cores where the tests do not use them all already."""

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import TypeVar

Result = TypeVar("Result")


def on_both_cores(what: Callable[[int], Result], seeds: Iterable[int]) -> Iterator[Result]:
    """Yield the result for each seed, in order."""
    if "PYTEST_XDIST_WORKER" in os.environ:
        yield from map(what, seeds)
        return
    # A process reads this before it imports NumPy: its threads would wait for the other process.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # Processes that begin anew: a fork of one that has run Qt may hang.
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        yield from pool.map(what, seeds, chunksize=5)
