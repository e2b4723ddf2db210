"""Model of the table of effects: its rows, their order, titles, texts and colours."""

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    Qt,
)
from PySide6.QtGui import QColor, QPalette

from occ_gui.accuracy.effect_rows import (
    EFFECT,
    ERROR,
    EVERYTHING_ELSE,
    LIGHT_ORDER,
    PICTURE,
    SORTABLE,
    STAGE,
    SWITCH,
    TIME,
    EffectRow,
    Order,
    find_longest_time,
    sort_rows,
)
from occ_gui.widgets.colours import REGION

_Index = QModelIndex | QPersistentModelIndex

_TINT = QColor(REGION)
_TINT.setAlpha(48)


class EffectModel(QAbstractTableModel):
    """The rows of the table; only changed rows are reported to the view."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.rows: tuple[EffectRow, ...] = ()
        self._unsorted_rows: tuple[EffectRow, ...] = ()
        self._order: Order = LIGHT_ORDER
        self._titles = {
            STAGE: ("Where", "Where on the light's path it occurs."),
            PICTURE: (
                "with | without",
                "The effect alone: a part of the panel with it, and without it.",
            ),
            EFFECT: ("Effect", "● in the picture, ○ left out."),
            ERROR: (
                "Error without",
                (
                    "How much the picture would change without it, in levels: its darkest and its "
                    "brightest column are 255 levels apart. For the decision, in margins: "
                    "at 1 a chip could be misread.\nThe dot is measured; until then the number "
                    "is an estimate (≈). The whisker ends at the plan's limit. The line "
                    "through all rows is the tolerance; drag it."
                ),
            ),
            TIME: (
                "Time (ms)",
                (
                    "Its shortest time in pictures of this scene; in brackets, what it would add.\n"
                    "When sorted, effects whose times hardly differ keep their order."
                ),
            ),
            SWITCH: ("Switch", "Automatic (plan), always on, or always off."),
        }

    def show_rows(self, rows: Sequence[EffectRow]) -> None:
        self._unsorted_rows = tuple(rows)
        effects = [row.effect for row in self.rows]
        sorted_rows = sort_rows(rows, self._order, effects)
        if {row.effect for row in sorted_rows} != set(effects):
            self.beginResetModel()
            self.rows = sorted_rows
            self.endResetModel()
            return
        if [row.effect for row in sorted_rows] != effects:
            self._reorder(sorted_rows)
            return
        old_rows, self.rows = self.rows, sorted_rows
        are_bars_rescaled = find_longest_time(old_rows) != find_longest_time(rows)
        for place, (old, row) in enumerate(zip(old_rows, sorted_rows, strict=True)):
            if old != row or are_bars_rescaled:
                self.dataChanged.emit(self.index(place, STAGE), self.index(place, SWITCH))

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        """Sort by a column; one without an order restores the order in which light passes."""
        is_descending = order == Qt.SortOrder.DescendingOrder
        self._order = (column, is_descending) if column in SORTABLE else LIGHT_ORDER
        rows = sort_rows(self._unsorted_rows, self._order)
        if [row.effect for row in rows] != [row.effect for row in self.rows]:
            self._reorder(rows)

    def _reorder(self, rows: tuple[EffectRow, ...]) -> None:
        """Reorder the same effects, together with selection and switches."""
        self.layoutAboutToBeChanged.emit()
        old_indexes = self.persistentIndexList()
        effects = [self.rows[index.row()].effect for index in old_indexes]
        self.rows = rows
        places = {row.effect: place for place, row in enumerate(rows)}
        new_indexes = [
            self.index(places[effect], index.column())
            for effect, index in zip(effects, old_indexes, strict=True)
        ]
        self.changePersistentIndexList(old_indexes, new_indexes)
        self.layoutChanged.emit()

    def rowCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 - Qt's
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 - Qt's
        return 0 if parent.isValid() else len(self._titles)

    def headerData(  # noqa: N802 - Qt's name
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        if orientation != Qt.Orientation.Horizontal:
            return None
        title, meaning = self._titles[section]
        if role == Qt.ItemDataRole.DisplayRole:
            return title
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _align(section)
        if role == Qt.ItemDataRole.InitialSortOrderRole:
            is_descending = section in (ERROR, TIME)
            return Qt.SortOrder.DescendingOrder if is_descending else Qt.SortOrder.AscendingOrder
        return meaning if role == Qt.ItemDataRole.ToolTipRole else None

    def data(self, index: _Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        row, column = self.rows[index.row()], index.column()
        match role:
            case Qt.ItemDataRole.DisplayRole:
                place = index.row()
                is_same = place > 0 and self.rows[place - 1].stage == row.stage
                return "" if column == STAGE and is_same else format_cell(row, column)
            case Qt.ItemDataRole.ToolTipRole:
                return row.error_meaning if column == ERROR and row.error_text else row.reason
            case Qt.ItemDataRole.TextAlignmentRole:
                return _align(column)
            case Qt.ItemDataRole.BackgroundRole:
                return _TINT if row.is_new or row.pending is not None else None
            case Qt.ItemDataRole.ForegroundRole:
                return _find_colour(row, column)
        return None


def format_cell(row: EffectRow, column: int) -> str:
    if column == EFFECT:
        if row.effect == EVERYTHING_ELSE:
            return row.label
        dot = "●" if row.included else "○"
        change = {None: "", True: " → ●", False: " → ○"}[row.pending]
        return f"{dot}{change} {row.label}"
    return {STAGE: row.stage, ERROR: row.error_text, TIME: row.time_text}.get(column, "")


def _align(column: int) -> Qt.AlignmentFlag:
    side = Qt.AlignmentFlag.AlignRight if column in (ERROR, TIME) else Qt.AlignmentFlag.AlignLeft
    return side | Qt.AlignmentFlag.AlignVCenter


def _find_colour(row: EffectRow, column: int) -> QColor | None:
    if row.is_absent and column != STAGE:
        return QPalette().color(QPalette.ColorGroup.Disabled, QPalette.ColorRole.Text)
    return None
