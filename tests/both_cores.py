"""Call a function for many seeds, in two processes unless the tests already use all cores."""

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
    # Read by a process when it imports NumPy, whose threads would compete with the other process.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # Not forked, since a fork of a process that has run Qt may hang.
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        yield from pool.map(what, seeds, chunksize=5)
