"""Look of a state: its colours, and an icon that shows the same by its shape."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from functools import cache

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPalette, QPen, QPolygonF
from PySide6.QtWidgets import QWidget

from occ_gui.widgets.guarded_paint import guarded

_ROLE = QPalette.ColorRole


class State(Enum):
    GOOD = "good"
    DOUBTFUL = "doubtful"
    WAITING = "waiting"
    BAD = "bad"
    NEUTRAL = "neutral"


@dataclass(frozen=True, slots=True)
class StateColours:
    ink: QColor
    paper: QColor


_COLOURS = {
    State.GOOD: (("#0b5c24", "#d6f0dc"), ("#98e8ae", "#143a20")),
    State.DOUBTFUL: (("#6b4500", "#fdedc8"), ("#ffd983", "#44340c")),
    State.WAITING: (("#6b4500", "#fdedc8"), ("#ffd983", "#44340c")),
    State.BAD: (("#8c1d18", "#fbdedb"), ("#ffb8b0", "#521a16")),
    State.NEUTRAL: (("#2b2b2b", "#e2e4e8"), ("#ececec", "#4a4d52")),
}
"""Colours of text and background, in the light and in the dark theme."""


def is_dark(palette: QPalette) -> bool:
    """Return whether a palette has light text on a dark background."""
    text, window = palette.color(_ROLE.WindowText), palette.color(_ROLE.Window)
    return text.lightness() > window.lightness()


def colours_of(state: State, palette: QPalette) -> StateColours:
    return _colours(state, is_dark(palette))


@cache
def _colours(state: State, dark: bool) -> StateColours:
    ink, paper = _COLOURS[state][dark]
    return StateColours(QColor(ink), QColor(paper))


def draw_state(painter: QPainter, place: QRectF, state: State, colours: StateColours) -> None:
    """Draw the icon of a state: tick, cross, exclamation mark, clock or the letter i."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.translate(place.center())
    side = min(place.width(), place.height())
    painter.scale(side / 24.0, side / 24.0)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(colours.ink)
    painter.drawPolygon(_BADGES[state]) if state in _BADGES else painter.drawEllipse(
        QRectF(-11, -11, 22, 22)
    )
    painter.setPen(QPen(colours.paper, 2.8, c=Qt.PenCapStyle.RoundCap, j=Qt.PenJoinStyle.RoundJoin))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    _SIGNS[state](painter)
    painter.restore()


def _polygon(*points: tuple[float, float]) -> QPolygonF:
    return QPolygonF([QPointF(x, y) for x, y in points])


_BADGES = {
    State.BAD: _polygon(
        (-4.6, -11), (4.6, -11), (11, -4.6), (11, 4.6), (4.6, 11), (-4.6, 11), (-11, 4.6),
        (-11, -4.6),
    ),
    State.DOUBTFUL: _polygon((0, -11), (12, 10.5), (-12, 10.5)),
}  # fmt: skip
"""Outlines other than a circle."""


def _tick(painter: QPainter) -> None:
    painter.drawPolyline(_polygon((-5, 0.5), (-1.3, 4.2), (5.2, -3.8)))


def _cross(painter: QPainter) -> None:
    painter.drawLine(QPointF(-4, -4), QPointF(4, 4))
    painter.drawLine(QPointF(-4, 4), QPointF(4, -4))


def _exclamation(painter: QPainter) -> None:
    painter.drawLine(QPointF(0, -3.5), QPointF(0, 2.5))
    painter.drawPoint(QPointF(0, 7))


def _clock(painter: QPainter) -> None:
    painter.drawPolyline(_polygon((0, -6), (0, 0), (4, 2.5)))


def _letter(painter: QPainter) -> None:
    painter.drawPoint(QPointF(0, -5.5))
    painter.drawLine(QPointF(0, -0.5), QPointF(0, 5.5))


_SIGNS: dict[State, Callable[[QPainter], None]] = {
    State.GOOD: _tick,
    State.BAD: _cross,
    State.DOUBTFUL: _exclamation,
    State.WAITING: _clock,
    State.NEUTRAL: _letter,
}


class StateIcon(QWidget):
    def __init__(self, side: int) -> None:
        super().__init__()
        self.state = State.NEUTRAL
        self.setFixedSize(QSize(side, side))

    def show_state(self, state: State) -> None:
        if state is not self.state:
            self.state = state
            self.update()

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        painter = QPainter(self)
        draw_state(painter, QRectF(self.rect()), self.state, colours_of(self.state, self.palette()))
