"""Row of chips: short rounded labels, each with the icon of its state."""

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
class Chip:
    key: str
    text: str  # a few words, as HTML with ``sub`` only
    meaning: str
    state: State = State.NEUTRAL
    stays: bool = False  # whether it is shown however little room there is


class ChipLabel(QWidget):
    def __init__(self, chip: Chip, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._text = QStaticText()
        self._text.setTextFormat(Qt.TextFormat.RichText)
        option = QTextOption()
        option.setWrapMode(QTextOption.WrapMode.NoWrap)
        self._text.setTextOption(option)
        self.chip = chip
        self._take(chip)

    def show_chip(self, chip: Chip) -> None:
        if chip != self.chip:
            self.chip = chip
            self._take(chip)

    def _take(self, chip: Chip) -> None:
        self._text.setText(chip.text)
        self._text.prepare(font=self.font())
        self._left = _PADDING + (0 if chip.state is State.NEUTRAL else _ICON + 4)
        self.setAccessibleName(plain_text_of(chip.text))
        self.setAccessibleDescription(chip.meaning)
        self.setToolTip(in_tool_tip(chip.meaning))
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
        colours = colours_of(self.chip.state, self.palette())
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colours.paper)
        place = QRectF(self.rect())
        painter.drawRoundedRect(place, place.height() / 2, place.height() / 2)
        if self.chip.state is not State.NEUTRAL:
            top = (place.height() - _ICON) / 2
            draw_state(painter, QRectF(_PADDING, top, _ICON, _ICON), self.chip.state, colours)
        painter.setPen(colours.ink)
        height = self._text.size().height()
        painter.drawStaticText(QPointF(self._left, (place.height() - height) / 2), self._text)


class ChipRow(QWidget):
    """Chips in a row at the right; those that do not fit are counted by the last one.

    Chips that stay come first.
    """

    def __init__(self) -> None:
        super().__init__()
        self.chips: tuple[Chip, ...] = ()
        # Labels that are not needed are kept hidden: making and deleting one at each movement of a
        # slider took longer than drawing it.
        self._labels: list[ChipLabel] = []
        self._spare: list[ChipLabel] = []
        self._more = ChipLabel(Chip("more", "", ""), self)
        self._more.hide()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_chips(self, chips: Sequence[Chip]) -> None:
        chips = tuple(sorted(chips, key=lambda chip: not chip.stays))
        if chips == self.chips:
            return
        self.chips = chips
        former = [*self._labels, *self._spare]
        self._labels = [_taken(former, chip) or ChipLabel(chip, self) for chip in self.chips]
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
            meaning = "\n".join(plain_text_of(label.chip.text) for label in hidden)
            self._more.show_chip(Chip("more", f"+ {len(hidden)}", meaning))
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
        return sum(chip.stays for chip in self.chips)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        staying = (label.sizeHint().width() + _GAP for label in self._labels[: self._staying])
        return QSize(sum(staying) + _MORE_WIDTH, self.sizeHint().height())


def plain_text_of(html: str) -> str:
    return html.replace("<sub>", "_").replace("</sub>", "")


def _taken(labels: list[ChipLabel], chip: Chip) -> ChipLabel | None:
    """Take a label for a chip, preferably one that looks the same; None if none is left."""
    if not labels:
        return None
    alike = (place for place, label in enumerate(labels) if label.chip.key == chip.key)
    label = labels.pop(next(alike, len(labels) - 1))
    label.show_chip(chip)
    return label
