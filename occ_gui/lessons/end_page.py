"""End of a lesson: the student's answers, and a report of them."""

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QVBoxLayout, QWidget

from occ_gui.lessons.step_page import LEAST
from occ_gui.lessons.texts import heading, paragraph
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.named import push_button
from occ_gui.widgets.scroll_pane import ScrollPane
from occ_model.results.lessons import CheckedAnswer, Lesson

_LONGEST_NAME = 120


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
        self.author = QLineEdit()
        self.author.setPlaceholderText("Your name, for the report")
        self.author.setAccessibleName("Your name, as it shall stand on the report")
        self.author.setToolTip("The name that stands on the report; it is kept for the next one.")
        self.author.setMaxLength(_LONGEST_NAME)
        self.all = push_button(
            "All lessons", "Go back to the list, and to your own scene.", self.list_asked
        )
        self.next = push_button(
            "Next lesson", "Begin the lesson that follows in the list.", self.next_asked
        )
        content = QWidget()
        filled(QVBoxLayout(content), self.title, self.answers, None, margins=8, spacing=8)
        row = filled(QHBoxLayout(), margins=(8, 0, 8, 4), spacing=8)
        named = filled(QHBoxLayout(), self.author, margins=(8, 0, 8, 4))
        # Where the button was that ended the lesson stands one that a second click may press.
        row.addWidget(self.report, 1)
        row.addWidget(self.all, 1)
        above = filled(QHBoxLayout(), self.next, margins=(8, 0, 8, 4))
        filled(QVBoxLayout(self), (ScrollPane(content, LEAST), 1), above, named, row, margins=0)

    def show_answers(
        self, lesson: Lesson, answers: Sequence[CheckedAnswer | None], following: str
    ) -> None:
        self.next.setText(f"Next lesson: {following}")
        self.next.setVisible(bool(following))
        self.title.setText(f"Done: {lesson.title}")
        lines = []
        for place, (step, answer) in enumerate(zip(lesson.steps, answers, strict=True), 1):
            given = "no answer"
            if answer is not None:
                given = f"{step.with_unit(answer.text)}. {answer.sentence}"
            lines.append(f"{place}. {step.question}\n    {given}")
        self.answers.setText("\n\n".join(lines))
