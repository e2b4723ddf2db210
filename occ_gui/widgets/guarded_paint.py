"""Guarded paint methods: an exception while painting is reported and does not end the program."""

import sys
from collections.abc import Callable
from functools import wraps
from traceback import clear_frames
from typing import Any, TypeVar

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
