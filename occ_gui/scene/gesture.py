"""Gestures: changes of a control that belong together and are undone as one step."""

from itertools import count

from PySide6.QtCore import QElapsedTimer

from occ_gui.core.store import NO_GESTURE

_PAUSE_MS = 700  # a longer pause between two changes of a control ends a gesture

_numbers = count()


def new_gesture() -> int:
    return next(_numbers)


class Gestures:
    """Assigns the changes of one control to gestures.

    Changes in quick succession, as by keys, arrows or the wheel, are one gesture.
    """

    def __init__(self) -> None:
        self._number = NO_GESTURE
        self._since_change = QElapsedTimer()

    def end(self) -> None:
        """Let the next change begin a new gesture, however soon it follows."""
        self._since_change.invalidate()

    def of_change(self, held: bool = False) -> int:
        """Return the gesture of a change made now; while held, a pause does not end a gesture."""
        goes_on = self._since_change.isValid() and (
            held or not self._since_change.hasExpired(_PAUSE_MS)
        )
        if not goes_on:
            self._number = new_gesture()
        self._since_change.start()
        return self._number
