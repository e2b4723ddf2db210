"""Chips as cells, filled where the LED is on, with their digits."""

from collections.abc import Sequence
from functools import cache

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPalette, QPen, QStaticText

from occ_gui.widgets.colours import lighten_for

_LEAST_DIGIT_WIDTH = 7.5

_MIN_FITTING_FRACTION = 0.6
"""Least fraction of cells with room for a digit; cells at the edges may be cut off."""

_FADED_OPACITY = 0.45


@cache
def _digit_text(value: float) -> QStaticText:
    text = QStaticText(f"{value:g}")
    text.setTextFormat(Qt.TextFormat.PlainText)
    return text


def draw_digits(
    painter: QPainter, cells: Sequence[tuple[int, QRectF]], within: QRectF | None = None
) -> None:
    """Write the digit of each chip into its cell, if it has room ``within`` the visible area."""
    size = painter.fontMetrics().size(0, "0")
    width, height = size.width(), size.height()
    for chip, cell in cells:
        left = cell.left() + (cell.width() - width) / 2
        is_in_view = within is None or within.left() <= left <= within.right() - width
        if cell.width() >= _LEAST_DIGIT_WIDTH and is_in_view:
            top = cell.top() + (cell.height() - height) / 2
            painter.drawStaticText(QPointF(left, top), _digit_text(chip))


def have_room_for_digits(cells: Sequence[tuple[int, QRectF]]) -> bool:
    """Return whether most cells have room for a digit; if not, no digit is drawn."""
    fitting_count = sum(cell.width() >= _LEAST_DIGIT_WIDTH for _, cell in cells)
    return fitting_count >= _MIN_FITTING_FRACTION * len(cells)


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
