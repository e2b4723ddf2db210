"""Cyclic garbage collection on the window's thread only.

By default Python collects on the thread that happens to allocate. If a worker thread so destroys a
widget, it waits for Qt's lock, while the window's thread, which may hold that lock, waits for the
interpreter: a deadlock.
"""

import gc

from PySide6.QtCore import QObject, QTimer

_INTERVAL_MS = 250


class GarbageCollector(QObject):
    """Collects by Python's own thresholds, on this thread and at regular intervals.

    Parameters
    ----------
    parent
        The owner, which exists as long as the window.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
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
        """Collect the oldest generation whose threshold is exceeded, if there is one."""
        counts, limits = gc.get_count(), gc.get_threshold()
        due = [old for old in range(3) if counts[old] > limits[old] > 0]
        if due:
            gc.collect(due[-1])
