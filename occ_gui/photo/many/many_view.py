"""Table of several photos: what was found in each, their mean, and lines for other programs."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

from PySide6.QtCore import QModelIndex, QSize, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QTableView, QVBoxLayout, QWidget

from occ_gui.photo.many.rows_model import KNOWN, NOTE, PHOTO, PhotoRowsModel
from occ_gui.photo.match_figures import WHAT_ERRORS_MEAN, PasteLines, is_certain, warn_of_stale
from occ_gui.widgets.building import ScrollPane, fill, name_widget, paragraph, push_button
from occ_gui.widgets.plain_text import copy_text
from occ_gui.widgets.work_bar import WorkBar
from occ_model.errors import counted
from occ_model.photo.many.other_programs import frame_readout_time, lines_to_paste, stated_lines
from occ_model.photo.match_facts import LABELS, estimate_text
from occ_model.results.match import known_parameter, known_value
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

_ROWS_SEEN = 5
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
    rows_changed = Signal()  # the result of a photo has changed
    photo_chosen = Signal(Path)  # the user opens one of the photos

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.rows = PhotoRowsModel(self)
        self.rows.modelReset.connect(self.rows_changed)
        self.rows.dataChanged.connect(self.rows_changed)
        self.rows.refused.connect(self._show_note)
        self._make_buttons()
        self._make_table()
        self.work = WorkBar("Photos that are matched")
        self.work.cancelled.connect(self.cancelled)
        self.title, self.mean, self.exposure, self.frame, self.notes, self.stale = (
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
        self._found: PhotoTable | None = None
        self._asked: tuple[str, Scene] | None = None
        self._counts = ""
        self._scene: Scene | None = None
        self._given = ("", math.nan)
        self._certain: Mapping[str, float] = {}
        self._lay_out()
        self._show_title()

    def _lay_out(self) -> None:
        """Put the table beside the combined results, because the pane is wide and low."""
        together = QWidget()
        fill(
            QVBoxLayout(together), self.stale, self.mean, self.exposure, self.frame, self.notes,
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
        row, header = self.fontMetrics().height() + 6, self.table.horizontalHeader()
        self.table.verticalHeader().hide()
        self.table.verticalHeader().setDefaultSectionSize(row)
        header.setHighlightSections(False)
        header.setStretchLastSection(True)
        self.table.setMinimumHeight(header.sizeHint().height() + _ROWS_SEEN * row)
        self.table.clicked.connect(self._choose)
        self.table.activated.connect(self._choose)

    def _fit_columns(self) -> None:
        """Fit the columns to their texts, up to a largest width, and scroll to the first one."""
        self.table.resizeColumnsToContents()
        for column, widest in _LARGEST_WIDTHS.items():
            self.table.setColumnWidth(column, min(self.table.columnWidth(column), widest))
        self.table.horizontalScrollBar().setValue(0)

    def _choose(self, index: QModelIndex) -> None:
        if index.column() != KNOWN:  # which is edited
            self.photo_chosen.emit(self.rows.paths[index.row()])

    def show_files(self, paths: Sequence[Path]) -> None:
        """Show these files in place of the previous ones, or hide the table."""
        self.rows.show_files(paths)
        self._show_found(None)
        self.work.end()
        self._asked = None
        self._show_title()
        self._fit_columns()
        for button in (self.start, self.close_table):
            button.setEnabled(bool(paths))
        self.files_shown.emit()

    def show_begun(self, estimate: str, scene: Scene) -> None:
        known = known_parameter(estimate, scene.transmitter)
        self.rows.show_begun(estimate, known, float(scene.value(known)))
        self.show_busy(estimate, scene)

    def show_busy(self, estimate: str, scene: Scene) -> None:
        """Show that photos are being matched, and no mean yet."""
        self.rows.is_busy = True
        self._show_found(None)
        self._asked, self._counts = (estimate, scene), ""
        self._show_title()
        self.start.setEnabled(False)
        self._show_done(0)
        self.work.begin()
        self.table.horizontalScrollBar().setValue(0)

    def _show_done(self, done: int) -> None:
        count = len(self.rows.paths)
        self.work.progress.setFormat(f"{done} of {count}")
        self.work.show_progress(done / count)

    def _show_title(self) -> None:
        text = counted(len(self.rows.paths), "photo")
        if not self.rows.paths:
            text = "Open several photos together, or drop them, to match them all."
        elif self._asked is None:
            text += ", not matched yet: say in the pane Photo what is known."
        else:
            text += f": {self._counts}" if self._counts else ""
            rests_on = self._condition(*self._asked)
            self.rows.show_condition(rests_on)
            if rests_on:
                text += f". What is measured holds only {rests_on.removesuffix(': ')}."
        self.title.setText(text)

    def show_row(self, place: int, row: PhotoRow, done: int) -> None:
        self.rows.show_row(place, row)
        self._show_done(done)

    def show_ended(self) -> None:
        self.work.end()
        self.rows.is_busy = False
        self.start.setEnabled(True)
        self._fit_columns()

    def show_failed(self, sentence: str) -> None:
        self.show_ended()
        self._show_note(sentence)

    def _show_note(self, sentence: str) -> None:
        self.notes.setText(sentence)
        self.notes.show()
        self._results_pane.show()

    def show_table(self, table: PhotoTable) -> None:
        self.rows.show_table(table)
        self.show_ended()
        self._asked = (table.estimate, table.scene)
        self._counts = ", ".join(f"{table.count(v)} {v}" for v in VERDICTS if table.count(v))
        self._show_title()
        self._show_found(table)

    def show_certain(self, certain: Mapping[str, float]) -> None:
        self._certain = certain
        self._show_title()
        self._show_found(self._found)

    def show_scene(self, scene: Scene) -> None:
        self._scene = scene
        self._show_stale()

    def _show_stale(self) -> None:
        table, scene = self._found, self._scene
        self.stale.hide()
        if table is None or scene is None:
            return
        stale = ""
        if not is_certain(table.known, float(table.scene.value(table.known)), self._certain):
            then = known_value(table.estimate, table.scene)
            stale = warn_of_stale(scene, table.estimate, then, self._given)
        self.stale.setText(f"{stale}match all again.")
        self.stale.setVisible(bool(stale))

    def _condition(self, estimate: str, scene: Scene) -> str:
        """Name the value that an estimate depends on, unless the user is certain of it."""
        if self._found is not None and not self._found.rests_on_the_scene:
            return ""  # a value was entered for each photo
        known = known_parameter(estimate, scene.transmitter)
        if is_certain(known, float(scene.value(known)), self._certain):
            return ""
        return assumption(*known_value(estimate, scene))

    def _show_found(self, table: PhotoTable | None) -> None:
        if table is not None and table is not self._found and self._scene is not None:
            # The known value of a lamp stated in the form is its own frequency, not the scene's.
            self._given = known_value(table.estimate, self._scene)
        self._found = table
        self._show_stale()
        for button in (self.copy, self.save):
            button.setEnabled(table is not None)
        texts = {self.mean: "", self.exposure: "", self.frame: "", self.notes: ""}
        if table is not None:
            rests_on = self._condition(table.estimate, table.scene)
            texts[self.mean] = self._describe_mean(table.estimate, table.estimated, rests_on)
            texts[self.exposure] = self._describe_mean(
                "exposure_time", table.exposure_time, rests_on
            )
            frame = frame_readout_time(table)
            if frame is not None:
                time = estimate_text(quantity("readout_time"), *frame)
                texts[self.frame] = f"Readout of the whole frame, sure photos: {rests_on + time}"
            texts[self.notes] = "\n".join(table.notes)
            self.paste.show_lines(lines_to_paste(table), rests_on)
        else:
            self.paste.show_lines({})
        for label, text in texts.items():
            label.setText(text)
            label.setVisible(bool(text))
        self._results_pane.setVisible(any(texts.values()))

    def _describe_mean(self, name: str, found: CombinedEstimate | None, condition: str) -> str:
        if found is None:
            return ""
        declared = quantity(name)
        value = estimate_text(declared, found.value, found.uncertainty)
        text = f"{LABELS[name]}: {condition}{value}, of the one sure photo"
        if found.count > 1:
            how = "they agree" if found.agrees else "they do not agree"
            text = (
                f"{LABELS[name]}: {condition}{value}, mean of {found.count} sure photos; "
                f"χ² {found.chi_square:.3g} of {found.degrees_of_freedom}: {how}"
            )
        if found.outliers:
            text += f"; {len(found.outliers)} left out"
        return text

    def csv(self) -> str:
        """Return the table as CSV, with the lines to paste; empty before the photos are matched."""
        table = self._found
        if table is None:
            return ""
        rests_on = self._condition(table.estimate, table.scene)
        return csv_text(table, stated_lines(table, rests_on), rests_on)
