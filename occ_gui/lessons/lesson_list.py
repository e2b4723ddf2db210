"""List of lessons: title, what one learns, and how far one has come."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from occ_gui.lessons.texts import heading, paragraph
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.named import push_button
from occ_gui.widgets.plain_text import in_menu
from occ_model.results.lessons import Lesson

_LEFT = "text-align: left; padding: 8px;"


class LessonList(QWidget):
    """A button for each lesson, with its summary below."""

    chosen = Signal(str)  # the name of the lesson to begin or continue
    folder_asked = Signal()  # the folder of the user's own lessons is to be opened

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.choices: list[QPushButton] = []
        self._boxes: list[QWidget] = []
        self.message = paragraph()
        self.problems = paragraph()
        self._rows = QVBoxLayout()
        self._rows.setSpacing(8)
        self.folder = push_button(
            "Folder of your own lessons",
            "Open the folder of lessons of your own; the guide tells how to write one.",
            self.folder_asked,
        )
        foot = filled(QHBoxLayout(), None, self.folder)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.setSpacing(8)
        layout.addWidget(heading("Lessons"))
        layout.addWidget(self.message)
        layout.addLayout(self._rows)
        layout.addWidget(self.problems)
        layout.addStretch()
        layout.addLayout(foot)

    def show_lessons(
        self,
        found: Sequence[Lesson],
        reached: Mapping[str, int],
        failure: str,
        problems: Mapping[str, str],
    ) -> None:
        self.message.setText(
            failure
            or (
                "Each step sets a scene and asks for something that you find by trying. At the end "
                "your own scene returns."
            )
        )
        self.problems.setText("\n".join(problems.values()))
        self.problems.setVisible(bool(problems))
        for box in self._boxes:
            self._rows.removeWidget(box)
            box.deleteLater()
        self.choices, self._boxes = [], []
        for lesson in (each for each in found if not each.is_sheet):
            self._add(lesson, reached.get(lesson.name))
        sheets = [each for each in found if each.is_sheet]
        if sheets:
            self._add_heading("Lab sheets")
        for sheet in sheets:
            self._add(sheet, reached.get(sheet.name))

    def _add_heading(self, text: str) -> None:
        label = heading(text)
        self._boxes.append(label)
        self._rows.addWidget(label)

    def _add(self, lesson: Lesson, reached: int | None) -> None:
        count = len(lesson.steps)
        title = in_menu(lesson.title)
        words = {None: f"{title}  ({count} steps)", count: f"✓  {title}"}
        text = words.get(reached, f"{title}  (step {(reached or 0) + 1} of {count})")
        choice = push_button(text, "Set the scene of its step and show its question.")
        choice.setAccessibleDescription(lesson.summary)
        choice.setStyleSheet(_LEFT)
        choice.setProperty("lesson", lesson.name)
        choice.clicked.connect(self._choose)
        self.choices.append(choice)
        box = QWidget()
        self._boxes.append(box)
        column = filled(QVBoxLayout(box), choice, margins=0, spacing=2)
        if lesson.summary:
            summary = paragraph(lesson.summary)
            summary.setContentsMargins(8, 0, 8, 0)
            column.addWidget(summary)
        self._rows.addWidget(box)

    def _choose(self) -> None:
        self.chosen.emit(self.sender().property("lesson"))

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Follow the theme: a button with a style sheet keeps its first colours."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            for choice in self.choices:
                choice.setStyleSheet("")
                choice.setStyleSheet(_LEFT)
