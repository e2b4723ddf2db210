"""Look of a mark: colour, pattern and height together say whether it was read."""

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPalette, QPen

from occ_gui.video.film_reading import MarkState
from occ_gui.widgets.legend import Drawing, LineLegend
from occ_gui.widgets.state_look import State, colours_of

HEIGHTS = {
    MarkState.PENDING: 1.0,
    MarkState.READ: 1.0,
    MarkState.UNCHECKED: 0.65,
    MarkState.LOST: 0.35,
}
"""Height of a mark in parts of its row: it tells the states apart where patterns are too fine."""

_STATES = {
    MarkState.PENDING: State.NEUTRAL,
    MarkState.READ: State.GOOD,
    MarkState.UNCHECKED: State.DOUBTFUL,
    MarkState.LOST: State.BAD,
}
_PATTERNS = {
    MarkState.READ: Qt.BrushStyle.SolidPattern,
    MarkState.UNCHECKED: Qt.BrushStyle.Dense5Pattern,
    MarkState.LOST: Qt.BrushStyle.BDiagPattern,
}
_SAMPLE = QSize(16, 14)
_LEAST_OUTLINE = 4.0  # least width in pixels of a mark that is drawn with an outline


def ink_of(state: MarkState, palette: QPalette) -> QColor:
    return colours_of(_STATES[state], palette).ink


def brush_of(state: MarkState, palette: QPalette) -> QBrush:
    """Return the pattern of a state's marks in its colour; none where it is to come."""
    return QBrush(ink_of(state, palette), _PATTERNS.get(state, Qt.BrushStyle.NoBrush))


def draw_mark(painter: QPainter, place: QRectF, state: MarkState, palette: QPalette) -> None:
    height = place.height() * HEIGHTS[state]
    bar = QRectF(place.left(), place.bottom() - height, place.width(), height)
    ink = ink_of(state, palette)
    if state is MarkState.PENDING:
        line = QColor(ink)
        line.setAlpha(110)
        painter.setPen(QPen(line, 1))
        painter.setBrush(Qt.BrushStyle.NoBrush)
    else:
        is_wide = bar.width() >= _LEAST_OUTLINE
        painter.setPen(QPen(ink, 1) if is_wide else Qt.PenStyle.NoPen)
        painter.setBrush(brush_of(state, palette) if is_wide else QBrush(ink))
    if bar.width() >= _LEAST_OUTLINE:
        bar.adjust(0.5, 0.5, -0.5, -0.5)
    painter.drawRect(bar)


class MarkLegend(LineLegend):
    def __init__(self) -> None:
        super().__init__()
        self.setAccessibleName("Legend of the timeline")
        texts = {
            MarkState.READ: (
                "read",
                "A frame whose place is known; a packet as all others have it.",
            ),
            MarkState.UNCHECKED: (
                "not checked",
                "Read, but nothing says whether it is right, or where it belongs.",
            ),
            MarkState.LOST: ("lost", "Not read, or read wrong."),
            MarkState.PENDING: ("to come", "Not looked at yet."),
        }  # fmt: skip
        for state, (text, meaning) in texts.items():
            self.add_sample(state.name, _sample_of(state), _SAMPLE, text, meaning)


def _sample_of(state: MarkState) -> Drawing:
    def draw(painter: QPainter, place: QRectF, palette: QPalette) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        draw_mark(painter, place, state, palette)

    return draw
