"""Work in threads, in which NumPy and OpenCV release the interpreter's lock while they compute."""

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from functools import lru_cache
from itertools import chain, islice
from typing import TypeVar

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")

_ITEMS_AHEAD = 2  # items that are prepared in advance for each thread


def threads() -> int:
    """Return the number of threads: one for each core, or fewer if OMP_NUM_THREADS says so."""
    cores = os.cpu_count() or 1
    wanted = os.environ.get("OMP_NUM_THREADS", "")
    return max(1, min(cores, int(wanted))) if wanted.isdecimal() else cores


@lru_cache
def _pool(count: int, purpose: str) -> ThreadPoolExecutor:
    # Kept for all pictures: OpenCV (5.0.0 and 4.12.0) keeps some 870 bytes of each thread that has
    # called one of its parallel functions, after the thread has ended.
    return ThreadPoolExecutor(count, purpose)


if hasattr(os, "register_at_fork"):  # a process that is forked has no threads but its first
    os.register_at_fork(after_in_child=_pool.cache_clear)


def each_in_threads(
    work: Callable[[_Item], _Result], items: Iterable[_Item], purpose: str = "expose"
) -> Iterator[_Result]:
    """Do some work for each item in threads; yield the results in the order of the items.

    Items are read in the calling thread, a few in advance. Work for another ``purpose`` has other
    threads, so that it does not wait for these items.
    """
    count, left = threads(), iter(items)
    begun = list(islice(left, 2 if count > 1 else 0))
    items = chain(begun, left)
    if len(begun) < 2:
        yield from map(work, items)
        return
    waiting: deque[Future[_Result]] = deque()
    pool = _pool(count, purpose)
    try:
        for item in items:
            waiting.append(pool.submit(work, item))
            if len(waiting) > _ITEMS_AHEAD * count:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:  # if the caller ends early, only what has begun is done
        wait([future for future in waiting if not future.cancel()])
