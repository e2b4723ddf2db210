"""Page of one step of a lesson: goal, text, question, answer, explanation, navigation."""

import html
import re

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QProgressBar,
    QVBoxLayout,
    QWidget,
)

from occ_gui.explanation.equation_text import EquationText
from occ_gui.lessons.shutter_animation import ShutterAnimation
from occ_gui.widgets.building import (
    ScrollPane,
    embolden,
    fill,
    name_widget,
    paragraph as plain_paragraph,
    push_button,
)
from occ_gui.widgets.event_filters import leave_undo_to_window
from occ_model.results.teaching import CheckedAnswer, Lesson
from occ_model.scene.parameters import PARAMETERS

_SUBSCRIPT = re.compile(r"\b([A-Za-z]+)_([A-Za-z]+)\b")
_HEADING_SCALE = 1.25


def typeset(text: str) -> str:
    """Typeset indices such as that of t_r, and escape all else."""
    return _SUBSCRIPT.sub(r"<i>\1</i><sub>\2</sub>", html.escape(text, quote=False))


def paragraph(text: str = "") -> QLabel:
    return plain_paragraph(text, is_selectable=True)


def typeset_paragraph() -> QLabel:
    label = paragraph()
    label.setTextFormat(Qt.TextFormat.RichText)
    return label


def heading(text: str = "") -> QLabel:
    return embolden(paragraph(text), _HEADING_SCALE)


_LONGEST_ANSWER = 300  # characters of an answer

_SIGNS = {"right": "✓", "near": "≈", "wrong": "✗", "unreadable": "?", None: "→"}
"""Sign of each outcome, so that colour alone does not show it."""


class AnswerField(QWidget):
    """A field for a number or for words, with a button and a sentence."""

    checked = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        tip = "Type your answer here before you look at the explanation."
        self.field = name_widget(QLineEdit(maxLength=_LONGEST_ANSWER), "Your answer", tip)
        leave_undo_to_window(self.field)
        self.unit = QLabel()
        self.check = push_button("Check", "Compare your answer with the model (Enter).", self._ask)
        self.field.returnPressed.connect(self._ask)
        self.field.textEdited.connect(self._clear_outcome)
        self.sentence = name_widget(paragraph(), "Result of the check")
        self._outcome, self._is_outdated = "", False
        row = fill(QHBoxLayout(), self.field, self.unit, self.check, spacing=8)
        # Above the field, which so stays in its place at the lower end of the pane.
        fill(QVBoxLayout(self), self.sentence, row, margins=0, spacing=4)

    def begin(self, unit: str, is_number: bool, answer: CheckedAnswer | None) -> None:
        self.unit.setText(unit)
        self.unit.setVisible(bool(unit))
        self.field.setPlaceholderText("a number" if is_number else "in your own words")
        self.check.setText("Check" if is_number else "Keep")
        self.field.setText("" if answer is None else answer.text)
        if answer is None:
            self._clear_outcome()
        else:
            self.show_checked(answer)

    def show_checked(self, answer: CheckedAnswer) -> None:
        self.check.setEnabled(True)
        self._outcome = f"{_SIGNS[answer.outcome]}  {answer.sentence}"
        self._write()

    def show_outdated(self, outdated: bool) -> None:
        if outdated != self._is_outdated:
            self._is_outdated = outdated
            self._write()

    def _write(self) -> None:
        if not self._outcome:
            return
        after = "The scene has changed since: check again."
        self.sentence.setText(f"{self._outcome} {after}" if self._is_outdated else self._outcome)
        self.sentence.show()

    def show_waiting(self) -> None:
        self.check.setEnabled(False)
        self._outcome = ""
        self.sentence.setText("The model computes…")
        self.sentence.show()

    def _ask(self) -> None:
        if self.field.text().strip():
            self.checked.emit(self.field.text())

    def _clear_outcome(self) -> None:
        self.check.setEnabled(True)
        self._outcome = ""
        self.sentence.clear()
        self.sentence.hide()


LEAST_SIZE = QSize(200, 160)  # smallest size in pixels, at which a question with its text scrolls

_EQUATION_HEIGHT = 112

_LAYOUT_MS = 100  # longest layout of the explanation

_ANIMATION_HEIGHT = 200
_ACTIONS = {
    "transmitter": "Make a transmitter…",
    "photo": "Open your photo…",
    "match": "Match the photo",
}


class StepPage(QWidget):
    moved = Signal(int)  # the number of steps to go forward; negative to go back

    list_asked = Signal()
    again_asked = Signal()
    control_asked = Signal()
    action_asked = Signal()
    answer_given = Signal(str)
    explained = Signal(bool)

    def __init__(self) -> None:
        super().__init__()
        self.place, self.goal = paragraph(), heading()
        self.text, self.question = typeset_paragraph(), embolden(typeset_paragraph())
        self.progress = name_widget(QProgressBar(textVisible=False), "Progress of the lesson")
        self.progress.setFixedHeight(6)
        self.animation = ShutterAnimation()
        self.animation.setFixedHeight(_ANIMATION_HEIGHT)
        self.control = push_button(
            "",
            "Show the control that this step is about, with all others dimmed.",
            self.control_asked,
            name="Show the control of this step",
        )
        self.changed = name_widget(paragraph(), "Your changes to the scene")
        self.changed.hide()
        self.action = push_button(
            "", "Do what this step is about.", self.action_asked, name="Do what this step asks for"
        )
        self.answer_field = AnswerField()
        self.answer_field.checked.connect(self.answer_given)
        self._make_explanation()
        self._make_buttons()
        self._lay_out()

    def _make_explanation(self) -> None:
        self.answer = typeset_paragraph()
        self.answer.setFrameShape(QFrame.Shape.StyledPanel)
        self.answer.setMargin(8)
        self.answer.setAccessibleName("Explanation")
        self.equation = EquationText()
        self.equation.setFixedHeight(_EQUATION_HEIGHT)
        self.reveal = push_button(
            "Show the explanation", "Show the explanation, to compare with what you found."
        )
        self.reveal.setCheckable(True)
        self.reveal.toggled.connect(self._show_answer)
        self.answer.hide()
        self.equation.hide()
        self._has_equation = self._is_revealing = False

    def _make_buttons(self) -> None:
        self.all = push_button(
            "All lessons", "Go back to the list, and to your own scene.", self.list_asked
        )
        self.back = push_button(
            "Back", "Go to the previous step, and set its scene.", lambda: self.moved.emit(-1)
        )
        self.next = push_button(
            "Next", "Go to the next step, and set its scene.", lambda: self.moved.emit(1)
        )
        self.again = push_button(
            "Set the scene again",
            "Set the scene of this step again, as one step that can be undone.",
            self.again_asked,
        )

    def _lay_out(self) -> None:
        content = QWidget()
        fill(
            QVBoxLayout(content), self.place, self.progress, self.goal, self.animation, self.text,
            self.control, self.action, self.changed, self.reveal, self.answer, self.equation,
            None, margins=8, spacing=8,
        )  # fmt: skip
        self._scroll = ScrollPane(content, LEAST_SIZE)
        # The text is laid out in several passes, and each moves the end down.
        self._scroll.verticalScrollBar().rangeChanged.connect(self._follow_end)
        # The question stays in view, however long the text above it is.
        self.foot = QWidget()
        below = (8, 0, 8, 4)
        fill(QVBoxLayout(self.foot), self.question, self.answer_field, margins=below, spacing=4)
        rows = [
            fill(QHBoxLayout(), *((button, 1) for button in buttons), margins=below, spacing=8)
            for buttons in ((self.all, self.again), (self.back, self.next))
        ]
        fill(QVBoxLayout(self), (self._scroll, 1), self.foot, *rows, margins=0, spacing=4)

    def show_step(self, lesson: Lesson, place: int, answer: CheckedAnswer | None) -> None:
        step, count = lesson.steps[place], len(lesson.steps)
        self.place.setText(f"{lesson.title} · step {place + 1} of {count}")
        self.progress.setRange(0, count)
        self.progress.setValue(place + 1)
        self.goal.setText(step.goal)
        self.goal.setVisible(bool(step.goal))
        self.animation.setVisible(step.animation)
        self.text.setText(typeset(step.text))
        self.question.setText(typeset(step.question))
        label = PARAMETERS[step.control].label if step.control else ""
        self.control.setText(f"Change: {label}")
        self.control.setVisible(bool(step.control))
        self.action.setText(_ACTIONS.get(step.action, ""))
        self.action.setVisible(bool(step.action))
        unit = step.check.asked_in if step.check else ""
        self.answer_field.begin(unit, step.check is not None, answer)
        self._has_equation = bool(step.equation)
        self.reveal.setChecked(False)
        self.back.setEnabled(place > 0)
        self.next.setText("Next" if place + 1 < count else "Done")
        self._scroll.verticalScrollBar().setValue(0)

    def show_changed(self, sentence: str) -> None:
        self.changed.setText(sentence)
        self.changed.setVisible(bool(sentence))

    def show_explanation(self, text: str) -> None:
        self.answer.setText(typeset(text))

    def _show_answer(self, shown: bool) -> None:
        self.answer.setVisible(shown)
        self.equation.setVisible(shown and self._has_equation)
        self.reveal.setText("Hide the explanation" if shown else "Show the explanation")
        self.explained.emit(shown and self._has_equation)
        if shown:
            self._is_revealing = True
            QTimer.singleShot(_LAYOUT_MS, self, self._end_revealing)
            self._show_end()

    def _follow_end(self) -> None:
        if self._is_revealing:
            self._show_end()

    def _end_revealing(self) -> None:
        self._show_end()
        self._is_revealing = False

    def _show_end(self) -> None:
        last = self.equation if self._has_equation else self.answer
        # Of a widget with text, ensureWidgetVisible shows only the cursor.
        self._scroll.ensureVisible(0, last.geometry().bottom(), 0, 8)
