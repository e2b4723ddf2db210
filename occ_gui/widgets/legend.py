"""Legend beside a plot, where it does not cover any curve."""

from collections.abc import Callable
from typing import TypeAlias

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QHBoxLayout, QLabel, QWidget

from occ_gui.widgets.contrast import pen_on
from occ_gui.widgets.guarded_paint import guarded

_LINE = QSize(24, 12)

Drawing: TypeAlias = Callable[[QPainter, QRectF, QPalette], None]
"""Draws a sample into a rectangle in the colours of a palette."""


class LineLegend(QWidget):
    def __init__(self) -> None:
        super().__init__()
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._entries: dict[str, QWidget] = {}

    def add_line(self, key: str, pen: QPen, text: str) -> None:
        """Add an entry, shown until :meth:`show_line` hides it."""
        thick = QPen(pen)
        thick.setWidth(max(2, pen.width()))
        thick.setCosmetic(False)  # as wide as the curve at any scale of the screen

        def draw(painter: QPainter, place: QRectF, palette: QPalette) -> None:
            middle = place.center().y()
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
            painter.setPen(pen_on(palette, thick))
            painter.drawLine(QPointF(place.left(), middle), QPointF(place.right(), middle))

        self.add_sample(key, draw, _LINE, text)

    def add_sample(
        self, key: str, draw: Drawing, size: QSize, text: str, meaning: str = ""
    ) -> None:
        entry = QWidget(toolTip=meaning)
        layout = QHBoxLayout(entry)
        layout.setContentsMargins(0, 0, 6, 0)
        layout.addWidget(Sample(draw, size), 0, Qt.AlignmentFlag.AlignVCenter)
        layout.addWidget(QLabel(text))
        self._row.addWidget(entry)
        self._entries[key] = entry

    def show_line(self, key: str, visible: bool) -> None:
        self._entries[key].setVisible(visible)


class Sample(QWidget):
    """The sample of a line or a point, which follows the palette and the scale of the screen."""

    def __init__(self, draw: Drawing, size: QSize) -> None:
        super().__init__()
        self._draw = draw
        self.setFixedSize(size)

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._draw(painter, QRectF(self.rect()), self.palette())
        painter.end()
