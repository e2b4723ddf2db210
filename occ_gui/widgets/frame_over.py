"""A frame drawn over any widget, which does not receive mouse events."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, QRect, Qt
from PySide6.QtGui import QColor, QPainter, QPalette, QPen
from PySide6.QtWidgets import QWidget

from occ_gui.widgets.guarded_paint import PaintedWidget

_WIDTH = 2


class FrameOver(PaintedWidget):
    """A frame in ``parent`` at the rectangle ``place()``, updated when ``watched`` moves."""

    def __init__(
        self,
        parent: QWidget,
        watched: QWidget,
        place: Callable[[], QRect],
        colour: Callable[[QPalette], QColor],
        radius: int = 0,
    ) -> None:
        super().__init__(parent)
        self._place, self._colour, self._radius = place, colour, radius
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        watched.installEventFilter(self)
        self.setGeometry(place())

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        if event.type() in (QEvent.Type.Move, QEvent.Type.Resize):
            self.setGeometry(self._place())
            self.raise_()
        return False

    def paint_with(self, painter: QPainter) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, self._radius > 0)
        painter.setPen(QPen(self._colour(self.palette()), _WIDTH))
        edge = self.rect().adjusted(1, 1, -1, -1)
        painter.drawRoundedRect(edge, self._radius, self._radius)
