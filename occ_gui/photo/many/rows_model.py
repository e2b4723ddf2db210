"""Rows of the table of several photos, as a model for Qt's views."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    Qt,
    Signal,
)
from PySide6.QtGui import QGuiApplication, QPalette

from occ_gui.photo.match_result import SIGNS
from occ_gui.widgets.plain_text import LONGEST_TEXT, in_tool_tip
from occ_model.errors import ParameterError, one_line
from occ_model.photo.match_facts import LABELS
from occ_model.results.match_sentence import estimate_text
from occ_model.results.photo_table import DOUBTFUL, SURE, PhotoRow, PhotoTable
from occ_model.scene.parameters import quantity
from occ_model.scene.refusal import refusal_of

_Index = QModelIndex | QPersistentModelIndex

PHOTO, VERDICT, KNOWN, ESTIMATE, EXPOSURE, RECORDED, CORRELATION, NOTE = range(8)

_NUMBER_COLUMNS = (KNOWN, ESTIMATE, EXPOSURE, RECORDED, CORRELATION)


class PhotoRowsModel(QAbstractTableModel):
    """The photos, with the result and the known value of each."""

    known_entered = Signal(int)  # the known value of the photo at this index was entered or removed

    refused = Signal(str)  # why a known value is refused; the last one stays

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.paths: tuple[Path, ...] = ()
        self._rows: dict[int, PhotoRow] = {}
        self._table: PhotoTable | None = None
        self._estimate, self.known = "readout_time", "switching_frequency"
        self._condition = ""
        self._rematched_path: Path | None = None
        self._open_path: Path | None = None
        self._entered_values: dict[str, dict[int, float]] = {}
        """Values entered for single photos, by the kind of value and the photo's index."""
        self._common_value: float | None = None
        """Known value of all other photos, in SI units; None before they are matched."""
        self.is_busy = False
        """Whether the photos are being matched, so that no value can be entered for them."""

    def entered_values(self, name: str) -> tuple[tuple[int, float], ...]:
        """Return the values of a known parameter entered for single photos, in SI units."""
        return tuple(sorted(self._entered_values.get(_kind_of_value(name), {}).items()))

    def show_open(self, path: Path | None) -> None:
        self._open_path = path
        self._redraw()

    def _redraw(self) -> None:
        if self.paths:
            self.dataChanged.emit(self.index(0, PHOTO), self.index(len(self.paths) - 1, NOTE))

    def show_files(self, paths: Sequence[Path]) -> None:
        self.beginResetModel()
        self.paths = tuple(paths)
        self._rows, self._table, self._rematched_path = {}, None, None
        self._entered_values, self._common_value = {}, None
        self.endResetModel()

    def clear_results(self, estimate: str, known: str, common_value: float) -> None:
        """Clear the results before all photos are matched again to estimate this parameter.

        ``common_value``: the known parameter, in SI units, of photos without a value of their own.
        """
        self.beginResetModel()
        self._rows, self._table = {}, None
        self._estimate, self.known = estimate, known
        self._rematched_path, self._common_value = None, common_value
        self.endResetModel()

    def show_row(self, place: int, row: PhotoRow) -> None:
        self._rows[place] = row
        self.dataChanged.emit(self.index(place, PHOTO), self.index(place, NOTE))

    def show_table(self, table: PhotoTable) -> None:
        self._rows, self._table = dict(enumerate(table.rows)), table
        self._estimate = table.estimate
        self._common_value = float(table.scene.value(table.known))
        self._redraw()

    def show_condition(self, condition: str) -> None:
        """Show the assumed value that the times depend on; empty if it is certain."""
        self._condition = condition

    def mark_earlier(self, path: Path | None) -> None:
        """Mark the row of a photo that has since been matched on its own."""
        if path == self._rematched_path:
            return
        self._rematched_path = path
        self._redraw()

    def rowCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 - Qt's
        return 0 if parent.isValid() else len(self.paths)

    def columnCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 - Qt's
        return 0 if parent.isValid() else NOTE + 1

    def headerData(  # noqa: N802 - Qt's name
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _alignment_of(section)
        # A short title leaves room for the times beside it.
        known = f"given {quantity(self.known).symbol}"
        times = LABELS[self._estimate], LABELS["exposure_time"]
        titles = "Photo", "Verdict", known, *times, "Recorded", "Correlation", "Why"
        return titles[section] if role == Qt.ItemDataRole.DisplayRole else None

    def data(self, index: _Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        place, column = index.row(), index.column()
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return self.text(place, column)
            case Qt.ItemDataRole.EditRole if column == KNOWN:
                return self.text(place, column)
            case Qt.ItemDataRole.ToolTipRole:
                return in_tool_tip(self._tool_tip_text(place, column))
            case Qt.ItemDataRole.TextAlignmentRole:
                return _alignment_of(column)
            case Qt.ItemDataRole.BackgroundRole if self.paths[place] == self._open_path:
                return QGuiApplication.palette().brush(QPalette.ColorRole.Highlight)
            case Qt.ItemDataRole.ForegroundRole if self.paths[place] == self._open_path:
                return QGuiApplication.palette().brush(QPalette.ColorRole.HighlightedText)
        return None

    def flags(self, index: _Index) -> Qt.ItemFlag:
        flags = super().flags(index)
        if index.column() == KNOWN and not self.is_busy:
            flags |= Qt.ItemFlag.ItemIsEditable
        return flags

    def setData(  # noqa: N802 - Qt's name
        self, index: _Index, value: Any, role: int = Qt.ItemDataRole.EditRole
    ) -> bool:
        """Set the known value of a photo from typed text; empty text, the common value."""
        place, text = index.row(), str(value).strip()
        if index.column() != KNOWN or role != Qt.ItemDataRole.EditRole:
            return False
        if text == self.text(place, KNOWN):
            return True
        parameter = quantity(self.known)
        values = self._entered_values.setdefault(_kind_of_value(self.known), {})
        try:
            entered = parameter.parse(text, parameter.unit.display(parameter.default)[1])
        except ParameterError as error:
            if text:
                self.refused.emit(refusal_of(error))
                return False
            values.pop(place, None)
        else:
            values[place] = entered
        self._rows.pop(place, None)  # its result belongs to the old value
        self._redraw()
        self.known_entered.emit(place)
        return True

    def _tool_tip_text(self, place: int, column: int) -> str:
        """Return what a cell depends on, or why the photo is not sure."""
        row = self._rows.get(place)
        text = self.text(place, column)
        if column in (ESTIMATE, EXPOSURE) and text:
            is_own = row is not None and row.given is not None
            return text if is_own else f"{self._condition}{text}"
        if column == KNOWN:
            return (
                "The known value of this photo. Double-click to enter a value for this photo "
                "alone, for example of another lamp; clear the field to use the common value "
                "again."
            )
        if column == NOTE and row is not None and row.note:
            return one_line(row.note, LONGEST_TEXT)
        return str(self.paths[place])

    def text(self, place: int, column: int) -> str:
        if column == PHOTO:
            return one_line(self.paths[place].name)
        if column == KNOWN:
            known = self._entered_values.get(_kind_of_value(self.known), {}).get(
                place, self._common_value
            )
            return "" if known is None else quantity(self.known).format(known)
        row = self._rows.get(place)
        return "" if row is None else self._row_texts(place, row)[column]

    def _row_texts(self, place: int, row: PhotoRow) -> dict[int, str]:
        """Return the texts of a row's columns that depend on its result."""
        exposure = _format_estimate(row, "exposure_time")
        # The verdict of a doubtful photo applies to all of its values.
        is_only_exposure_doubtful = row.verdict == SURE and row.exposure_verdict == DOUBTFUL
        recorded = row.noted_exposure
        estimate = self._estimate if row.match is None else row.match.estimate
        return {
            VERDICT: self._verdict_text(place, row),
            ESTIMATE: _format_estimate(row, estimate or self._estimate),
            EXPOSURE: f"{exposure} (doubtful)" if is_only_exposure_doubtful else exposure,
            RECORDED: "" if recorded is None else quantity("exposure_time").format(recorded, 4),
            CORRELATION: "" if row.correlation is None else f"{row.correlation:.3f}",
            NOTE: one_line(row.note, 1000),
        }

    def _verdict_text(self, place: int, row: PhotoRow) -> str:
        text = f"{SIGNS[row.verdict]} {row.verdict}"
        if self._table is not None and self._table.is_outlier(place):
            text += ", outlier"
        return f"{text}, earlier match" if self.paths[place] == self._rematched_path else text


def _format_estimate(row: PhotoRow, name: str) -> str:
    value = getattr(row, name)
    return "" if value is None else estimate_text(quantity(name), value, row.uncertainty(name))


def _kind_of_value(known: str) -> str:
    """Return the kind of a known value; lamp and switching frequency are one kind."""
    return known if known == "readout_time" else "frequency"


def _alignment_of(column: int) -> Qt.AlignmentFlag:
    side = Qt.AlignmentFlag.AlignRight if column in _NUMBER_COLUMNS else Qt.AlignmentFlag.AlignLeft
    return side | Qt.AlignmentFlag.AlignVCenter
