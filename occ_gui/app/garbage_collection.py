"""Cyclic garbage collection on the window's thread only, and return of freed memory.

By default Python collects on the thread that happens to allocate. If a worker thread so destroys a
widget, it waits for Qt's lock, while the window's thread, which may hold that lock, waits for the
interpreter: a deadlock.

The C library keeps the memory of freed pictures, a hundred megabytes after a few minutes of work.
It returns it on request, which takes some milliseconds.
"""

import ctypes
import gc
import time
from contextlib import suppress

from PySide6.QtCore import QObject, QTimer

_INTERVAL_MS = 250

_REST_S = 2.0  # how long the program is idle before memory is returned
_IDLE_FRACTION = 0.1  # largest fraction of a processor that an idle program uses

_WORTH_S = 1.0  # least processor time of work, in seconds, after which memory is returned


def give_memory_back() -> None:
    """Return freed memory to the system, where the C library is GNU's."""
    with suppress(OSError, AttributeError):
        ctypes.CDLL("libc.so.6").malloc_trim(0)


class GarbageCollector(QObject):
    """Collects by Python's own thresholds, on this thread and at regular intervals."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
        self._last_time, self._last_use = time.monotonic(), time.process_time()
        self._idle_time = self._work_time = 0.0
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.collect)
        self._timer.start(_INTERVAL_MS)

    def spare(self) -> None:
        """Exclude the present objects from all collections until the window closes.

        Modules and widgets exist as long as the window; traversing them takes 40 ms.
        """
        gc.freeze()

    @staticmethod
    def release() -> None:
        """Include the excluded objects again, when the window closes."""
        gc.unfreeze()

    def collect(self) -> None:
        """Collect the oldest generation whose threshold is exceeded, and return memory."""
        counts, limits = gc.get_count(), gc.get_threshold()
        due = [old for old in range(3) if counts[old] > limits[old] > 0]
        if due:
            gc.collect(due[-1])
        self._return_memory()

    def _return_memory(self) -> None:
        """Return memory once after each period of work, when the program has become idle."""
        now, use = time.monotonic(), time.process_time()
        interval, work = now - self._last_time, use - self._last_use
        self._last_time, self._last_use = now, use
        self._work_time += work
        is_idle = work <= _IDLE_FRACTION * interval
        self._idle_time = self._idle_time + interval if is_idle else 0.0
        if self._idle_time >= _REST_S and self._work_time >= _WORTH_S:
            gc.collect()
            give_memory_back()
            self._work_time = 0.0
