"""Paint methods whose exceptions are reported, and a comparison that avoids needless painting."""

import sys
from collections.abc import Callable, Sequence
from functools import wraps
from traceback import clear_frames
from typing import Any, TypeVar

import numpy as np

Paint = TypeVar("Paint", bound=Callable[..., None])


def guarded(paint: Paint) -> Paint:
    """Report an exception of a paint method like an unhandled exception, and continue."""

    @wraps(paint)
    def draw(*arguments: Any) -> None:
        try:
            paint(*arguments)
        except Exception as error:  # noqa: BLE001 - Qt cannot handle exceptions
            sys.excepthook(type(error), error, error.__traceback__)
            # A painter that is still active when Qt continues would crash the program.
            clear_frames(error.__traceback__)

    return draw  # type: ignore[return-value]


def are_equal(first: Sequence[object], second: Sequence[object]) -> bool:
    """Return whether two lists of values are equal, with arrays compared element by element."""
    return len(first) == len(second) and all(map(_is_equal, first, second))


def _is_equal(first: object, second: object) -> bool:
    if first is second:
        return True
    if isinstance(first, np.ndarray) and isinstance(second, np.ndarray):
        return bool(np.array_equal(first, second))
    if isinstance(first, np.ndarray) or isinstance(second, np.ndarray):
        return False
    return first == second
