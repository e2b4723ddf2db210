"""State bar: a state in large letters, its reason below, and badges at the right."""

import math
from collections.abc import Sequence

from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFontMetrics, QPainter, QPalette, QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy

from occ_gui.widgets.building import ElidedLabel, push_button, resize_font
from occ_gui.widgets.event_filters import call_at
from occ_gui.widgets.guarded_paint import PaintedWidget
from occ_gui.widgets.state_look import Badge, BadgeRow, State, StateIcon, colours_of

_ICON = 32
_TEXT_SCALE = 1.25
_RADIUS = 8
_PADDING, _MARGIN = 12, 5
CHANGES_SCENE = "Changes the scene or the decoder in one step."  # tip of the button of most steps
_WIDEST_STEP = 0.4  # largest fraction of the width for the button of a step beside the texts


class StateBar(PaintedWidget):
    """A title in the colours and with the icon of its state, a sentence, badges, and a button.

    The button offers a step that helps in this state, such as a change of the scene.
    """

    USUAL_LINES, MOST_LINES = 1, 3
    """Most lines of a sentence, and of the shortest one if none of them is short enough."""
    changed = Signal()  # the contents of the bar have changed
    step_taken = Signal()  # the user presses the button of the step

    def __init__(self) -> None:
        super().__init__()
        self._title = ""
        self._sentences: tuple[str, ...] = ("",)
        self._shown_state: tuple[object, ...] = ()
        self.icon = StateIcon(_ICON)
        self.title = QLabel(textFormat=Qt.TextFormat.PlainText, wordWrap=True)
        self.sentence = ElidedLabel()
        self.wrapped = QLabel(  # replaces the sentence where it takes several lines
            textFormat=Qt.TextFormat.PlainText, wordWrap=True, alignment=Qt.AlignmentFlag.AlignTop
        )
        self._lines = self._title_lines = 1
        self._step_height = 0  # pixels of the step's button below the texts; 0 if it is beside them
        self.badges = BadgeRow()
        self.step = push_button("", CHANGES_SCENE, self.step_taken, name="A step that helps")
        self.step.hide()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        for part in (
            self.icon, self.title, self.sentence, self.wrapped, self.badges, self.step
        ):  # fmt: skip
            part.setParent(self)
        call_at(self, self._apply_colours, QEvent.Type.PaletteChange)
        call_at(self, self._fit_font, QEvent.Type.FontChange)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(400, self.minimumSizeHint().height())

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        height = sum(self._find_heights()) + 2 * _MARGIN + self._step_height
        return QSize(_ICON + 4 * _PADDING, height)

    def _find_heights(self) -> tuple[int, int]:
        metrics = self.title.fontMetrics()
        title = metrics.height() + (self._title_lines - 1) * metrics.lineSpacing()
        title = max(title, self.badges.sizeHint().height()) + 2
        metrics = self.sentence.fontMetrics()
        return title, metrics.height() + (self._lines - 1) * metrics.lineSpacing() + 2

    def _lay_out(self) -> None:
        """Give the title the width that it needs, and the badges the rest.

        Badges that would shorten the title stand beside the sentence, which can be shorter.
        """
        left = 2 * _PADDING + _ICON
        room = self._place_step(left, max(0, self.width() - left - _PADDING))
        title_width = self._fit_title(room)
        self.title.setText(self._title)
        badges = self.badges.minimumSizeHint().width() + _PADDING if self.badges.badges else 0
        is_beside_title = title_width + badges <= room
        text_room = room if is_beside_title else max(0, room - badges)
        text = self._choose_sentence(text_room)
        self._set_line_count(text, text_room)
        first, second = self._find_heights()
        title = min(title_width, room)
        self.icon.move(_PADDING, (self.height() - _ICON) // 2)
        self.title.setGeometry(left, _MARGIN, title, first)
        badges_left = left + _PADDING + (title if is_beside_title else text_room - _PADDING)
        height = self.badges.sizeHint().height()
        top = _MARGIN + (first - height) // 2 + (0 if is_beside_title else first)
        self.badges.setGeometry(badges_left, top, max(0, left + room - badges_left), height)
        for label in (self.sentence, self.wrapped):
            label.setGeometry(left, _MARGIN + first, text_room, second)
        # A widget that is not shown yet gets no resize event.
        self.sentence.set_full_text(text)
        self.wrapped.setText(text)
        self.wrapped.setToolTip("" if text == self._sentences[0] else self._sentences[0])
        self.wrapped.setVisible(self._lines > 1)
        self.sentence.setVisible(self._lines == 1)

    def _place_step(self, left: int, room: int) -> int:
        """Place the step's button at the right, or below all if wide; return the room beside it."""
        self._step_height = 0
        if self.step.isHidden():
            return room
        size = self.step.sizeHint()
        rest = max(0, room - size.width() - _PADDING)
        top = (self.height() - size.height()) // 2
        if size.width() > _WIDEST_STEP * room:
            rest, self._step_height = room, size.height() + _MARGIN
            top = self.height() - _MARGIN - size.height()
        self.step.setGeometry(left + room - size.width(), top, size.width(), size.height())
        return rest

    def _fit_title(self, room: int) -> int:
        """Return the width of the title, in large letters or, if these do not fit, in usual ones.

        If these do not fit either, the title takes several lines.
        """
        width = 0
        for scale in (_TEXT_SCALE, 1.0):
            font = resize_font(self.font(), scale)
            font.setBold(True)
            metrics = QFontMetrics(font)
            width = metrics.horizontalAdvance(self._title) + 4
            if width <= room:
                break
        if font != self.title.font():
            self.title.setFont(font)
        lines = _count_lines(metrics, self._title, room - 4)
        if lines != self._title_lines:
            self._title_lines = lines
            self.updateGeometry()
        return width

    def _set_line_count(self, text: str, room: int) -> None:
        lines = _count_lines(self.sentence.fontMetrics(), text, room)
        lines = lines if lines <= self.MOST_LINES else 1
        if lines != self._lines:
            self._lines = lines
            self.updateGeometry()

    def _choose_sentence(self, room: int) -> str:
        """Return the longest sentence that fits into as many lines as usual, or else the shortest.

        Only the shortest may take more of them.
        """
        metrics = self.sentence.fontMetrics()
        fitting = (
            sentence
            for sentence in self._sentences
            if _count_lines(metrics, sentence, room) <= self.USUAL_LINES
        )
        return next(fitting, self._sentences[-1])

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._lay_out()

    @property
    def heading(self) -> str:
        """The whole title, even if only a part of it fits."""
        return self._title

    @property
    def state(self) -> State:
        return self.icon.state

    def show_state(
        self, state: State, title: str, *sentences: str, badges: Sequence[Badge] = ()
    ) -> None:
        new_state = (state, title, sentences, tuple(badges))
        if new_state == self._shown_state:
            return
        self._shown_state = new_state
        if state is not self.icon.state:
            self.icon.show_state(state)
            self._apply_colours()
        self._title, self._sentences = title, sentences or ("",)
        self.badges.show_badges(badges)
        self._lay_out()
        self.setAccessibleDescription(f"{title}. {self._sentences[0]}".strip())
        self.changed.emit()

    def offer_step(self, label: str, tip: str = CHANGES_SCENE) -> None:
        """Offer a step that helps, by a button with this label; hide the button without one."""
        self.step.setToolTip(tip)
        if self.step.text() == label and self.step.isHidden() == (not label):
            return
        self.step.setText(label)
        if label:
            self.step.setAccessibleName(label)
        self.step.setVisible(bool(label))
        self._lay_out()
        self.updateGeometry()

    def _apply_colours(self) -> None:
        ink = colours_of(self.state, self.palette()).ink
        for label in (self.title, self.sentence, self.wrapped):
            palette = QPalette()  # all other colours stay those of the theme
            palette.setColor(QPalette.ColorRole.WindowText, ink)
            label.setPalette(palette)
        self.update()

    def _fit_font(self) -> None:
        self.updateGeometry()
        self._lay_out()

    def paint_with(self, painter: QPainter) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        colours = colours_of(self.state, self.palette())
        painter.setPen(colours.ink)
        painter.setBrush(colours.paper)
        place = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.drawRoundedRect(place, _RADIUS, _RADIUS)


def _count_lines(metrics: QFontMetrics, text: str, room: int) -> int:
    # Qt rounds the width of a text, and would shorten one that is a fraction of a pixel wider.
    if room <= 0 or metrics.horizontalAdvance(text) < room:
        return 1
    box = metrics.boundingRect(0, 0, room, 1, Qt.TextFlag.TextWordWrap, text)
    # A word that is wider than the room is cut off, however many lines there are.
    return max(2, math.ceil(box.height() / metrics.lineSpacing()))
