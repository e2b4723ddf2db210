"""A cache of rows that depend only on the pose and the lens.

A slider changes one parameter at a time, so that gains and rims are often the same in one picture
after another.
"""

from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterable
from threading import Lock
from typing import Any, TypeVar

from numpy.typing import NDArray

_Made = TypeVar("_Made")

CAPACITY = 24 * 2**20  # most bytes in the cache: the rows of one large picture and of its draft

MOST_ENTRIES = 256
"""Most entries of the cache, which could otherwise hold thousands of small pictures. Each of these
takes as much memory again in objects other than arrays."""


class RowMemory:
    """Arrays by key, up to ``limit`` bytes; the least recently used are dropped first."""

    def __init__(self, limit: int, entries: int = MOST_ENTRIES) -> None:
        self.limit, self._entries = limit, entries
        self._lock = Lock()
        self.known: OrderedDict[Hashable, tuple[Any, int]] = OrderedDict()
        self.size = 0

    def recall(
        self,
        key: Hashable,
        make: Callable[[], _Made],
        arrays: Callable[[_Made], Iterable[NDArray[Any]]],
    ) -> _Made:
        """Return a cached object, or make it; its ``arrays`` become read-only."""
        with self._lock:
            if key in self.known:
                self.known.move_to_end(key)
                found: _Made = self.known[key][0]
                return found
        made = make()
        size = 0
        for array in arrays(made):
            array.flags.writeable = False
            size += array.nbytes
        with self._lock:
            if key not in self.known and size <= self.limit:
                self.known[key] = made, size
                self.size += size
            while self.size > self.limit or len(self.known) > self._entries:
                self.size -= self.known.popitem(last=False)[1][1]
        return made


MEMORY = RowMemory(CAPACITY)  # the cache of this process
