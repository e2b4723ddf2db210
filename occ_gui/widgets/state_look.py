"""The look of states: colours, patterns and marks, and rows of badges."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cache
from itertools import accumulate

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QPainter,
    QPalette,
    QPen,
    QPolygonF,
    QResizeEvent,
    QStaticText,
    QTextOption,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from occ_gui.widgets.guarded_paint import PaintedWidget
from occ_gui.widgets.plain_text import in_tool_tip

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
    if state in _OUTLINES:
        painter.drawPolygon(_OUTLINES[state])
    else:
        painter.drawEllipse(QRectF(-11, -11, 22, 22))
    painter.setPen(QPen(colours.paper, 2.8, c=Qt.PenCapStyle.RoundCap, j=Qt.PenJoinStyle.RoundJoin))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    _SIGNS[state](painter)
    painter.restore()


def _make_polygon(*points: tuple[float, float]) -> QPolygonF:
    return QPolygonF([QPointF(x, y) for x, y in points])


_OUTLINES = {
    State.BAD: _make_polygon(
        (-4.6, -11), (4.6, -11), (11, -4.6), (11, 4.6), (4.6, 11), (-4.6, 11), (-11, 4.6),
        (-11, -4.6),
    ),
    State.DOUBTFUL: _make_polygon((0, -11), (12, 10.5), (-12, 10.5)),
}  # fmt: skip
"""Outlines of icons other than a circle."""


def _draw_tick(painter: QPainter) -> None:
    painter.drawPolyline(_make_polygon((-5, 0.5), (-1.3, 4.2), (5.2, -3.8)))


def _draw_cross(painter: QPainter) -> None:
    painter.drawLine(QPointF(-4, -4), QPointF(4, 4))
    painter.drawLine(QPointF(-4, 4), QPointF(4, -4))


def _draw_exclamation_mark(painter: QPainter) -> None:
    painter.drawLine(QPointF(0, -3.5), QPointF(0, 2.5))
    painter.drawPoint(QPointF(0, 7))


def _draw_clock_hands(painter: QPainter) -> None:
    painter.drawPolyline(_make_polygon((0, -6), (0, 0), (4, 2.5)))


def _draw_letter(painter: QPainter) -> None:
    painter.drawPoint(QPointF(0, -5.5))
    painter.drawLine(QPointF(0, -0.5), QPointF(0, 5.5))


_SIGNS: dict[State, Callable[[QPainter], None]] = {
    State.GOOD: _draw_tick,
    State.BAD: _draw_cross,
    State.DOUBTFUL: _draw_exclamation_mark,
    State.WAITING: _draw_clock_hands,
    State.NEUTRAL: _draw_letter,
}


class StateIcon(PaintedWidget):
    def __init__(self, side: int) -> None:
        super().__init__()
        self.state = State.NEUTRAL
        self.setFixedSize(QSize(side, side))

    def show_state(self, state: State) -> None:
        if state is not self.state:
            self.state = state
            self.update()

    def paint_with(self, painter: QPainter) -> None:
        draw_state(painter, QRectF(self.rect()), self.state, colours_of(self.state, self.palette()))


_ICON = 14
_GAP = 6
_MORE_WIDTH = 40
_PADDING = 8


@dataclass(frozen=True, slots=True)
class Badge:
    key: str
    text: str  # a few words, as HTML with ``sub`` only
    meaning: str
    state: State = State.NEUTRAL
    stays: bool = False  # whether it is shown even without room for all badges


class BadgeLabel(PaintedWidget):
    def __init__(self, badge: Badge, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._text = QStaticText()
        self._text.setTextFormat(Qt.TextFormat.RichText)
        option = QTextOption()
        option.setWrapMode(QTextOption.WrapMode.NoWrap)
        self._text.setTextOption(option)
        self.badge = badge
        self._update_text(badge)

    def show_badge(self, badge: Badge) -> None:
        if badge != self.badge:
            self.badge = badge
            self._update_text(badge)

    def _update_text(self, badge: Badge) -> None:
        self._text.setText(badge.text)
        self._text.prepare(font=self.font())
        self._left = _PADDING + (0 if badge.state is State.NEUTRAL else _ICON + 4)
        self.setAccessibleName(plain_text_of(badge.text))
        self.setAccessibleDescription(badge.meaning)
        self.setToolTip(in_tool_tip(badge.meaning))
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        size = self._text.size()
        return QSize(math.ceil(self._left + size.width() + _PADDING), math.ceil(size.height()))

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._text.prepare(font=self.font())

    def paint_with(self, painter: QPainter) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        colours = colours_of(self.badge.state, self.palette())
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colours.paper)
        place = QRectF(self.rect())
        painter.drawRoundedRect(place, place.height() / 2, place.height() / 2)
        if self.badge.state is not State.NEUTRAL:
            top = (place.height() - _ICON) / 2
            draw_state(painter, QRectF(_PADDING, top, _ICON, _ICON), self.badge.state, colours)
        painter.setPen(colours.ink)
        height = self._text.size().height()
        painter.drawStaticText(QPointF(self._left, (place.height() - height) / 2), self._text)


class BadgeRow(QWidget):
    """Badges in a row at the right; the last one counts those that do not fit.

    Badges that stay come first.
    """

    def __init__(self) -> None:
        super().__init__()
        self.badges: tuple[Badge, ...] = ()
        # Unused labels are kept hidden: making and deleting them at each movement of a slider takes
        # longer than drawing them.
        self._labels: list[BadgeLabel] = []
        self._spare: list[BadgeLabel] = []
        self._more = BadgeLabel(Badge("more", "", ""), self)
        self._more.hide()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_badges(self, badges: Sequence[Badge]) -> None:
        badges = tuple(sorted(badges, key=lambda badge: not badge.stays))
        if badges == self.badges:
            return
        self.badges = badges
        free_labels = [*self._labels, *self._spare]
        self._labels = [
            _take_label(free_labels, badge) or BadgeLabel(badge, self) for badge in self.badges
        ]
        self._spare = free_labels
        for label in self._spare:
            label.hide()
        self._lay_out()

    def _lay_out(self) -> None:
        widths = [label.sizeHint().width() for label in self._labels]
        fitting = len(widths)
        if sum(widths) + _GAP * (fitting - 1) > self.width():
            room = self.width() - _MORE_WIDTH
            ends = accumulate(width + _GAP for width in widths)
            fitting = max(sum(end <= room for end in ends), self._staying_count)
        hidden = self._labels[fitting:]
        visible = self._labels[:fitting]
        self._more.setVisible(bool(hidden))
        if hidden:
            meaning = "\n".join(plain_text_of(label.badge.text) for label in hidden)
            self._more.show_badge(Badge("more", f"+ {len(hidden)}", meaning))
            visible = [*visible, self._more]
        for label in hidden:
            label.hide()
        right = self.width()
        for label in reversed(visible):
            width = label.sizeHint().width()
            label.setGeometry(right - width, 0, width, self.height())
            label.show()
            right -= width + _GAP

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._lay_out()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        hints = [label.sizeHint() for label in self._labels]
        width = sum(hint.width() + _GAP for hint in hints)
        return QSize(width, self.fontMetrics().height() + 6)

    @property
    def _staying_count(self) -> int:
        return sum(badge.stays for badge in self.badges)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        widths = (label.sizeHint().width() + _GAP for label in self._labels[: self._staying_count])
        return QSize(sum(widths) + _MORE_WIDTH, self.sizeHint().height())


def plain_text_of(html: str) -> str:
    return html.replace("<sub>", "_").replace("</sub>", "")


def _take_label(labels: list[BadgeLabel], badge: Badge) -> BadgeLabel | None:
    """Take a label for a badge, preferably the one with the same key; None if none is left."""
    if not labels:
        return None
    matches = (place for place, label in enumerate(labels) if label.badge.key == badge.key)
    label = labels.pop(next(matches, len(labels) - 1))
    label.show_badge(badge)
    return label
