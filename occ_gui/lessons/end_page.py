"""End of a lesson: the student's answers, and a report of them."""

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QVBoxLayout, QWidget

from occ_gui.lessons.step_page import LEAST
from occ_gui.lessons.texts import button, heading, paragraph
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
        self.report = button(
            "Save the report…",
            "Save one page with your answers and figures, as PDF.",
        )
        self.author = QLineEdit()
        self.author.setPlaceholderText("Your name, for the report")
        self.author.setAccessibleName("Your name, as it shall stand on the report")
        self.author.setToolTip("The name that stands on the report; it is kept for the next one.")
        self.author.setMaxLength(_LONGEST_NAME)
        self.all = button("All lessons", "Go back to the list, and to your own scene.")
        self.next = button("Next lesson", "Begin the lesson that follows in the list.")
        self.next.clicked.connect(self.next_asked)
        self.report.clicked.connect(self.report_asked)
        self.all.clicked.connect(self.list_asked)
        content = QWidget()
        column = QVBoxLayout(content)
        column.setContentsMargins(8, 8, 8, 8)
        column.setSpacing(8)
        column.addWidget(self.title)
        column.addWidget(self.answers)
        column.addStretch()
        row = QHBoxLayout()
        row.setContentsMargins(8, 0, 8, 4)
        row.setSpacing(8)
        named = QHBoxLayout()
        named.setContentsMargins(8, 0, 8, 4)
        named.addWidget(self.author)
        # Where the button was that ended the lesson stands one that a second click may press.
        row.addWidget(self.report, 1)
        row.addWidget(self.all, 1)
        above = QHBoxLayout()
        above.setContentsMargins(8, 0, 8, 4)
        above.addWidget(self.next)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(ScrollPane(content, LEAST), 1)
        layout.addLayout(above)
        layout.addLayout(named)
        layout.addLayout(row)

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
