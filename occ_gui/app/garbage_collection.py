"""Cyclic garbage collection on the window's thread only, and return of freed memory.

By default Python collects on the thread that happens to allocate. If a worker thread
destroys a widget in this way, it waits for Qt's lock, while the window's thread, which may hold
that lock, waits for the interpreter: a deadlock.

The C library keeps the memory of freed pictures, a hundred megabytes after a few minutes of work.
It returns it on request, which takes some milliseconds.
"""

import ctypes
import gc
import time
from contextlib import suppress

from PySide6.QtCore import QObject, QTimer

_INTERVAL_MS = 250

_LEAST_IDLE_S = 2.0  # idle time in seconds after which memory is returned
_IDLE_FRACTION = 0.1  # largest fraction of one processor that an idle program uses

_LEAST_WORK_S = 1.0  # processor time in seconds since the last return that makes one worthwhile


def return_freed_memory() -> None:
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

    def exclude_present_objects(self) -> None:
        """Exclude the present objects from all collections until the window closes.

        Modules and widgets exist as long as the window; traversing them takes 40 ms.
        """
        gc.freeze()

    @staticmethod
    def include_all_objects() -> None:
        """Include the excluded objects again, when the window closes."""
        gc.unfreeze()

    def collect(self) -> None:
        """Collect the oldest generation whose threshold is exceeded, and return memory."""
        counts, limits = gc.get_count(), gc.get_threshold()
        generations = [n for n in range(3) if counts[n] > limits[n] > 0]
        if generations:
            gc.collect(generations[-1])
        self._return_memory_when_idle()

    def _return_memory_when_idle(self) -> None:
        """Return memory once after each period of work, when the program has become idle."""
        now, use = time.monotonic(), time.process_time()
        interval, work = now - self._last_time, use - self._last_use
        self._last_time, self._last_use = now, use
        self._work_time += work
        is_idle = work <= _IDLE_FRACTION * interval
        self._idle_time = self._idle_time + interval if is_idle else 0.0
        if self._idle_time >= _LEAST_IDLE_S and self._work_time >= _LEAST_WORK_S:
            gc.collect()
            return_freed_memory()
            self._work_time = 0.0
