"""Table of several photos: the match of each, their mean, and lines for other programs."""

from pathlib import Path

from PySide6.QtCore import QEvent, QModelIndex, QSize, Qt, QTimer, Signal
from PySide6.QtWidgets import QHBoxLayout, QTableView, QVBoxLayout, QWidget

from occ_gui.photo.many.rows_model import (
    KNOWN,
    NOTE,
    PHOTO,
    PhotoRowsModel,
    condition_of_table,
)
from occ_gui.photo.match_figures import (
    WHAT_ERRORS_MEAN,
    PasteLines,
    describe_stale_value,
    is_certain,
)
from occ_gui.photo.shown_photo import ShownPhoto
from occ_gui.values.photo_results import ListedRows
from occ_gui.widgets.building import ScrollPane, fill, name_widget, paragraph, push_button
from occ_gui.widgets.plain_text import copy_text
from occ_gui.widgets.work_bar import WorkBar
from occ_model.errors import inflect
from occ_model.photo.many.other_programs import format_lines, frame_readout_time, lines_to_paste
from occ_model.photo.match_facts import LABELS
from occ_model.results.match import known_value
from occ_model.results.match_sentence import estimate_text
from occ_model.results.photo_table import (
    VERDICTS,
    CombinedEstimate,
    PhotoTable,
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
    photo_chosen = Signal(Path)  # the user opens one of the photos

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.rows = PhotoRowsModel(self)
        self.rows.refused.connect(self.show_note)
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
        self._shown = ShownPhoto(Scene())
        self._lay_out()
        self._show_listed(self._shown)

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

    def show_photo(self, shown: ShownPhoto) -> None:
        """Show the photos of the table, and mark the open one."""
        last, self._shown = self._shown, shown
        self.rows.show_photo(shown)
        if shown.listed is not last.listed or shown.choice.listed != last.choice.listed:
            self._show_work(shown.listed, last.listed)
            self._show_listed(shown)
        elif shown.choice.certain != last.choice.certain:
            self._show_listed(shown)
        if shown.choice.listed != last.choice.listed:
            self._fit_columns()
        self._warn_if_stale(shown)

    def _show_work(self, listed: ListedRows | None, last: ListedRows | None) -> None:
        """Show how many photos have been matched while the work is running."""
        is_running = listed is not None and listed.is_running
        was_running = last is not None and last.is_running
        if is_running and not was_running:
            self.work.begin()
            self.table.horizontalScrollBar().setValue(0)
        elif was_running and not is_running:
            self.work.end()
            self._fit_columns()
        if listed is not None and is_running:
            done, count = len(listed.rows), len(self.rows.paths)
            self.work.progress.setFormat(f"{done} of {count}")
            self.work.show_progress(done / count)

    def _show_listed(self, shown: ShownPhoto) -> None:
        listed, has_photos = shown.listed, bool(shown.choice.listed)
        table = None if listed is None else listed.table
        self.start.setEnabled(has_photos and not (listed is not None and listed.is_running))
        self.close_table.setEnabled(has_photos)
        for button in (self.copy, self.save):
            button.setEnabled(table is not None)
        self.title.setText(self._title(shown))
        self._show_mean(table)

    def _title(self, shown: ShownPhoto) -> str:
        text = inflect(len(shown.choice.listed), "photo")
        if not shown.choice.listed:
            return "Open several photos together, or drop them, to match them all."
        if shown.listed is None:
            return f"{text}, not matched yet: say in the pane Photo what is known."
        table, condition = shown.listed.table, condition_of_table(shown)
        if table is not None:
            counts = {verdict: table.count(verdict) for verdict in VERDICTS}
            text += ": " + ", ".join(f"{n} {verdict}" for verdict, n in counts.items() if n)
        if condition:
            text += f". These values hold only {condition.removesuffix(': ')}."
        return text

    def show_note(self, sentence: str) -> None:
        self.notes.setText(sentence)
        self.notes.show()
        self._results_pane.show()

    def _warn_if_stale(self, shown: ShownPhoto) -> None:
        listed, warning = shown.listed, ""
        if listed is not None and listed.table is not None:
            table = listed.table
            value = float(table.scene.value(table.known))
            if not is_certain(table.known, value, shown.choice.certain):
                used = known_value(table.estimate, table.scene)
                # The known value of a lamp stated in the form is its own, not the scene's.
                warning = describe_stale_value(shown.scene, table.estimate, used, listed.given)
        self.warning.setText(f"{warning}match all again.")
        self.warning.setVisible(bool(warning))

    def _show_mean(self, table: PhotoTable | None) -> None:
        texts = {self.mean: "", self.exposure: "", self.frame: "", self.notes: ""}
        self.paste.show_lines({})
        if table is not None:
            condition = condition_of_table(self._shown)
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
        listed = self._shown.listed
        if listed is None or listed.table is None:
            return ""
        table, condition = listed.table, condition_of_table(self._shown)
        return csv_text(table, format_lines(table, condition), condition)
