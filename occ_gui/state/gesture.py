"""Numbers for the user's gestures: what belongs to one gesture is undone as one step."""

from itertools import count

NO_GESTURE = -1
"""A change that belongs to no gesture and is a step of its own."""

_numbers = count()


def new_gesture() -> int:
    """Return a number that no gesture has had."""
    return next(_numbers)
