"""Turn the wheel over a plot, as its user does."""

from collections.abc import Sequence

import pyqtgraph as pg
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication, QWidget

_NOTCH = 120


def views_of(window: QWidget) -> Sequence[pg.GraphicsView]:
    """Return all plots and pictures of a window that a wheel zooms."""
    return [view for view in window.findChildren(pg.GraphicsView) if view.scene() is not None]


def turn_wheel(view: pg.GraphicsView, notches: int) -> None:
    """Turn the wheel over the middle of a plot, upwards to see less of it."""
    viewport = view.viewport()
    for _ in range(abs(notches)):
        turn_wheel_at(viewport, viewport.rect().center(), notches > 0)


def turn_wheel_at(widget: QWidget, place: QPoint, is_upwards: bool = True) -> None:
    """Turn the wheel by a notch over a place of a widget."""
    turn = QPoint(0, _NOTCH if is_upwards else -_NOTCH)
    event = QWheelEvent(
        QPointF(place), QPointF(widget.mapToGlobal(place)), QPoint(), turn,
        Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(widget, event)
