"""Cell of a chip: filled where the LED is on, with its digit."""

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPalette, QPen

from occ_gui.widgets.contrast import seen_on

_LEAST_FOR_DIGIT = 9
"""Pixels of a chip from which its digit is drawn."""

_FADED = 0.45


def draw_chip(
    painter: QPainter,
    cell: QRectF,
    chip: int,
    colour: QColor,
    palette: QPalette,
    *,
    certain: bool = True,
) -> None:
    """Draw a chip; one that is not certain is faded.

    Digits stay readable: on a faded cell the colour of text is seen, whatever it is.
    """
    lit = seen_on(palette, colour)
    painter.setOpacity(1.0 if certain else _FADED)
    painter.setPen(QPen(lit))
    painter.setBrush(lit if chip else palette.color(QPalette.ColorRole.Base))
    painter.drawRect(cell)
    painter.setOpacity(1.0)
    if cell.width() >= _LEAST_FOR_DIGIT:
        role = QPalette.ColorRole.Base if chip and certain else QPalette.ColorRole.Text
        painter.setPen(palette.color(role))
        painter.drawText(cell, Qt.AlignmentFlag.AlignCenter, str(chip))
