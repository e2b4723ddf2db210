"""Table of several photos: the match of each, their mean, and lines for other programs."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

from PySide6.QtCore import QEvent, QModelIndex, QSize, Qt, QTimer, Signal
from PySide6.QtWidgets import QHBoxLayout, QTableView, QVBoxLayout, QWidget

from occ_gui.photo.many.rows_model import KNOWN, NOTE, PHOTO, PhotoRowsModel
from occ_gui.photo.match_figures import (
    WHAT_ERRORS_MEAN,
    PasteLines,
    describe_stale_value,
    is_certain,
)
from occ_gui.widgets.building import ScrollPane, fill, name_widget, paragraph, push_button
from occ_gui.widgets.plain_text import copy_text
from occ_gui.widgets.work_bar import WorkBar
from occ_model.errors import inflect
from occ_model.photo.many.other_programs import format_lines, frame_readout_time, lines_to_paste
from occ_model.photo.match_facts import LABELS
from occ_model.results.match import known_parameter, known_value
from occ_model.results.match_sentence import estimate_text
from occ_model.results.photo_table import (
    VERDICTS,
    CombinedEstimate,
    PhotoRow,
    PhotoTable,
    assumption,
    csv_text,
)
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

_MIN_VISIBLE_ROWS = 5
_LEAST_RESULTS_SIZE = QSize(220, 60)

_LARGEST_WIDTHS = {PHOTO: 220, NOTE: 280}
"""Largest widths in pixels, so that the times stay in view; the tooltip has the whole text."""


class ManyPhotosView(QWidget):
    match_asked = Signal()
    copied = Signal(str)  # a text was copied: a sentence that says so
    save_asked = Signal(str)  # the user saves the table: its text as CSV
    cancelled = Signal()
    closed = Signal()  # the user closes the table
    files_shown = Signal()  # other files are listed, or none
    photo_chosen = Signal(Path)  # the user opens one of the photos

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.rows = PhotoRowsModel(self)
        self.rows.refused.connect(self._show_note)
        self._make_buttons()
        self._make_table()
        self.work = WorkBar("Photos that are matched")
        self.work.cancelled.connect(self.cancelled)
        self.title, self.mean, self.exposure, self.frame, self.notes, self.warning = (
            paragraph(name=name, is_selectable=True)
            for name in (
                "How many photos",
                "Mean of the photos",
                "Mean exposure time",
                "Readout time of the whole frame",
                "Notes on the photos together",
                "Whether the table still belongs to the known value",
            )
        )
        self.paste = PasteLines()
        self.paste.copied.connect(self.copied)
        for label in (self.mean, self.exposure, self.frame):
            label.setToolTip(WHAT_ERRORS_MEAN)
        self._results: PhotoTable | None = None
        self._request: tuple[str, Scene] | None = None
        self._counts = ""
        self._scene: Scene | None = None
        self._known_at_match = ("", math.nan)
        self._certain: Mapping[str, float] = {}
        self._lay_out()
        self._show_title()

    def _lay_out(self) -> None:
        """Put the table beside the combined results, because the pane is wide and low."""
        together = QWidget()
        fill(
            QVBoxLayout(together), self.warning, self.mean, self.exposure, self.frame, self.notes,
            self.paste, None, margins=0,
        )  # fmt: skip
        self._results_pane = ScrollPane(together, _LEAST_RESULTS_SIZE)
        self._results_pane.hide()
        head = fill(
            QHBoxLayout(), (self.title, 1), self.start, self.copy, self.save, self.close_table
        )
        below = fill(QHBoxLayout(), (self.table, 3), (self._results_pane, 2))
        fill(QVBoxLayout(self), head, (below, 1), self.work, margins=(4, 0, 4, 4), spacing=4)

    def _make_buttons(self) -> None:
        self.start = push_button(
            "Match &all",
            "Match every photo with the choices in the pane Photo, and combine their estimates.",
            self.match_asked,
        )
        self.copy = push_button(
            "&Copy table",
            "Copy the table as CSV, with the scene that it belongs to.",
            lambda: self.copied.emit(copy_text(self.csv())),
        )
        self.save = push_button(
            "&Save table…",
            "Save the table as a CSV file, with the scene that it belongs to.",
            lambda: self.save_asked.emit(self.csv()),
        )
        self.close_table = push_button(
            "Close table", "Close the table; the open photo stays.", self.closed
        )

    def _make_table(self) -> None:
        self.table = name_widget(QTableView(), "Photos")
        self.table.setModel(self.rows)
        self.table.setShowGrid(False)
        self.table.setWordWrap(False)
        self.table.setTextElideMode(Qt.TextElideMode.ElideMiddle)  # names often end in a number
        self.table.setTabKeyNavigation(False)
        # The model marks the row of the open photo, however it was opened.
        self.table.setSelectionMode(QTableView.SelectionMode.NoSelection)
        self.table.setHorizontalScrollMode(QTableView.ScrollMode.ScrollPerPixel)
        self.table.verticalHeader().hide()
        header = self.table.horizontalHeader()
        header.setHighlightSections(False)
        header.setStretchLastSection(True)
        self.table.clicked.connect(self._choose)
        self.table.activated.connect(self._choose)
        self._fit_table()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "table"):
            QTimer.singleShot(0, self, self._fit_table)  # once the table has the font, too

    def _fit_table(self) -> None:
        """Fit rows and columns to the size of text."""
        row, header = self.fontMetrics().height() + 6, self.table.horizontalHeader()
        self.table.verticalHeader().setDefaultSectionSize(row)
        self.table.setMinimumHeight(header.sizeHint().height() + _MIN_VISIBLE_ROWS * row)
        self._fit_columns()

    def _fit_columns(self) -> None:
        """Fit the columns to their texts, up to a largest width, and scroll to the first one."""
        self.table.resizeColumnsToContents()
        for column, widest in _LARGEST_WIDTHS.items():
            self.table.setColumnWidth(column, min(self.table.columnWidth(column), widest))
        self.table.horizontalScrollBar().setValue(0)

    def _choose(self, index: QModelIndex) -> None:
        if index.column() != KNOWN:  # a click on that column edits it
            self.photo_chosen.emit(self.rows.paths[index.row()])

    def show_files(self, paths: Sequence[Path]) -> None:
        """Show these files in place of the previous ones, or hide the table."""
        self.rows.show_files(paths)
        self._show_results(None)
        self.work.end()
        self._request = None
        self._show_title()
        self._fit_columns()
        for button in (self.start, self.close_table):
            button.setEnabled(bool(paths))
        self.files_shown.emit()

    def begin_match(self, estimate: str, scene: Scene) -> None:
        known = known_parameter(estimate, scene.transmitter)
        self.rows.clear_results(estimate, known, float(scene.value(known)))
        self.show_busy(estimate, scene)

    def show_busy(self, estimate: str, scene: Scene) -> None:
        """Show that photos are being matched, and no mean yet."""
        self.rows.is_busy = True
        self._show_results(None)
        self._request, self._counts = (estimate, scene), ""
        self._show_title()
        self.start.setEnabled(False)
        self._show_count(0)
        self.work.begin()
        self.table.horizontalScrollBar().setValue(0)

    def _show_count(self, done: int) -> None:
        count = len(self.rows.paths)
        self.work.progress.setFormat(f"{done} of {count}")
        self.work.show_progress(done / count)

    def _show_title(self) -> None:
        text = inflect(len(self.rows.paths), "photo")
        if not self.rows.paths:
            text = "Open several photos together, or drop them, to match them all."
        elif self._request is None:
            text += ", not matched yet: say in the pane Photo what is known."
        else:
            text += f": {self._counts}" if self._counts else ""
            condition = self._condition(*self._request)
            self.rows.show_condition(condition)
            if condition:
                text += f". These values hold only {condition.removesuffix(': ')}."
        self.title.setText(text)

    def show_row(self, index: int, row: PhotoRow, done: int) -> None:
        self.rows.show_row(index, row)
        self._show_count(done)

    def end_match(self) -> None:
        self.work.end()
        self.rows.is_busy = False
        self.start.setEnabled(True)
        self._fit_columns()

    def show_failure(self, sentence: str) -> None:
        self.end_match()
        self._show_note(sentence)

    def _show_note(self, sentence: str) -> None:
        self.notes.setText(sentence)
        self.notes.show()
        self._results_pane.show()

    def show_table(self, table: PhotoTable) -> None:
        self.rows.show_table(table)
        self.end_match()
        self._request = (table.estimate, table.scene)
        self._counts = ", ".join(
            f"{table.count(verdict)} {verdict}" for verdict in VERDICTS if table.count(verdict)
        )
        self._show_title()
        self._show_results(table)

    def show_certain(self, certain: Mapping[str, float]) -> None:
        self._certain = certain
        self._show_title()
        self._show_results(self._results)

    def show_scene(self, scene: Scene) -> None:
        self._scene = scene
        self._warn_if_stale()

    def _warn_if_stale(self) -> None:
        table, scene = self._results, self._scene
        self.warning.hide()
        if table is None or scene is None:
            return
        warning = ""
        if not is_certain(table.known, float(table.scene.value(table.known)), self._certain):
            known = known_value(table.estimate, table.scene)
            warning = describe_stale_value(scene, table.estimate, known, self._known_at_match)
        self.warning.setText(f"{warning}match all again.")
        self.warning.setVisible(bool(warning))

    def _condition(self, estimate: str, scene: Scene) -> str:
        """Name the known value that an estimate assumes, unless the user is certain of it."""
        if self._results is not None and not self._results.rests_on_the_scene:
            return ""  # a value was entered for each photo
        known = known_parameter(estimate, scene.transmitter)
        if is_certain(known, float(scene.value(known)), self._certain):
            return ""
        return assumption(*known_value(estimate, scene))

    def _show_results(self, table: PhotoTable | None) -> None:
        if table is not None and table is not self._results and self._scene is not None:
            # The known value of a lamp stated in the form is its own frequency, not the scene's.
            self._known_at_match = known_value(table.estimate, self._scene)
        self._results = table
        self._warn_if_stale()
        for button in (self.copy, self.save):
            button.setEnabled(table is not None)
        texts = {self.mean: "", self.exposure: "", self.frame: "", self.notes: ""}
        if table is not None:
            condition = self._condition(table.estimate, table.scene)
            texts[self.mean] = self._describe_mean(table.estimate, table.estimated, condition)
            texts[self.exposure] = self._describe_mean(
                "exposure_time", table.exposure_time, condition
            )
            frame = frame_readout_time(table)
            if frame is not None:
                time = estimate_text(quantity("readout_time"), *frame)
                texts[self.frame] = f"Readout of the whole frame, sure photos: {condition + time}"
            texts[self.notes] = "\n".join(table.notes)
            self.paste.show_lines(lines_to_paste(table), condition)
        else:
            self.paste.show_lines({})
        for label, text in texts.items():
            label.setText(text)
            label.setVisible(bool(text))
        self._results_pane.setVisible(any(texts.values()))

    def _describe_mean(self, name: str, mean: CombinedEstimate | None, condition: str) -> str:
        if mean is None:
            return ""
        declared = quantity(name)
        value = estimate_text(declared, mean.value, mean.uncertainty)
        text = f"{LABELS[name]}: {condition}{value}, of the one sure photo"
        if mean.count > 1:
            agreement = "they agree" if mean.agrees else "they do not agree"
            text = (
                f"{LABELS[name]}: {condition}{value}, mean of {mean.count} sure photos; "
                f"χ² {mean.chi_square:.3g} of {mean.degrees_of_freedom}: {agreement}"
            )
        if mean.outliers:
            text += f"; {len(mean.outliers)} left out"
        return text

    def csv(self) -> str:
        """Return the table as CSV, with the lines to paste; empty before the photos are matched."""
        table = self._results
        if table is None:
            return ""
        condition = self._condition(table.estimate, table.scene)
        return csv_text(table, format_lines(table, condition), condition)
