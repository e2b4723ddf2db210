"""Rows of the table of several photos, as a model for Qt's views."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QPersistentModelIndex, Qt

from occ_gui.photo.match_values import label_of, with_uncertainty
from occ_gui.photo.verdict_view import SIGNS
from occ_gui.widgets.plain_text import LONGEST, in_tool_tip
from occ_model.errors import one_line
from occ_model.results import PhotoRow, PhotoTable
from occ_model.results.photo_table import DOUBTFUL, REFUSED, SURE, UNREADABLE
from occ_model.scene.parameters import quantity

_Index = QModelIndex | QPersistentModelIndex

PHOTO, VERDICT, ESTIMATE, EXPOSURE, NOTED, CORRELATION, NOTE = range(7)
"""The columns of the table."""

_NUMBERS = (ESTIMATE, EXPOSURE, NOTED, CORRELATION)


class PhotoRowsModel(QAbstractTableModel):
    """The photos, with what was found in each so far."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.paths: tuple[Path, ...] = ()
        self._rows: dict[int, PhotoRow] = {}
        self._table: PhotoTable | None = None
        self._estimate = "readout_time"
        self._condition = ""
        self._earlier: Path | None = None

    def show_files(self, paths: Sequence[Path]) -> None:
        """Show these files, none of which is matched yet."""
        self.beginResetModel()
        self.paths = tuple(paths)
        self._rows, self._table, self._earlier = {}, None, None
        self.endResetModel()

    def show_begun(self, estimate: str) -> None:
        """Forget what was found: all photos are matched anew, for this parameter."""
        self.beginResetModel()
        self._rows, self._table, self._estimate = {}, None, estimate
        self._earlier = None
        self.endResetModel()

    def show_row(self, place: int, row: PhotoRow) -> None:
        """Show what was found in a photo."""
        self._rows[place] = row
        self.dataChanged.emit(self.index(place, PHOTO), self.index(place, NOTE))

    def show_table(self, table: PhotoTable) -> None:
        """Show the complete table, with its outliers."""
        self._rows, self._table = dict(enumerate(table.rows)), table
        self.dataChanged.emit(self.index(0, PHOTO), self.index(len(table.rows) - 1, NOTE))

    def show_condition(self, condition: str) -> None:
        """Show the value that the times rest on where it is assumed; empty where it is certain."""
        self._condition = condition

    def show_earlier(self, path: Path | None) -> None:
        """Say of the photo that was matched by itself since that its row is of an earlier match."""
        if path == self._earlier:
            return
        self._earlier = path
        self.dataChanged.emit(self.index(0, PHOTO), self.index(len(self.paths) - 1, NOTE))

    def row_of(self, path: Path) -> PhotoRow | None:
        """Return what was found in the photo of a file, None where nothing was found so far."""
        return next((row for row in self._rows.values() if row.path == path), None)

    def rowCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 - Qt's
        """Count the photos."""
        return 0 if parent.isValid() else len(self.paths)

    def columnCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 - Qt's
        """Count the columns."""
        return 0 if parent.isValid() else NOTE + 1

    def headerData(  # noqa: N802 - Qt's name
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        """Return the titles of the columns."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _alignment(section)
        return self._titles()[section] if role == Qt.ItemDataRole.DisplayRole else None

    def _titles(self) -> tuple[str, ...]:
        return (
            self.tr("Photo"),
            self.tr("Verdict"),
            label_of(self._estimate),
            label_of("exposure_time"),
            self.tr("As noted"),
            self.tr("Correlation"),
            self.tr("Why"),
        )

    def data(self, index: _Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Return the text, tooltip and alignment of a cell."""
        place, column = index.row(), index.column()
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return self.text(place, column)
            case Qt.ItemDataRole.ToolTipRole:
                return in_tool_tip(self._tip(place, column))
            case Qt.ItemDataRole.TextAlignmentRole:
                return _alignment(column)
        return None

    def _tip(self, place: int, column: int) -> str:
        """Return what a cell rests on, or why the photo is not sure."""
        row = self._rows.get(place)
        text = self.text(place, column)
        if column in (ESTIMATE, EXPOSURE) and text:
            return f"{self._condition}{text}"
        if column == NOTE and row is not None and row.note:
            return one_line(row.note, LONGEST)
        return str(self.paths[place])

    def text(self, place: int, column: int) -> str:
        """Return the text of a cell."""
        if column == PHOTO:
            return one_line(self.paths[place].name)
        row = self._rows.get(place)
        if row is None:
            return ""
        match column:
            case 1:
                return self._verdict(place, row)
            case 2:
                return _estimate(row, self._estimate)
            case 3:
                text = _estimate(row, "exposure_time")
                # Of a doubtful photo all is.
                is_apart = row.verdict == SURE and row.exposure_verdict == DOUBTFUL
                return self.tr("{time} (doubtful)").format(time=text) if is_apart else text
            case 4:
                noted = row.noted_exposure
                return "" if noted is None else quantity("exposure_time").format(noted, 4)
            case 5:
                return "" if row.correlation is None else f"{row.correlation:.3f}"
        return one_line(row.note, 1000)

    def _verdict(self, place: int, row: PhotoRow) -> str:
        names = {
            SURE: self.tr("sure"),
            DOUBTFUL: self.tr("doubtful"),
            REFUSED: self.tr("refused"),
            UNREADABLE: self.tr("unreadable"),
        }
        name = names[row.verdict]
        if self._table is not None and self._table.is_outlier(place):
            name = self.tr("{verdict}, outlier").format(verdict=name)
        if self.paths[place] == self._earlier:
            name = self.tr("{verdict}, earlier match").format(verdict=name)
        return f"{SIGNS[row.verdict]} {name}"


def _estimate(row: PhotoRow, name: str) -> str:
    value = getattr(row, name)
    return "" if value is None else with_uncertainty(quantity(name), value, row.uncertainty(name))


def _alignment(column: int) -> Qt.AlignmentFlag:
    side = Qt.AlignmentFlag.AlignRight if column in _NUMBERS else Qt.AlignmentFlag.AlignLeft
    return side | Qt.AlignmentFlag.AlignVCenter
