"""Turn the wheel over a plot, as its user does."""

from collections.abc import Sequence

import pyqtgraph as pg
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication, QWidget

_NOTCH = 120


def views_of(window: QWidget) -> Sequence[pg.GraphicsView]:
    """Give all plots and pictures of a window that a wheel zooms."""
    return [view for view in window.findChildren(pg.GraphicsView) if view.scene() is not None]


def turn_wheel(view: pg.GraphicsView, notches: int) -> None:
    """Turn the wheel over the middle of a plot, upwards to see less of it."""
    viewport = view.viewport()
    middle = QPointF(viewport.rect().center())
    turn = QPoint(0, _NOTCH if notches > 0 else -_NOTCH)
    for _ in range(abs(notches)):
        event = QWheelEvent(
            middle, QPointF(viewport.mapToGlobal(middle.toPoint())), QPoint(), turn,
            Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier,
            Qt.ScrollPhase.NoScrollPhase, False,
        )  # fmt: skip
        QApplication.sendEvent(viewport, event)
