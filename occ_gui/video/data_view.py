"""Data of a film: the text read so far, rates, clocks, and what is not sure."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QTextCursor
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPlainTextEdit,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from occ_gui.video.film_reading import FilmReading
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.named import paragraph
from occ_gui.widgets.plain_text import in_tool_tip
from occ_model.results.fact import Fact

_MOST_TEXT = 200_000  # most characters of the text that are kept on the screen: its end

_LEAST_HEIGHT = 40


class DataView(QWidget):
    """The text as it comes in, beside the facts of the reading, and its sentences."""

    def __init__(self) -> None:
        super().__init__()
        self.text = QPlainTextEdit()
        self.text.setReadOnly(True)
        self.text.setMinimumHeight(_LEAST_HEIGHT)
        self.text.setAccessibleName("What was read")
        self.text.setPlaceholderText("What is read of the film appears here.")
        self.text.setTabChangesFocus(True)
        self.sentences = paragraph(name="What is not sure")
        self.sentences.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self.labels: dict[str, QLabel] = {}
        self._names: dict[str, QLabel] = {}
        self._present: list[str] = []
        self._grid = QGridLayout()
        self._grid.setHorizontalSpacing(12)
        self._grid.setVerticalSpacing(2)
        self._grid.setRowStretch(100, 1)
        line = filled(QHBoxLayout(), (self.text, 1), self._grid, margins=0, spacing=12)
        filled(QVBoxLayout(self), (line, 1), self.sentences, margins=(6, 6, 6, 4))
        self.show_reading(FilmReading.nothing())

    def show_reading(self, reading: FilmReading) -> None:
        self._show_text(reading.text[-_MOST_TEXT:])
        self._show_facts(reading.facts)
        self.sentences.setText("\n".join(reading.sentences))
        self.sentences.setVisible(bool(reading.sentences))

    def _show_text(self, text: str) -> None:
        shown = self.text.toPlainText()
        if text == shown:
            return
        bar = self.text.verticalScrollBar()
        follows, place = bar.value() >= bar.maximum(), bar.value()
        if shown and text.startswith(shown):  # what is selected stays so
            cursor = QTextCursor(self.text.document())
            cursor.movePosition(QTextCursor.MoveOperation.End)
            cursor.insertText(text[len(shown) :])
        else:
            self.text.setPlainText(text)
        bar.setValue(bar.maximum() if follows else place)

    def _show_facts(self, facts: tuple[Fact, ...]) -> None:
        for fact in facts:
            if fact.label not in self.labels:
                self._add(fact.label)
            self.labels[fact.label].setText(fact.text)
            meaning = f"{fact.meaning} ({fact.note})" if fact.note else fact.meaning
            for part in (self.labels[fact.label], self._names[fact.label]):
                part.setToolTip(in_tool_tip(meaning))
        present = [fact.label for fact in facts]
        if present != self._present:
            self._present = present
            self._arrange()

    def _arrange(self) -> None:
        for label, value in self.labels.items():
            for part in (self._names[label], value):
                self._grid.removeWidget(part)
                part.setVisible(label in self._present)
        for row, label in enumerate(self._present):
            self._grid.addWidget(self._names[label], row, 0)
            self._grid.addWidget(self.labels[label], row, 1)

    def _add(self, label: str) -> None:
        name, value = QLabel(label), QLabel()
        value.setTextFormat(Qt.TextFormat.PlainText)
        value.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        value.setAccessibleName(label)
        self.labels[label], self._names[label] = value, name
