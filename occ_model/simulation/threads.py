"""Work in threads, in which NumPy and OpenCV release the interpreter's lock while they compute."""

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
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


def each_in_threads(work: Callable[[_Item], _Result], items: Iterable[_Item]) -> Iterator[_Result]:
    """Do some work for each item in threads; yield the results in the order of the items.

    Items are read in the calling thread, a few in advance.
    """
    count, left = threads(), iter(items)
    begun = list(islice(left, 2 if count > 1 else 0))
    items = chain(begun, left)
    if len(begun) < 2:
        yield from map(work, items)
        return
    waiting: deque[Future[_Result]] = deque()
    pool = ThreadPoolExecutor(count, "band")
    try:
        for item in items:
            waiting.append(pool.submit(work, item))
            if len(waiting) > _ITEMS_AHEAD * count:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        pool.shutdown(cancel_futures=True)  # if the caller ends early, only what has begun is done
