"""Table of effects: picture, error, computing time and switch of each."""

from collections.abc import Collection, Mapping, Sequence
from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QEvent,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QSize,
    Qt,
    QTimer,
    Signal,
)
from PySide6.QtGui import QColor, QMouseEvent, QPalette, QResizeEvent
from PySide6.QtWidgets import QComboBox, QHeaderView, QTableView

from occ_gui.accuracy.effect_cells import ErrorCell, PictureCell, TimeCell, find_levels
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
from occ_gui.widgets.event_filters import keep_wheel_for_scrolling
from occ_model.scene.scene import TOLERANCE

_Index = QModelIndex | QPersistentModelIndex

_TINT = QColor(REGION)
_TINT.setAlpha(48)

_ROW_MARGINS = 2, 14  # pixels around the text of a row in a low pane and in a high one

_LEAST_ROWS = 4  # fewest visible rows; the others scroll, so that the window fits its screen

_EMPTY_TABLE_ROWS = 11  # rows that an empty table has room for

_PICTURE_WIDTH = 92
_TIME_WIDTH = 104
_ERROR_WIDTH = 116
_STATES: tuple[bool | None, ...] = (None, True, False)
"""Choices of a switch: the plan decides, on, off."""


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
                return "" if column == STAGE and is_same else _format_cell(row, column)
            case Qt.ItemDataRole.ToolTipRole:
                return row.error_meaning if column == ERROR and row.error_text else row.reason
            case Qt.ItemDataRole.TextAlignmentRole:
                return _align(column)
            case Qt.ItemDataRole.BackgroundRole:
                return _TINT if row.is_new or row.pending is not None else None
            case Qt.ItemDataRole.ForegroundRole:
                return _find_colour(row, column)
        return None


def _format_cell(row: EffectRow, column: int) -> str:
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


class _FlatSwitch(QComboBox):
    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        # Qt does not update its least width when the size of text changes.
        return QSize(self.sizeHint().width(), self.fontMetrics().height() + _ROW_MARGINS[0])


class EffectTable(QTableView):
    switched = Signal(str, object)
    """An effect's name, and the choice: True (on), False (off) or None (the plan decides)."""

    chosen = Signal(str)  # the effect whose row is selected

    tolerance_dragged = Signal(float)

    def __init__(self) -> None:
        super().__init__()
        self.effects = EffectModel(self)
        self._tolerance = TOLERANCE.default
        self._dragged_column = -1
        self._widths: dict[int, int] = {}
        self.switches: dict[str, QComboBox] = {}
        self._force: Mapping[str, bool] = {}
        self.setModel(self.effects)
        self.setAccessibleName("Effects")
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.setSelectionBehavior(QTableView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QTableView.SelectionMode.SingleSelection)
        self.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.setVerticalScrollMode(QTableView.ScrollMode.ScrollPerPixel)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setItemDelegateForColumn(PICTURE, PictureCell(lambda: self.effects.rows, self))
        self.setItemDelegateForColumn(
            ERROR, ErrorCell(lambda: self.effects.rows, lambda: self._tolerance, self)
        )
        self.setItemDelegateForColumn(TIME, TimeCell(lambda: self.effects.rows, self))
        header = self.horizontalHeader()
        self.verticalHeader().hide()
        header.setHighlightSections(False)
        header.setSortIndicator(STAGE, Qt.SortOrder.AscendingOrder)
        header.setSortIndicatorClearable(True)
        self.setSortingEnabled(True)
        header.setMinimumSectionSize(24)
        self.effects.modelReset.connect(self._make_switches)
        self.selectionModel().currentRowChanged.connect(self._choose)

    def show_rows(self, rows: Sequence[EffectRow]) -> None:
        self.effects.show_rows(rows)

    def show_tolerance(self, tolerance: float) -> None:
        self._tolerance = tolerance
        self.viewport().update()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        super().mousePressEvent(event)
        self._drag(event, self.columnAt(int(event.position().x())))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        if not self._drag(event, self._dragged_column):
            super().mouseMoveEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        self._dragged_column = -1
        super().mouseReleaseEvent(event)

    def _drag(self, event: QMouseEvent, column: int) -> bool:
        is_pressed = bool(event.buttons() & Qt.MouseButton.LeftButton)
        if column != ERROR or not is_pressed or not self.effects.rows:
            return False
        self._dragged_column = column
        area = self.visualRect(self.effects.index(0, ERROR))
        levels = find_levels(event.position().x(), area)
        self.show_tolerance(levels)
        self.tolerance_dragged.emit(levels)
        return True

    def bring_into_view(self, effects: Collection[str]) -> None:
        for place, row in enumerate(self.effects.rows):
            if row.effect in effects:
                self.scrollTo(self.effects.index(place, EFFECT))
                return

    def choose(self, effect: str) -> None:
        for place, row in enumerate(self.effects.rows):
            if row.effect == effect:
                self.selectRow(place)

    def show_force(self, force: Mapping[str, bool]) -> None:
        self._force = force
        for effect, switch in self.switches.items():
            switch.setCurrentIndex(_STATES.index(force.get(effect)))

    def _choose(self, current: QModelIndex) -> None:
        if current.isValid():
            self.chosen.emit(self.effects.rows[current.row()].effect)

    def _make_switches(self) -> None:
        self.switches = {}
        for place, row in enumerate(self.effects.rows):
            if row.effect == EVERYTHING_ELSE:
                continue
            switch = self._make_switch(row)
            self.switches[row.effect] = switch
            self.setIndexWidget(self.effects.index(place, SWITCH), switch)
        self.show_force(self._force)
        self._size_columns()
        self._size_rows()

    def _make_switch(self, row: EffectRow) -> QComboBox:
        switch = _FlatSwitch()
        switch.addItems(["plan", "on", "off"])
        switch.setAccessibleName(f"Switch: {row.label}")
        switch.setToolTip(f"{row.label}\nplan: decided automatically; on, off: always.")
        keep_wheel_for_scrolling(switch)
        switch.activated.connect(lambda index: self.switched.emit(row.effect, _STATES[index]))
        return switch

    def _size_columns(self) -> None:
        """Fit the columns to their texts; the name takes the rest of the width."""
        header, metrics = self.horizontalHeader(), self.fontMetrics()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        for column in (PICTURE, STAGE):
            self.setColumnHidden(column, False)
        switch = next(iter(self.switches.values()))
        for column, width in (
            (STAGE, max(metrics.horizontalAdvance("Sensor") + 8, self._title_width(STAGE))),
            (PICTURE, max(_PICTURE_WIDTH, self._title_width(PICTURE))),
            (ERROR, max(_ERROR_WIDTH, self._title_width(ERROR))),
            (TIME, max(_TIME_WIDTH, self._title_width(TIME))),
            (SWITCH, max(switch.minimumSizeHint().width() + 4, self._title_width(SWITCH))),
        ):
            header.resizeSection(column, width)
            self._widths[column] = width
        header.setSectionResizeMode(EFFECT, QHeaderView.ResizeMode.Stretch)
        self._hide_columns()

    def _hide_columns(self) -> None:
        """Hide the least informative columns where names would be cut off."""
        metrics = self.fontMetrics()
        texts = (_format_cell(row, EFFECT) for row in self.effects.rows)
        room = self.viewport().width() - 8
        room -= max((metrics.horizontalAdvance(text) + 8 for text in texts), default=0)
        room -= sum(self._widths.get(column, 0) for column in (ERROR, TIME, SWITCH))
        for column in (PICTURE, STAGE):
            room -= self._widths.get(column, 0)
            self.setColumnHidden(column, room < 0)

    def _title_width(self, column: int) -> int:
        """Return a title's width, which has room for an arrow only where a click sorts."""
        header = self.horizontalHeader()
        header.setSortIndicatorShown(column in SORTABLE)
        width = header.sectionSizeHint(column)
        header.setSortIndicatorShown(True)
        return width

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._size_rows()
        self._hide_columns()

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and getattr(self, "switches", None):
            QTimer.singleShot(0, self, self._size_columns)  # once the switches have the font, too
            self._size_rows()

    def _row_heights(self) -> tuple[int, int]:
        """Return the height in pixels of a row in a low pane, and in a high one."""
        lowest, highest = (self.fontMetrics().height() + margin for margin in _ROW_MARGINS)
        return lowest, highest

    def _size_rows(self) -> None:
        rows, (lowest, highest) = self.verticalHeader(), self._row_heights()
        height = self.viewport().height() // max(1, len(self.effects.rows))
        rows.setMinimumSectionSize(lowest)
        rows.setDefaultSectionSize(min(max(height, lowest), highest))

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        height = (1 + _LEAST_ROWS) * self._row_heights()[0] + 2 * self.frameWidth()
        return QSize(super().minimumSizeHint().width(), height)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        rows = len(self.effects.rows) or _EMPTY_TABLE_ROWS
        lowest, highest = self._row_heights()
        height = lowest + rows * highest + 2 * self.frameWidth()
        return QSize(super().sizeHint().width(), height)
