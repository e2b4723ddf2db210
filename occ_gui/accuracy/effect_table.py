"""Table of effects: picture, error, computing time and switch of each."""

from collections.abc import Collection, Mapping, Sequence

from PySide6.QtCore import (
    QEvent,
    QModelIndex,
    QSize,
    Qt,
    QTimer,
    Signal,
)
from PySide6.QtGui import QMouseEvent, QResizeEvent
from PySide6.QtWidgets import QComboBox, QHeaderView, QTableView

from occ_gui.accuracy.effect_cells import ErrorCell, PictureCell, TimeCell, find_levels
from occ_gui.accuracy.effect_model import EffectModel, format_cell
from occ_gui.accuracy.effect_rows import (
    EFFECT,
    ERROR,
    EVERYTHING_ELSE,
    PICTURE,
    SORTABLE,
    STAGE,
    SWITCH,
    TIME,
    EffectRow,
)
from occ_gui.widgets.event_filters import keep_wheel_for_scrolling
from occ_model.scene.scene import TOLERANCE

_ROW_MARGINS = 2, 14  # pixels around the text of a row in a low pane and in a high one

_LEAST_ROWS = 4  # fewest visible rows; the others scroll, so that the window fits its screen

_EMPTY_TABLE_ROWS = 11  # rows that an empty table has room for

_PICTURE_WIDTH = 92
_TIME_WIDTH = 104
_ERROR_WIDTH = 116
_STATES: tuple[bool | None, ...] = (None, True, False)
"""Choices of a switch: the plan decides, on, off."""


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
            (STAGE, max(metrics.horizontalAdvance("Sensor") + 8, self._measure_title(STAGE))),
            (PICTURE, max(_PICTURE_WIDTH, self._measure_title(PICTURE))),
            (ERROR, max(_ERROR_WIDTH, self._measure_title(ERROR))),
            (TIME, max(_TIME_WIDTH, self._measure_title(TIME))),
            (SWITCH, max(switch.minimumSizeHint().width() + 4, self._measure_title(SWITCH))),
        ):
            header.resizeSection(column, width)
            self._widths[column] = width
        header.setSectionResizeMode(EFFECT, QHeaderView.ResizeMode.Stretch)
        self._hide_columns()

    def _hide_columns(self) -> None:
        """Hide the least informative columns where names would be cut off."""
        metrics = self.fontMetrics()
        texts = (format_cell(row, EFFECT) for row in self.effects.rows)
        room = self.viewport().width() - 8
        room -= max((metrics.horizontalAdvance(text) + 8 for text in texts), default=0)
        room -= sum(self._widths.get(column, 0) for column in (ERROR, TIME, SWITCH))
        for column in (PICTURE, STAGE):
            room -= self._widths.get(column, 0)
            self.setColumnHidden(column, room < 0)

    def _measure_title(self, column: int) -> int:
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

    def _find_row_heights(self) -> tuple[int, int]:
        """Return the height in pixels of a row in a low pane, and in a high one."""
        lowest, highest = (self.fontMetrics().height() + margin for margin in _ROW_MARGINS)
        return lowest, highest

    def _size_rows(self) -> None:
        rows, (lowest, highest) = self.verticalHeader(), self._find_row_heights()
        height = self.viewport().height() // max(1, len(self.effects.rows))
        rows.setMinimumSectionSize(lowest)
        rows.setDefaultSectionSize(min(max(height, lowest), highest))

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        height = (1 + _LEAST_ROWS) * self._find_row_heights()[0] + 2 * self.frameWidth()
        return QSize(super().minimumSizeHint().width(), height)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        rows = len(self.effects.rows) or _EMPTY_TABLE_ROWS
        lowest, highest = self._find_row_heights()
        height = lowest + rows * highest + 2 * self.frameWidth()
        return QSize(super().sizeHint().width(), height)
