"""Numbers for the user's gestures: what belongs to one gesture is undone as one step."""

from itertools import count

from PySide6.QtCore import QElapsedTimer

NO_GESTURE = -1
"""A change that belongs to no gesture and is a step of its own."""

_PAUSE_MS = 700
"""A longer pause between two changes of a control ends a gesture."""

_numbers = count()


def new_gesture() -> int:
    """Return a number that no gesture has had."""
    return next(_numbers)


class Gestures:
    """Tells which gesture each change of one control belongs to.

    Changes that follow each other quickly, as by keys, by arrows or by the wheel, are one gesture.
    """

    def __init__(self) -> None:
        self._number = NO_GESTURE
        self._since_change = QElapsedTimer()

    def end(self) -> None:
        """Let the next change begin a gesture, however soon it comes, as what is typed does."""
        self._since_change.invalidate()

    def of_change(self, held: bool = False) -> int:
        """Return the gesture of a change made now; no pause parts those made while held."""
        goes_on = self._since_change.isValid() and (
            held or not self._since_change.hasExpired(_PAUSE_MS)
        )
        if not goes_on:
            self._number = new_gesture()
        self._since_change.start()
        return self._number
