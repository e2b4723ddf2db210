"""A cache of rows that depend only on the pose and the lens.

A slider changes one parameter at a time, so that gains and rims are often the same in one picture
after another.
"""

from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterable
from threading import Lock
from typing import Any, TypeVar

from numpy.typing import NDArray

_Object = TypeVar("_Object")

CAPACITY = 24 * 2**20  # most bytes in the cache: the rows of one large picture and of its draft

MOST_ENTRIES = 256
"""Most entries of the cache, which could otherwise hold thousands of small pictures. Each of these
takes as much memory again in objects other than arrays."""


class RowMemory:
    """Arrays by key, up to ``limit`` bytes; the least recently used are dropped first."""

    def __init__(self, limit: int, entries: int = MOST_ENTRIES) -> None:
        self.limit, self._entries = limit, entries
        self._lock = Lock()
        self.entries: OrderedDict[Hashable, tuple[Any, int]] = OrderedDict()
        self.size = 0

    def recall(
        self,
        key: Hashable,
        make: Callable[[], _Object],
        arrays: Callable[[_Object], Iterable[NDArray[Any]]],
    ) -> _Object:
        """Return a cached object, or make it; its ``arrays`` become read-only."""
        with self._lock:
            if key in self.entries:
                self.entries.move_to_end(key)
                cached_object: _Object = self.entries[key][0]
                return cached_object
        new_object = make()
        size = 0
        for array in arrays(new_object):
            array.flags.writeable = False
            size += array.nbytes
        with self._lock:
            if key not in self.entries and size <= self.limit:
                self.entries[key] = new_object, size
                self.size += size
            while self.size > self.limit or len(self.entries) > self._entries:
                self.size -= self.entries.popitem(last=False)[1][1]
        return new_object


MEMORY = RowMemory(CAPACITY)  # the cache of this process
