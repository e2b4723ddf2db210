"""Cells of header and bits, drawn under the columns that carry them."""

from collections.abc import Iterable

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetrics, QPainter, QPalette, QPen

from occ_gui.widgets.state_look import State, colours_of

HEADER = ("header", "H")  # names of a header, the shorter one for narrow cells

_MARKS = {State.GOOD: " ✓", State.BAD: " ✗"}
_PADDING = 4  # pixels of a cell that no text covers


def have_room_for_marks(metrics: QFontMetrics, widths: Iterable[float]) -> bool:
    """Return whether the mark of a bit fits into each cell: a row has all of them or none."""
    widest = max(metrics.horizontalAdvance(bit + mark) for bit in "01" for mark in _MARKS.values())
    return all(widest <= width - _PADDING for width in widths)


def have_room_for_bits(metrics: QFontMetrics, widths: Iterable[float]) -> bool:
    """Return whether a digit fits into each cell: a row has all of them or none."""
    widest = max(map(metrics.horizontalAdvance, "01"))
    return all(widest <= width for width in widths)


def draw_field(  # noqa: PLR0913 - what is drawn, where and how
    painter: QPainter,
    cell: QRectF,
    texts: tuple[str, ...],
    palette: QPalette,
    *,
    is_header: bool = False,
    state: State = State.NEUTRAL,
    is_marked: bool = False,
    has_text: bool | None = None,
    within: QRectF | None = None,
) -> None:
    """Draw a header or a bit as a rounded cell; a wrong one is crossed out.

    ``texts``: the bit, or what the header is called; the first text that fits is drawn.
    ``has_text``: whether a text is drawn, even if none fits; None: only one that fits.
    ``within``: the visible area; the text is centred in the part of the cell within it.
    """
    colours = colours_of(state, palette)
    inner = cell.adjusted(1, 0.5, -1, -0.5)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(colours.ink, 2 if state is State.BAD else 1))
    painter.setBrush(Qt.BrushStyle.NoBrush if is_header else colours.paper)
    painter.drawRoundedRect(inner, 3, 3)
    metrics = painter.fontMetrics()
    mark = _MARKS.get(state, "") if is_marked else ""
    painter.setPen(colours.ink if not is_header else palette.color(QPalette.ColorRole.Text))
    visible = inner if within is None else inner.intersected(within)
    available_width = visible.width() - _PADDING + 2  # a cell is 2 pixels wider than inside
    fitting = (
        label
        for label in (texts[0] + mark, *texts)
        if metrics.horizontalAdvance(label) <= available_width
    )
    text = "" if has_text is False else next(fitting, texts[-1] if has_text else "")
    if text:
        # Two pixels wider, so that a text as wide as its cell is not cut.
        painter.drawText(visible.adjusted(-2, 0, 2, 0), Qt.AlignmentFlag.AlignCenter, text)
    if state is State.BAD:
        painter.setPen(QPen(colours.ink, 1.5))
        painter.drawLine(QPointF(inner.bottomLeft()), QPointF(inner.topRight()))
