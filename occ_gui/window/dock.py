"""Dock of a pane: when it is floated, it lands beside its place."""

from PySide6.QtCore import QPoint, QRect, QSize, Signal
from PySide6.QtGui import QMoveEvent, QResizeEvent
from PySide6.QtWidgets import QDockWidget, QWidget

_STEP = 24  # pixels by which a floated pane is moved from its place, so that it is seen to float


def beside(place: QRect, screen: QRect) -> QRect:
    """Return where a pane floats that stood at a place: near it, and whole on the screen."""
    size = QSize(min(place.width(), screen.width()), min(place.height(), screen.height()))
    corner = place.topLeft() + QPoint(_STEP, _STEP)
    return QRect(
        QPoint(
            max(screen.left(), min(corner.x(), screen.right() + 1 - size.width())),
            max(screen.top(), min(corner.y(), screen.bottom() + 1 - size.height())),
        ),
        size,
    )


class Dock(QDockWidget):
    opened_by_user = Signal()  # its entry in the menu has shown it

    def __init__(self, name: str, title: str, content: QWidget, parent: QWidget) -> None:
        super().__init__(title, parent)
        self.setObjectName(name)
        self.setWidget(content)
        self._place = QRect()
        self.topLevelChanged.connect(self._on_floated)
        self.toggleViewAction().triggered.connect(self._on_switched)
        self.hide()  # until a mode lays it out

    def _on_switched(self, shown: bool) -> None:
        if shown:
            self.opened_by_user.emit()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._note_place()

    def moveEvent(self, event: QMoveEvent) -> None:  # noqa: N802 - Qt's name
        super().moveEvent(event)
        self._note_place()

    def _note_place(self) -> None:
        if not self.isFloating() and self.isVisible():
            self._place = QRect(self.mapToGlobal(QPoint()), self.size())

    def _on_floated(self, floats: bool) -> None:
        # Not while the mouse holds it.
        if floats and self._place.isValid() and QWidget.mouseGrabber() is not self:
            self.setGeometry(beside(self._place, self.screen().availableGeometry()))
