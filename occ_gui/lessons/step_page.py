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
    """Return HTML with indices, such as that of t_r, as subscripts."""
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
"""Sign of each outcome, so that it does not depend on colour."""


class AnswerField(QWidget):
    """A field for a number or for words, with a button and a sentence."""

    checked = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        tip = "Type your answer here before you look at the explanation."
        self.field = name_widget(QLineEdit(maxLength=_LONGEST_ANSWER), "Your answer", tip)
        leave_undo_to_window(self.field)
        self.unit = QLabel()
        self.check = push_button(
            "Check", "Compare your answer with the model (Enter).", self._emit_answer
        )
        self.field.returnPressed.connect(self._emit_answer)
        self.field.textEdited.connect(self._clear_outcome)
        self.sentence = name_widget(paragraph(), "Result of the check")
        self._outcome, self._is_outdated = "", False
        row = fill(QHBoxLayout(), self.field, self.unit, self.check, spacing=8)
        # Above the field, so that the field stays at the bottom of the pane.
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
            self.show_outcome(answer)

    def show_outcome(self, answer: CheckedAnswer) -> None:
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
        hint = "The scene has changed since: check again."
        self.sentence.setText(f"{self._outcome} {hint}" if self._is_outdated else self._outcome)
        self.sentence.show()

    def show_waiting(self) -> None:
        self.check.setEnabled(False)
        self._outcome = ""
        self.sentence.setText("The model computes…")
        self.sentence.show()

    def _emit_answer(self) -> None:
        if self.field.text().strip():
            self.checked.emit(self.field.text())

    def _clear_outcome(self) -> None:
        self.check.setEnabled(True)
        self._outcome = ""
        self.sentence.clear()
        self.sentence.hide()


LEAST_SIZE = QSize(200, 160)  # smallest size in pixels, at which a question with its text scrolls

_EQUATION_HEIGHT = 112

_LAYOUT_MS = 100  # longest time in milliseconds until the explanation is laid out

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
    equation_shown = Signal(bool)  # whether the equation is shown from now on

    def __init__(self) -> None:
        super().__init__()
        self.position, self.goal = paragraph(), heading()
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
        self.changes = name_widget(paragraph(), "Your changes to the scene")
        self.changes.hide()
        self.action = push_button(
            "", "Do what this step is about.", self.action_asked, name="Do what this step asks for"
        )
        self.answer_field = AnswerField()
        self.answer_field.checked.connect(self.answer_given)
        self._make_explanation()
        self._make_buttons()
        self._lay_out()

    def _make_explanation(self) -> None:
        self.explanation = typeset_paragraph()
        self.explanation.setFrameShape(QFrame.Shape.StyledPanel)
        self.explanation.setMargin(8)
        self.explanation.setAccessibleName("Explanation")
        self.equation = EquationText()
        self.equation.setFixedHeight(_EQUATION_HEIGHT)
        self.reveal = push_button(
            "Show the explanation", "Show the explanation, to compare with what you found."
        )
        self.reveal.setCheckable(True)
        self.reveal.toggled.connect(self._toggle_explanation)
        self.explanation.hide()
        self.equation.hide()
        self._has_equation = self._is_revealing = False

    def _make_buttons(self) -> None:
        self.all_lessons = push_button(
            "All lessons", "Go back to the list, and to your own scene.", self.list_asked
        )
        self.back = push_button(
            "Back", "Go to the previous step, and set its scene.", lambda: self.moved.emit(-1)
        )
        self.next = push_button(
            "Next", "Go to the next step, and set its scene.", lambda: self.moved.emit(1)
        )
        self.reset = push_button(
            "Restore this scene",
            "Undo your own changes; Undo brings them back.",
            self.again_asked,
        )

    def _lay_out(self) -> None:
        content = QWidget()
        fill(
            QVBoxLayout(content), self.position, self.progress, self.goal, self.animation,
            self.text, self.control, self.action, self.changes, self.reveal, self.explanation,
            self.equation, None, margins=8, spacing=8,
        )  # fmt: skip
        self._scroll = ScrollPane(content, LEAST_SIZE)
        # The text is laid out in several passes, each of which moves the end down.
        self._scroll.verticalScrollBar().rangeChanged.connect(self._follow_end)
        # The question stays in view, however long the text above it is.
        self.foot = QWidget()
        below = (8, 0, 8, 4)
        fill(QVBoxLayout(self.foot), self.question, self.answer_field, margins=below, spacing=4)
        rows = [
            fill(QHBoxLayout(), *((button, 1) for button in buttons), margins=below, spacing=8)
            for buttons in ((self.all_lessons, self.reset), (self.back, self.next))
        ]
        fill(QVBoxLayout(self), (self._scroll, 1), self.foot, *rows, margins=0, spacing=4)

    def show_step(self, lesson: Lesson, index: int, answer: CheckedAnswer | None) -> None:
        step, count = lesson.steps[index], len(lesson.steps)
        self.position.setText(f"{lesson.title} · step {index + 1} of {count}")
        self.progress.setRange(0, count)
        self.progress.setValue(index + 1)
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
        self.back.setEnabled(index > 0)
        self.next.setText("Next" if index + 1 < count else "Done")
        self._scroll.verticalScrollBar().setValue(0)

    def show_changes(self, sentence: str) -> None:
        self.changes.setText(sentence)
        self.changes.setVisible(bool(sentence))

    def show_explanation(self, text: str) -> None:
        self.explanation.setText(typeset(text))

    def _toggle_explanation(self, visible: bool) -> None:
        self.explanation.setVisible(visible)
        self.equation.setVisible(visible and self._has_equation)
        self.reveal.setText("Hide the explanation" if visible else "Show the explanation")
        self.equation_shown.emit(visible and self._has_equation)
        if visible:
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
        last = self.equation if self._has_equation else self.explanation
        # ensureWidgetVisible would show only the cursor of a widget with text.
        self._scroll.ensureVisible(0, last.geometry().bottom(), 0, 8)
