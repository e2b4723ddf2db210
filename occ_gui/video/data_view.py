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
        self.rows: list[tuple[QLabel, QLabel]] = []
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
        while len(self.rows) < len(facts):
            self._add_row()
        for fact, (name, value) in zip(facts, self.rows, strict=False):
            name.setText(fact.label)
            value.setText(fact.text)
            value.setAccessibleName(fact.label)
            meaning = f"{fact.meaning} ({fact.note})" if fact.note else fact.meaning
            for part in (name, value):
                part.setToolTip(in_tool_tip(meaning))
        for place, row in enumerate(self.rows):
            for part in row:
                part.setVisible(place < len(facts))

    def _add_row(self) -> None:
        name, value = QLabel(), QLabel()
        value.setTextFormat(Qt.TextFormat.PlainText)
        value.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        for column, part in enumerate((name, value)):
            self._grid.addWidget(part, len(self.rows), column)
        self.rows.append((name, value))
