"""End of a lesson: the student's answers, and a report of them."""

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from occ_gui.lessons.step_page import LEAST
from occ_gui.lessons.texts import button, heading, paragraph
from occ_gui.widgets.scroll_pane import ScrollPane
from occ_model.results.lessons import CheckedAnswer, Lesson


class EndPage(QWidget):
    """The answers of a lesson that is done, and a button for the report."""

    report_asked = Signal()
    list_asked = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.title, self.answers = heading(), paragraph()
        self.report = button(
            self.tr("Save the report…"),
            self.tr("Save one page with your answers and figures, as PDF."),
        )
        self.all = button(
            self.tr("All lessons"), self.tr("Go back to the list, and to your own scene.")
        )
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
        row.addWidget(self.all, 1)
        row.addWidget(self.report, 1)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(ScrollPane(content, LEAST), 1)
        layout.addLayout(row)

    def show_answers(self, lesson: Lesson, answers: Sequence[CheckedAnswer | None]) -> None:
        """Show the answers to the steps of a lesson; None where there is none."""
        self.title.setText(self.tr("Done: {title}").format(title=lesson.title))
        lines = []
        for place, (step, answer) in enumerate(zip(lesson.steps, answers, strict=True), 1):
            given = self.tr("no answer") if answer is None else f"{answer.text}. {answer.sentence}"
            lines.append(f"{place}. {step.question}\n    {given}")
        self.answers.setText("\n\n".join(lines))
