"""Lesson pane: the list of lessons, one step of a lesson, or its end."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, QSize, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLineEdit,
    QPushButton,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from occ_gui.lessons.step_page import LEAST_SIZE, StepPage, heading, paragraph
from occ_gui.widgets.building import ScrollPane, fill, name_widget, push_button
from occ_gui.widgets.plain_text import in_menu
from occ_model.errors import inflect
from occ_model.results.teaching import CheckedAnswer, Lesson, LoadedLessons

_LONGEST_NAME = 120  # characters


class EndPage(QWidget):
    """The answers of a lesson that is done, with buttons for the next one and the report."""

    report_asked = Signal()
    next_asked = Signal()
    list_asked = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.title, self.answers = heading(), paragraph()
        self.report = push_button(
            "Save the report…",
            "Save one page with your answers and figures, as PDF.",
            self.report_asked,
        )
        self.author = name_widget(
            QLineEdit(placeholderText="Your name, for the report", maxLength=_LONGEST_NAME),
            "Your name on the report",
            "The name printed on the report; it is kept for the next report.",
        )
        self.all_lessons = push_button(
            "All lessons", "Go back to the list, and to your own scene.", self.list_asked
        )
        self.next = push_button(
            "Next lesson", "Begin the lesson that follows in the list.", self.next_asked
        )
        content = QWidget()
        fill(QVBoxLayout(content), self.title, self.answers, None, margins=8, spacing=8)
        # The second click of a double click on Done hits Next lesson, which is harmless.
        rows = ((self.next,), (self.author,), ((self.report, 1), (self.all_lessons, 1)))
        lines = [fill(QHBoxLayout(), *row, margins=(8, 0, 8, 4), spacing=8) for row in rows]
        fill(QVBoxLayout(self), (ScrollPane(content, LEAST_SIZE), 1), *lines, margins=0)

    def show_answers(
        self, lesson: Lesson, answers: Sequence[CheckedAnswer | None], next_title: str
    ) -> None:
        self.next.setText(f"Next lesson: {next_title}")
        self.next.setVisible(bool(next_title))
        self.title.setText(f"Done: {lesson.title}")
        lines = []
        for number, (step, answer) in enumerate(zip(lesson.steps, answers, strict=True), 1):
            text = "no answer"
            if answer is not None:
                text = f"{step.with_unit(answer.text)}. {answer.sentence}"
            lines.append(f"{number}. {step.question}\n    {text}")
        self.answers.setText("\n\n".join(lines))


_CHOICE_STYLE = "text-align: left; padding: 8px;"


class LessonList(ScrollPane):
    """A button for each lesson, with its summary below."""

    chosen = Signal(str)  # the name of the lesson to begin or continue
    folder_asked = Signal()  # to open the folder of the user's own lessons

    def __init__(self) -> None:
        content = QWidget()
        super().__init__(content, LEAST_SIZE)
        self.choices: list[QPushButton] = []
        self._boxes: list[QWidget] = []
        self.message = paragraph()
        self.problems = paragraph()
        self._rows = QVBoxLayout()
        self._rows.setSpacing(8)
        self.folder = push_button(
            "Folder of your own lessons",
            "Open the folder of your own lessons; the guide explains how to write one.",
            self.folder_asked,
        )
        foot = fill(QHBoxLayout(), None, self.folder)
        parts = (heading("Lessons"), self.message, self._rows, self.problems, None, foot)
        fill(QVBoxLayout(content), *parts, margins=8, spacing=8)

    def show_lessons(
        self, loaded: LoadedLessons, done_steps: Mapping[str, int], failure: str
    ) -> None:
        introduction = (
            "Each step sets a scene and asks a question that you answer by trying. At the end "
            "your own scene returns."
        )
        self.message.setText(failure or introduction)
        self.problems.setText("\n".join(loaded.problems.values()))
        self.problems.setVisible(bool(loaded.problems))
        for box in self._boxes:
            self._rows.removeWidget(box)
            box.deleteLater()
        self.choices, self._boxes = [], []
        has_sheets = False
        for lesson in sorted(loaded.lessons, key=lambda lesson: lesson.is_sheet):
            if lesson.is_sheet and not has_sheets:
                has_sheets = True
                self._add_box(heading("Lab sheets"))
            self._add(lesson, done_steps.get(lesson.name))

    def _add_box(self, box: QWidget) -> None:
        self._boxes.append(box)
        self._rows.addWidget(box)

    def _add(self, lesson: Lesson, done_steps: int | None) -> None:
        count = len(lesson.steps)
        title = in_menu(lesson.title)
        texts = {None: f"{title}  ({inflect(count, 'step')})", count: f"✓  {title}"}
        text = texts.get(done_steps, f"{title}  (step {(done_steps or 0) + 1} of {count})")
        choice = push_button(text, "Set the scene of its step and show its question.")
        choice.setAccessibleDescription(lesson.summary)
        choice.setStyleSheet(_CHOICE_STYLE)
        choice.setProperty("lesson", lesson.name)
        choice.clicked.connect(self._choose)
        self.choices.append(choice)
        box = QWidget()
        column = fill(QVBoxLayout(box), choice, margins=0, spacing=2)
        if lesson.summary:
            summary = paragraph(lesson.summary)
            summary.setContentsMargins(8, 0, 8, 0)
            column.addWidget(summary)
        self._add_box(box)

    def _choose(self) -> None:
        self.chosen.emit(self.sender().property("lesson"))

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Set the style sheets again, without which the buttons keep the old colours."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            for choice in self.choices:
                choice.setStyleSheet("")
                choice.setStyleSheet(_CHOICE_STYLE)


_PREFERRED_HEIGHT = 320  # pixels


class LessonView(QStackedWidget):
    def __init__(self) -> None:
        super().__init__()
        self.list, self.step, self.end = LessonList(), StepPage(), EndPage()
        for page in (self.list, self.step, self.end):
            self.addWidget(page)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(super().sizeHint().width(), _PREFERRED_HEIGHT)
