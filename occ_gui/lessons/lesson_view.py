"""Lesson pane: the list of lessons, one step of a lesson, or its end."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QSize, Signal
from PySide6.QtWidgets import QStackedWidget, QVBoxLayout, QWidget

from occ_gui.lessons.end_page import EndPage
from occ_gui.lessons.lesson_list import LessonList
from occ_gui.lessons.step_page import LEAST, StepPage
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.scroll_pane import ScrollPane
from occ_model.results.lessons import CheckedAnswer, Lesson

_WANTED_HEIGHT = 320


class LessonView(QWidget):
    list_asked = Signal()  # the list is to be shown again

    def __init__(self) -> None:
        super().__init__()
        self.list, self.step, self.end = LessonList(), StepPage(), EndPage()
        self._pages = QStackedWidget()
        for page in (ScrollPane(self.list, LEAST), self.step, self.end):
            self._pages.addWidget(page)
        self.step.list_asked.connect(self.list_asked)
        self.end.list_asked.connect(self.list_asked)
        filled(QVBoxLayout(self), self._pages, margins=0)

    def list_lessons(
        self,
        found: Sequence[Lesson],
        reached: Mapping[str, int],
        failure: str = "",
        problems: Mapping[str, str] | None = None,
    ) -> None:
        self.list.show_lessons(found, reached, failure, problems or {})
        self._pages.setCurrentIndex(0)

    def show_step(self, lesson: Lesson, place: int, before: CheckedAnswer | None) -> None:
        self.step.show_step(lesson, place, before)
        self._pages.setCurrentIndex(1)

    def show_end(
        self, lesson: Lesson, answers: Sequence[CheckedAnswer | None], following: str
    ) -> None:
        self.end.show_answers(lesson, answers, following)
        self._pages.setCurrentIndex(2)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(super().sizeHint().width(), _WANTED_HEIGHT)
