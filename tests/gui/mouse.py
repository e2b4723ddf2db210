"""Turn the wheel over a plot, move the mouse and drag, as users do."""

from collections.abc import Sequence

import pyqtgraph as pg
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent, QWheelEvent
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


def move_mouse(viewport: QWidget, place: QPoint | QPointF) -> None:
    """Move the mouse to a place, no button down."""
    _send(viewport, QEvent.Type.MouseMove, QPointF(place))


def drag_mouse(viewport: QWidget, first: QPointF, last: QPointF) -> None:
    """Drag with the left button from one place to another, in five steps."""
    left, kinds = Qt.MouseButton.LeftButton, QEvent.Type
    move_mouse(viewport, first)
    _send(viewport, kinds.MouseButtonPress, first, left, left)
    for step in range(1, 6):
        _send(viewport, kinds.MouseMove, first + (last - first) * step / 5, held=left)
    _send(viewport, kinds.MouseButtonRelease, last, left)


def _send(
    viewport: QWidget,
    kind: QEvent.Type,
    place: QPointF,
    button: Qt.MouseButton = Qt.MouseButton.NoButton,
    held: Qt.MouseButton = Qt.MouseButton.NoButton,
) -> None:
    everywhere, no_key = QPointF(viewport.mapToGlobal(place)), Qt.KeyboardModifier.NoModifier
    event = QMouseEvent(kind, place, everywhere, button, held, no_key)
    QApplication.sendEvent(viewport, event)
