"""Pane of films: the film beside its simulation, what is read from it, and its timeline."""

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QKeyEvent, QTextCursor
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPlainTextEdit,
    QSizePolicy,
    QSplitter,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from occ_gui.video.film_bar import FilmBar, Transport
from occ_gui.video.film_reading import FilmReading, Marks
from occ_gui.video.frame_views import FilmPictures, FrameRows
from occ_gui.video.mark_look import MarkLegend
from occ_gui.video.recording_form import RecordingForm
from occ_gui.video.timeline import Timeline
from occ_gui.widgets.building import fill, name_widget, paragraph
from occ_gui.widgets.outdated_mark import OutdatedMark
from occ_gui.widgets.plain_text import in_tool_tip
from occ_gui.widgets.scroll_pane import ScrollPane
from occ_model.results.fact import Fact

_MOST_TEXT = 200_000  # most characters of text that are shown, from its end

_LEAST_HEIGHT = 40

_LARGE_PICTURE_PERCENT = 80  # height of large pictures, in percent of the pane

_LEAST_FORM = QSize(240, 80)


class DataView(QWidget):
    """The text that was read, facts about the reading, and remarks."""

    def __init__(self) -> None:
        super().__init__()
        hint = "What is read from the film appears here."
        field = QPlainTextEdit(readOnly=True, placeholderText=hint, tabChangesFocus=True)
        self.text = name_widget(field, "What was read")
        self.text.setMinimumHeight(_LEAST_HEIGHT)
        self.sentences = paragraph(name="What is not sure")
        self.sentences.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self.rows: list[tuple[QLabel, QLabel]] = []
        self._grid = QGridLayout()
        self._grid.setHorizontalSpacing(12)
        self._grid.setVerticalSpacing(2)
        self._grid.setRowStretch(100, 1)
        line = fill(QHBoxLayout(), (self.text, 1), self._grid, margins=0, spacing=12)
        fill(QVBoxLayout(self), (line, 1), self.sentences, margins=(6, 6, 6, 4))
        self.show_reading(FilmReading())

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
        if shown and text.startswith(shown):  # a selection stays
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


class VideoView(QWidget):
    """Pictures at the top, pages of rows, data and recording below them, and the timeline."""

    def __init__(self) -> None:
        super().__init__()
        self.bar, self.pictures = FilmBar(), FilmPictures()
        self.rows, self.data, self.form = FrameRows(), DataView(), RecordingForm()
        self.transport, self.timeline, self.legend = Transport(), Timeline(), MarkLegend()
        self.message = paragraph(name="What is wrong with the film")
        self.message.hide()
        self.pages = QTabWidget(documentMode=True)
        self._pages = (self.data, self.rows, ScrollPane(self.form, _LEAST_FORM))
        for page, title in zip(
            self._pages, ("What is read", "This frame", "Recording"), strict=True
        ):
            self.pages.addTab(page, title)
        self.pages.currentChanged.connect(self._size_by_page)
        self._size_by_page()
        self.split = QSplitter(Qt.Orientation.Vertical, childrenCollapsible=False)
        self.split.addWidget(self.pictures)
        self.split.addWidget(self.pages)
        self.split.setStretchFactor(0, 5)
        self.split.setStretchFactor(1, 4)
        line = fill(QHBoxLayout(), (self.transport, 1), self.legend, margins=0)
        fill(
            QVBoxLayout(self), self.bar, self.message, (self.split, 1), line, self.timeline,
            margins=(6, 4, 6, 4), spacing=4,
        )  # fmt: skip
        self.rows.picture_asked.connect(self.show_large)
        self._outdated = [OutdatedMark(part) for part in (self.data, self.timeline)]

    def _size_by_page(self) -> None:
        """Let only the visible page take height, so that the pictures get the rest."""
        kinds = QSizePolicy.Policy
        for page in self._pages:
            is_shown = page is self.pages.currentWidget()
            page.setSizePolicy(kinds.Preferred, kinds.Expanding if is_shown else kinds.Ignored)

    def show_message(self, sentence: str) -> None:
        """Show an error of the film or the camera; empty for none."""
        self.message.setText(sentence)
        self.message.setVisible(bool(sentence))

    def show_large(self) -> None:
        """Give the pictures most of the pane, and show them whole."""
        height = sum(self.split.sizes())
        self.split.setSizes(
            [_LARGE_PICTURE_PERCENT * height // 100, (100 - _LARGE_PICTURE_PERCENT) * height // 100]
        )
        self.pictures.fit()

    def show_reading(self, reading: FilmReading, frames: Marks) -> None:
        self.data.show_reading(reading)
        self.timeline.show_frames(frames)
        self.timeline.show_packets(reading.packets)

    def show_outdated(self, outdated: bool) -> None:
        for mark in self._outdated:
            mark.show_age(1.0 if outdated else 0.0, "read for an earlier scene")

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 - Qt's name
        """Pass keys that no other widget uses to the timeline."""
        self.timeline.keyPressEvent(event)
