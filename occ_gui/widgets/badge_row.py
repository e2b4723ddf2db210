"""Row of badges: short rounded labels, each with the icon of its state."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent, QStaticText, QTextOption
from PySide6.QtWidgets import QSizePolicy, QWidget

from occ_gui.widgets.guarded_paint import guarded
from occ_gui.widgets.plain_text import in_tool_tip
from occ_gui.widgets.state_look import State, colours_of, draw_state

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
    stays: bool = False  # whether it is shown however little room there is


class BadgeLabel(QWidget):
    def __init__(self, badge: Badge, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._text = QStaticText()
        self._text.setTextFormat(Qt.TextFormat.RichText)
        option = QTextOption()
        option.setWrapMode(QTextOption.WrapMode.NoWrap)
        self._text.setTextOption(option)
        self.badge = badge
        self._take(badge)

    def show_badge(self, badge: Badge) -> None:
        if badge != self.badge:
            self.badge = badge
            self._take(badge)

    def _take(self, badge: Badge) -> None:
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

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        painter = QPainter(self)
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
        # Labels that are not needed are kept hidden: making and deleting one at each movement of a
        # slider took longer than drawing it.
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
        former = [*self._labels, *self._spare]
        self._labels = [
            _take_label(former, badge) or BadgeLabel(badge, self) for badge in self.badges
        ]
        self._spare = former
        for label in self._spare:
            label.hide()
        self._place()

    def _place(self) -> None:
        widths = [label.sizeHint().width() for label in self._labels]
        fitting = len(widths)
        if sum(widths) + _GAP * (fitting - 1) > self.width():
            room = self.width() - _MORE_WIDTH
            ends = accumulate(width + _GAP for width in widths)
            fitting = max(sum(end <= room for end in ends), self._staying)
        hidden = self._labels[fitting:]
        shown = self._labels[:fitting]
        self._more.setVisible(bool(hidden))
        if hidden:
            meaning = "\n".join(plain_text_of(label.badge.text) for label in hidden)
            self._more.show_badge(Badge("more", f"+ {len(hidden)}", meaning))
            shown = [*shown, self._more]
        for label in hidden:
            label.hide()
        right = self.width()
        for label in reversed(shown):
            width = label.sizeHint().width()
            label.setGeometry(right - width, 0, width, self.height())
            label.show()
            right -= width + _GAP

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._place()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        hints = [label.sizeHint() for label in self._labels]
        width = sum(hint.width() + _GAP for hint in hints)
        return QSize(width, self.fontMetrics().height() + 6)

    @property
    def _staying(self) -> int:
        return sum(badge.stays for badge in self.badges)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        staying = (label.sizeHint().width() + _GAP for label in self._labels[: self._staying])
        return QSize(sum(staying) + _MORE_WIDTH, self.sizeHint().height())


def plain_text_of(html: str) -> str:
    return html.replace("<sub>", "_").replace("</sub>", "")


def _take_label(labels: list[BadgeLabel], badge: Badge) -> BadgeLabel | None:
    """Take a label for a badge, preferably the one with the same key; None if none is left."""
    if not labels:
        return None
    alike = (place for place, label in enumerate(labels) if label.badge.key == badge.key)
    label = labels.pop(next(alike, len(labels) - 1))
    label.show_badge(badge)
    return label
