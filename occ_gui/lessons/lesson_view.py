"""Lesson pane: the list of lessons, or one step with its question and answer."""

import html
import re
from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, QSize, Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from occ_gui.widgets.plain_text import in_menu
from occ_gui.widgets.scroll_pane import ScrollPane
from occ_model.results.teaching import Lesson

_INDEX = re.compile(r"\b([A-Za-z]+)_([A-Za-z]+)\b")

_LEFT = "text-align: left; padding: 4px 8px;"

_WANTED_HEIGHT = 320

_LEAST = QSize(200, 160)
"""Smallest size in pixels: then the list, or a question with its text, scrolls."""


class LessonView(QWidget):
    """The list of lessons, or the current step of one."""

    chosen = Signal(str)
    """The name of the lesson to continue."""

    moved = Signal(int)
    """The number of steps to go forward; negative to go back."""

    list_asked = Signal()
    again_asked = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.choices: list[QPushButton] = []
        self._pages = QStackedWidget()
        self._pages.addWidget(ScrollPane(self._make_list(), _LEAST))
        self._pages.addWidget(self._make_step())
        layout = QVBoxLayout(self)
        layout.setContentsMargins(4, 2, 4, 4)
        layout.addWidget(self._pages)

    def _make_list(self) -> QWidget:
        page = QWidget()
        self._invitation = _text()
        self._list = QVBoxLayout()
        self._list.setSpacing(3)
        layout = QVBoxLayout(page)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self._invitation)
        layout.addLayout(self._list)
        layout.addStretch()
        return page

    def _make_step(self) -> QWidget:
        self.place, self.text, self.question, self.answer = _text(), _text(), _text(), _text()
        font = self.place.font()
        font.setBold(True)
        for bold in (self.place, self.question):
            bold.setFont(font)
        self.answer.setFrameShape(QFrame.Shape.StyledPanel)
        self.answer.setMargin(4)
        self.answer.setAccessibleName(self.tr("Answer"))
        self.reveal = QPushButton(self.tr("Show the answer"))
        self.reveal.setCheckable(True)
        self.reveal.setToolTip(self.tr("Show what one finds, to compare with what you found."))
        self.reveal.toggled.connect(self._show_answer)
        self._content = QWidget()
        content = QVBoxLayout(self._content)
        content.setContentsMargins(0, 0, 0, 0)
        for label in (self.place, self.text, self.question):
            content.addWidget(label)
        content.addWidget(self.answer)
        content.addStretch()
        self._scroll = ScrollPane(self._content, _LEAST)
        page = QWidget()
        layout = QVBoxLayout(page)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(self._scroll, 1)
        layout.addLayout(self._make_buttons())
        self.answer.hide()
        return page

    def _make_buttons(self) -> QVBoxLayout:
        self.all = _button(
            self.tr("All"), self.tr("Go back to the list of lessons, and to your own scene.")
        )
        self.back = _button(self.tr("Back"), self.tr("Go to the step before, and set its scene."))
        self.next = _button(self.tr("Next"), self.tr("Go to the next step, and set its scene."))
        self.again = _button(
            self.tr("Set the scene again"),
            self.tr("Set the scene of this step again, as one step that can be undone."),
        )
        self.all.clicked.connect(self.list_asked)
        self.back.clicked.connect(lambda: self.moved.emit(-1))
        self.next.clicked.connect(lambda: self.moved.emit(1))
        self.again.clicked.connect(self.again_asked)
        column = QVBoxLayout()
        column.setSpacing(4)
        for buttons in ((self.reveal, self.again), (self.all, self.back, self.next)):
            row = QHBoxLayout()
            row.setSpacing(4)
            for button in buttons:
                row.addWidget(button, 1)
            column.addLayout(row)
        return column

    def list_lessons(
        self, found: Sequence[Lesson], reached: Mapping[str, int], failure: str
    ) -> None:
        """List lessons with the steps reached, or the reason why there are none."""
        self._invitation.setText(
            _set(failure)
            or self.tr(
                "Choose a lesson. Each step sets a scene and asks a question that you answer "
                "by trying. At the end your own scene returns."
            )
        )
        for button in self.choices:
            button.deleteLater()
        self.choices = []
        for lesson in found:
            button = self._choice(lesson, reached.get(lesson.name))
            self.choices.append(button)
            self._list.addWidget(button)
        self._pages.setCurrentIndex(0)

    def _choice(self, lesson: Lesson, reached: int | None) -> QPushButton:
        count = len(lesson.steps)
        words = {
            None: self.tr("{title} ({count} steps)"),
            count: self.tr("✓ {title}"),
        }
        text = words.get(reached, self.tr("{title} (step {place} of {count})"))
        button = QPushButton(
            text.format(title=in_menu(lesson.title), count=count, place=(reached or 0) + 1)
        )
        button.setToolTip(self.tr("Set the scene of its step and show its question."))
        button.setStyleSheet(_LEFT)
        button.clicked.connect(lambda: self.chosen.emit(lesson.name))
        return button

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Follow the theme: a button with a style sheet keeps its first colours."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            for button in self.choices:
                button.setStyleSheet("")
                button.setStyleSheet(_LEFT)

    def show_step(self, lesson: Lesson, place: int) -> None:
        """Show a step of a lesson."""
        step, count = lesson.steps[place], len(lesson.steps)
        self.place.setText(
            _set(
                self.tr("{title}, step {place} of {count}").format(
                    title=lesson.title, place=place + 1, count=count
                )
            )
        )
        self.text.setText(_set(step.text))
        self.question.setText(_set(step.question))
        self.answer.setText(_set(step.answer))
        self.reveal.setChecked(False)
        self.back.setEnabled(place > 0)
        self.next.setText(self.tr("Next") if place + 1 < count else self.tr("Done"))
        self._pages.setCurrentIndex(1)
        self._scroll.verticalScrollBar().setValue(0)

    def _show_end(self) -> None:
        self._scroll.ensureWidgetVisible(self.answer, 0, 4)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return a size that fits the list, or a step with its question."""
        return QSize(super().sizeHint().width(), _WANTED_HEIGHT)

    def _show_answer(self, shown: bool) -> None:
        self.answer.setVisible(shown)
        self.reveal.setText(self.tr("Hide the answer") if shown else self.tr("Show the answer"))
        if shown:
            # After the layout has changed.
            QTimer.singleShot(0, self._scroll, self._show_end)


def _set(text: str) -> str:
    """Typeset indices such as that of t_r."""
    return _INDEX.sub(r"<i>\1</i><sub>\2</sub>", html.escape(text, quote=False))


def _text() -> QLabel:
    label = QLabel()
    label.setWordWrap(True)
    label.setTextFormat(Qt.TextFormat.RichText)
    return label


def _button(text: str, tip: str) -> QPushButton:
    button = QPushButton(text)
    button.setToolTip(tip)
    return button
