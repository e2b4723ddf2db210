"""Chips as cells, filled where the LED is on, with their digits."""

from collections.abc import Sequence
from functools import cache

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPalette, QPen, QStaticText

from occ_gui.widgets.colours import lighten_for

_LEAST_DIGIT_WIDTH = 7.5

_MIN_FITTING_FRACTION = 0.6  # least fraction of cells with room for a digit
_LEAST_CONDENSED = 0.5  # least width of a digit in a narrow cell, as a fraction of its usual width

_FADED_OPACITY = 0.45


@cache
def _make_digit(value: float) -> QStaticText:
    text = QStaticText(f"{value:g}")
    text.setTextFormat(Qt.TextFormat.PlainText)
    return text


def draw_digits(
    painter: QPainter, cells: Sequence[tuple[int, QRectF]], within: QRectF | None = None
) -> None:
    """Write the digit of each chip into its cell, if it has room ``within`` the visible area.

    In a cell that is narrower than most, the digit is condensed.
    """
    size = painter.fontMetrics().size(0, "0")
    width, height = size.width(), size.height()
    for chip, cell in cells:
        left = cell.left() + (cell.width() - width) / 2
        if within is not None and not within.left() <= left <= within.right() - width:
            continue
        top = cell.top() + (cell.height() - height) / 2
        if cell.width() >= _LEAST_DIGIT_WIDTH:
            painter.drawStaticText(QPointF(left, top), _make_digit(chip))
            continue
        painter.save()
        painter.translate(cell.center().x(), top)
        painter.scale(cell.width() / _LEAST_DIGIT_WIDTH, 1.0)
        painter.drawStaticText(QPointF(-width / 2, 0.0), _make_digit(chip))
        painter.restore()


def have_room_for_digits(cells: Sequence[tuple[int, QRectF]]) -> bool:
    """Return whether most cells have room for a digit, and all for a condensed one.

    If not, no digit is drawn.
    """
    widths = [cell.width() for _, cell in cells]
    fitting_count = sum(width >= _LEAST_DIGIT_WIDTH for width in widths)
    is_readable = min(widths, default=0.0) >= _LEAST_CONDENSED * _LEAST_DIGIT_WIDTH
    return is_readable and fitting_count >= _MIN_FITTING_FRACTION * len(cells)


def draw_chips(
    painter: QPainter,
    cells: Sequence[tuple[int, QRectF]],
    colour: QColor,
    palette: QPalette,
    certain: bool = True,
    within: QRectF | None = None,
) -> None:
    """Draw chips; uncertain chips are faded, with digits in the colour of text."""
    ink = lighten_for(palette, colour)
    base, text = (
        palette.color(role) for role in (QPalette.ColorRole.Base, QPalette.ColorRole.Text)
    )
    with_digits = have_room_for_digits(cells)
    for value in (0, 1):
        equal_chips = [(chip, cell) for chip, cell in cells if chip == value]
        painter.setOpacity(1.0 if certain else _FADED_OPACITY)
        painter.setPen(QPen(ink))
        painter.setBrush(ink if value else base)
        painter.drawRects([cell for _, cell in equal_chips])
        painter.setOpacity(1.0)
        painter.setPen(base if value and certain else text)
        if with_digits:
            draw_digits(painter, equal_chips, within)
