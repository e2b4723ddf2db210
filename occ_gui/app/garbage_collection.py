"""Python's cyclic garbage, collected on the window's thread only.

Python collects on whichever thread happens to allocate. A worker that so destroys a widget waits
for Qt's lock, which the window's thread may hold while it waits for the interpreter: for ever.
"""

import gc

from PySide6.QtCore import QObject, QTimer

_TURN_MS = 250


class GarbageCollector(QObject):
    """Collects by Python's own rules, but only here and from time to time.

    Parameters
    ----------
    parent
        Its owner, which lives as long as the window.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
        self._turns = QTimer(self)
        self._turns.timeout.connect(self.collect)
        self._turns.start(_TURN_MS)

    def spare(self) -> None:
        """Leave out of every collection, until the window closes, what is there now.

        Modules and widgets stay as long as the window does: looking through them takes 40 ms.
        """
        gc.freeze()

    @staticmethod
    def release() -> None:
        """Collect again what was spared, now that the window is closing."""
        gc.unfreeze()

    def collect(self) -> None:
        """Collect the oldest generation whose turn it is, if any's is."""
        counts, limits = gc.get_count(), gc.get_threshold()
        due = [old for old in range(3) if counts[old] > limits[old] > 0]
        if due:
            gc.collect(due[-1])
