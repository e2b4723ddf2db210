"""Rows of the table of several photos, as a model for Qt's views."""

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

from occ_gui.photo.match_figures import is_certain
from occ_gui.photo.match_result import SIGNS
from occ_gui.photo.shown_photo import ShownPhoto, known_of
from occ_gui.values.photo_results import ListedRows
from occ_gui.widgets.plain_text import LONGEST_TEXT, in_tool_tip
from occ_model.errors import ParameterError, one_line
from occ_model.photo.match_facts import LABELS
from occ_model.results.match import known_parameter, known_value
from occ_model.results.match_sentence import estimate_text
from occ_model.results.photo_table import DOUBTFUL, SURE, PhotoRow, assumption
from occ_model.scene.parameters import quantity
from occ_model.scene.refusal import refusal_of
from occ_model.scene.scene import Scene

_Index = QModelIndex | QPersistentModelIndex

PHOTO, VERDICT, KNOWN, ESTIMATE, EXPOSURE, RECORDED, CORRELATION, NOTE = range(8)

_NUMBER_COLUMNS = (KNOWN, ESTIMATE, EXPOSURE, RECORDED, CORRELATION)


class PhotoRowsModel(QAbstractTableModel):
    """The photos, with the result and the known value of each."""

    known_entered = Signal(int)  # the known value of the photo at this index was entered or removed

    refused = Signal(str)  # why a known value is refused; the last one stays

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._shown = ShownPhoto(Scene())
        self._entered_values: dict[str, dict[int, float]] = {}
        """Values entered for single photos, by the kind of value and the photo's index."""

    @property
    def paths(self) -> tuple[Path, ...]:
        return self._shown.choice.listed

    @property
    def _listed(self) -> ListedRows | None:
        return self._shown.listed

    @property
    def _estimate(self) -> str:
        if self._listed is None:
            return self._shown.choice.form.estimate
        return self._listed.settings.estimate

    @property
    def known(self) -> str:
        """The parameter that must be known of each photo."""
        if self._listed is None:
            return known_of(self._shown.choice.form, self._shown.scene)
        return known_parameter(self._estimate, self._listed.settings.scene.transmitter)

    def entered_values(self, name: str) -> tuple[tuple[int, float], ...]:
        """Return the values of a known parameter entered for single photos, in SI units."""
        return tuple(sorted(self._entered_values.get(_kind_of_value(name), {}).items()))

    def show_photo(self, shown: ShownPhoto) -> None:
        """Show the photos of the table, and which of them is open."""
        last = self._shown
        if shown.choice.listed != last.choice.listed:
            self.beginResetModel()
            self._shown, self._entered_values = shown, {}
            self.endResetModel()
            return
        self._shown = shown
        if self.paths and _values_of_rows(shown) != _values_of_rows(last):
            self.dataChanged.emit(self.index(0, PHOTO), self.index(len(self.paths) - 1, NOTE))
            self.headerDataChanged.emit(Qt.Orientation.Horizontal, KNOWN, ESTIMATE)

    def _row(self, place: int) -> PhotoRow | None:
        return None if self._listed is None else self._listed.rows.get(place)

    def _is_open(self, place: int) -> bool:
        return self._shown.photo is not None and self.paths[place] == self._shown.photo.path

    def _is_earlier(self, place: int) -> bool:
        """Whether the photo has been matched on its own since."""
        outcome = self._shown.outcome
        if outcome is None or outcome.match is None or outcome.is_listed:
            return False
        return self._is_open(place)

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
            case Qt.ItemDataRole.BackgroundRole if self._is_open(place):
                return QGuiApplication.palette().brush(QPalette.ColorRole.Highlight)
            case Qt.ItemDataRole.ForegroundRole if self._is_open(place):
                return QGuiApplication.palette().brush(QPalette.ColorRole.HighlightedText)
        return None

    def flags(self, index: _Index) -> Qt.ItemFlag:
        flags = super().flags(index)
        is_running = self._listed is not None and self._listed.is_running
        if index.column() == KNOWN and not is_running:
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
        self.dataChanged.emit(index, index)
        self.known_entered.emit(place)
        return True

    def _tool_tip_text(self, place: int, column: int) -> str:
        """Return what a cell depends on, or why the photo is not sure."""
        row, text = self._row(place), self.text(place, column)
        if column in (ESTIMATE, EXPOSURE) and text:
            is_own = row is not None and row.given is not None
            return text if is_own else f"{condition_of_table(self._shown)}{text}"
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
            known = self._entered_values.get(_kind_of_value(self.known), {}).get(place)
            if known is None and self._listed is not None:
                known = float(self._listed.settings.scene.value(self.known))
            return "" if known is None else quantity(self.known).format(known)
        row = self._row(place)
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
        table = None if self._listed is None else self._listed.table
        if table is not None and table.is_outlier(place):
            text += ", outlier"
        return f"{text}, earlier match" if self._is_earlier(place) else text


def _values_of_rows(shown: ShownPhoto) -> tuple[object, ...]:
    """Return what the rows and their header depend on."""
    choice, light = shown.choice, shown.scene.transmitter.light
    return shown.listed, shown.photo, shown.match, choice.certain, choice.form, light


def condition_of_table(shown: ShownPhoto) -> str:
    """Name the known value that the times of the table assume, unless the user is certain of it."""
    listed = shown.listed
    if listed is None or (listed.table is not None and not listed.table.rests_on_the_scene):
        return ""  # a value was entered for each photo
    estimate, scene = listed.settings.estimate, listed.settings.scene
    known = known_parameter(estimate, scene.transmitter)
    if is_certain(known, float(scene.value(known)), shown.choice.certain):
        return ""
    return assumption(*known_value(estimate, scene))


def _format_estimate(row: PhotoRow, name: str) -> str:
    value = getattr(row, name)
    return "" if value is None else estimate_text(quantity(name), value, row.uncertainty(name))


def _kind_of_value(known: str) -> str:
    """Return the kind of a known value; lamp and switching frequency are one kind."""
    return known if known == "readout_time" else "frequency"


def _alignment_of(column: int) -> Qt.AlignmentFlag:
    side = Qt.AlignmentFlag.AlignRight if column in _NUMBER_COLUMNS else Qt.AlignmentFlag.AlignLeft
    return side | Qt.AlignmentFlag.AlignVCenter
