"""Drawing that fails leaves its place empty: an exception in it would end the program."""

import sys
from collections.abc import Callable
from functools import wraps
from traceback import clear_frames
from typing import Any, TypeVar

Paint = TypeVar("Paint", bound=Callable[..., None])


def guarded(paint: Paint) -> Paint:
    """Hand an exception of a drawing over as one that nobody has handled, and draw on.

    Parameters
    ----------
    paint
        A method that Qt calls to draw, such as ``paint`` or ``paintEvent``.
    """

    @wraps(paint)
    def draw(*arguments: Any) -> None:
        try:
            paint(*arguments)
        except Exception as error:  # noqa: BLE001 - what comes after Qt called is lost
            sys.excepthook(type(error), error, error.__traceback__)
            # A painter that is still at work when Qt goes on would end the program after all.
            clear_frames(error.__traceback__)

    return draw  # type: ignore[return-value]
