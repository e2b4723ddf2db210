"""Look of a mark: its colour, pattern and height all say whether it was read."""

from dataclasses import dataclass

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPalette, QPen

from occ_gui.video.film_reading import MarkState
from occ_gui.widgets.plot import DrawSample, LineLegend
from occ_gui.widgets.state_look import State, colours_of


@dataclass(frozen=True, slots=True)
class MarkLook:
    state: State
    pattern: Qt.BrushStyle
    height: float  # as a fraction of its row; tells states apart where marks are too narrow
    name: str
    meaning: str
    spoken: str  # what a screen reader says about a frame


_Pattern = Qt.BrushStyle
LOOKS = {
    MarkState.READ: MarkLook(
        State.GOOD, _Pattern.SolidPattern, 1.0, "read",
        "A frame with a known place, or a packet that agrees with all others.", "read",
    ),
    MarkState.UNCHECKED: MarkLook(
        State.DOUBTFUL, _Pattern.Dense5Pattern, 0.65, "not checked",
        "Read, but it is unknown whether it is right, or where it belongs.", "read, not checked",
    ),
    MarkState.LOST: MarkLook(
        State.BAD, _Pattern.BDiagPattern, 0.35, "lost", "Not read, or misread.", "lost"
    ),
    MarkState.PENDING: MarkLook(
        State.NEUTRAL, _Pattern.NoBrush, 1.0, "to come", "Not examined yet.", "not examined yet"
    ),
}  # fmt: skip
"""In the order of the legend."""

_SAMPLE = QSize(16, 14)
_LEAST_OUTLINE = 4.0  # least width in pixels of a mark that is drawn with an outline


def brush_of(state: MarkState, palette: QPalette) -> QBrush:
    """Return the brush for marks of a state; an empty brush for frames to come."""
    return QBrush(colours_of(LOOKS[state].state, palette).ink, LOOKS[state].pattern)


def draw_mark(painter: QPainter, place: QRectF, state: MarkState, palette: QPalette) -> None:
    height = place.height() * LOOKS[state].height
    bar = QRectF(place.left(), place.bottom() - height, place.width(), height)
    brush = brush_of(state, palette)
    ink = brush.color()
    if state is MarkState.PENDING:
        line = QColor(ink)
        line.setAlpha(110)
        painter.setPen(QPen(line, 1))
        painter.setBrush(Qt.BrushStyle.NoBrush)
    else:
        is_wide = bar.width() >= _LEAST_OUTLINE
        painter.setPen(QPen(ink, 1) if is_wide else Qt.PenStyle.NoPen)
        painter.setBrush(brush if is_wide else QBrush(ink))
    if bar.width() >= _LEAST_OUTLINE:
        bar.adjust(0.5, 0.5, -0.5, -0.5)
    painter.drawRect(bar)


class MarkLegend(LineLegend):
    def __init__(self) -> None:
        super().__init__()
        self.setAccessibleName("Legend of the timeline")
        for state, look in LOOKS.items():
            self.add_sample(state.name, _sample_of(state), _SAMPLE, look.name, look.meaning)


def _sample_of(state: MarkState) -> DrawSample:
    def draw(painter: QPainter, place: QRectF, palette: QPalette) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        draw_mark(painter, place, state, palette)

    return draw
