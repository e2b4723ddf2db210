"""Paint methods whose exceptions are reported, and a comparison that saves painting."""

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
        except Exception as error:  # noqa: BLE001 - Qt cannot handle any
            sys.excepthook(type(error), error, error.__traceback__)
            # A painter that is still active when Qt continues would crash the program.
            clear_frames(error.__traceback__)

    return draw  # type: ignore[return-value]


def are_same(ones: Sequence[object], others: Sequence[object]) -> bool:
    """Return whether two lists of values are equal, with arrays compared element by element."""
    return len(ones) == len(others) and all(map(_is_same, ones, others))


def _is_same(one: object, other: object) -> bool:
    if one is other:
        return True
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return bool(np.array_equal(one, other))
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return False
    return one == other
