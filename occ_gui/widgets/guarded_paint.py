"""Painting whose exceptions are reported, and a comparison that avoids needless painting."""

import sys
from collections.abc import Callable, Sequence
from functools import wraps
from traceback import clear_frames
from typing import Any, TypeVar

import numpy as np
from PySide6.QtCore import QSize
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

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


class PaintedWidget(QWidget):
    """A widget that :meth:`paint_with` draws, and that asks for its least size."""

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        self.paint_with(QPainter(self))

    def paint_with(self, painter: QPainter) -> None:
        raise NotImplementedError

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return self.minimumSizeHint()


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
