"""Cells of chips: filled where the LED is on, with their digits."""

from collections.abc import Sequence
from functools import cache

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPalette, QPen, QStaticText

from occ_gui.widgets.contrast import seen_on

_LEAST_FOR_DIGIT = 9
"""Pixels of a chip from which its digit is drawn."""

_FADED = 0.45


@cache
def _digit(value: int) -> QStaticText:
    text = QStaticText(str(value))
    text.setTextFormat(Qt.TextFormat.PlainText)
    return text


def draw_digits(
    painter: QPainter, cells: Sequence[tuple[int, QRectF]], least: float = _LEAST_FOR_DIGIT
) -> None:
    """Write each chip's digit into the middle of its cell, if that is wide enough."""
    size = painter.fontMetrics().size(0, "0")
    width, height = size.width(), size.height()
    for chip, cell in cells:
        if cell.width() >= least:
            place = QPointF(
                cell.left() + (cell.width() - width) / 2, cell.top() + (cell.height() - height) / 2
            )
            painter.drawStaticText(place, _digit(chip))


def draw_chips(
    painter: QPainter,
    cells: Sequence[tuple[int, QRectF]],
    colour: QColor,
    palette: QPalette,
    certain: bool = True,
) -> None:
    """Draw chips, each a 0 or 1 with its place; those that are not certain are faded.

    Digits stay readable: on a faded cell the colour of text is seen, whatever it is.
    """
    lit = seen_on(palette, colour)
    base, text = (
        palette.color(role) for role in (QPalette.ColorRole.Base, QPalette.ColorRole.Text)
    )
    for value in (0, 1):
        some = [(chip, cell) for chip, cell in cells if chip == value]
        painter.setOpacity(1.0 if certain else _FADED)
        painter.setPen(QPen(lit))
        painter.setBrush(lit if value else base)
        painter.drawRects([cell for _, cell in some])
        painter.setOpacity(1.0)
        painter.setPen(base if value and certain else text)
        draw_digits(painter, some)
