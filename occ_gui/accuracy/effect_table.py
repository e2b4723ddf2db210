"""Table of effects: bound, decision of the plan, computing time, and a switch for each."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QFont, QPalette
from PySide6.QtWidgets import QComboBox, QHeaderView, QTableView, QWidget

from occ_gui.widgets.contrast import seen_on
from occ_gui.widgets.event_filters import keep_wheel_for_scrolling
from occ_gui.widgets.plot import REGION, SIMULATION
from occ_model.results import Decision, Frame

_Index = QModelIndex | QPersistentModelIndex

SWITCH, EFFECT, DECISION, BOUND, TIME, REASON = range(6)
"""The columns of the table."""

_TINT = QColor(REGION)
_TINT.setAlpha(70)

_LEADING = 7
"""Pixels between the rows: few, so that all effects fit into the pane."""

_STATES: tuple[bool | None, ...] = (None, True, False)
"""Choices of a switch: the plan decides, on, off."""


@dataclass(frozen=True, slots=True)
class EffectRow:
    """Contents of one row.

    Parameters
    ----------
    effect
        The effect's name.
    texts
        The text of each column.
    reason
        The reason for the decision, as a sentence.
    included
        Whether the effect is simulated.
    absent
        Whether the scene does not have the effect and it is not simulated.
    new
        Whether the plan has just switched it.
    """

    effect: str
    texts: tuple[str, ...]
    reason: str
    included: bool
    absent: bool
    new: bool


class EffectModel(QAbstractTableModel):
    """The rows of the table; only changed rows are reported to the view."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.rows: tuple[EffectRow, ...] = ()
        self._titles = {
            SWITCH: (self.tr("Switch"), self.tr("Whether the plan decides, or you.")),
            EFFECT: (self.tr("Effect"), self.tr("In the order that light travels.")),
            DECISION: (self.tr("Plan"), self.tr("Whether it is simulated.")),
            BOUND: (
                self.tr("Levels"),
                self.tr("How much leaving it out can change, in levels of the stretched profile."),
            ),
            TIME: (self.tr("ms"), self.tr("Its computing time in the picture shown.")),
            REASON: (self.tr("Why"), self.tr("The reason for the decision.")),
        }

    def show_frame(self, frame: Frame, new: Collection[str]) -> None:
        """Show a picture's plan and times, some effects marked as just switched."""
        rows = tuple(self._row(d, frame.timings, d.effect in new) for d in frame.plan.decisions)
        if [row.effect for row in rows] != [row.effect for row in self.rows]:
            self.beginResetModel()
            self.rows = rows
            self.endResetModel()
            return
        before, self.rows = self.rows, rows
        for place, (old, row) in enumerate(zip(before, rows, strict=True)):
            if old != row:
                self.dataChanged.emit(self.index(place, SWITCH), self.index(place, REASON))

    def _row(self, decision: Decision, timings: Mapping[str, float], new: bool) -> EffectRow:
        state = self.tr("● in") if decision.included else self.tr("○ out")
        texts = (
            "",
            decision.label,
            self.tr("{state}, new").format(state=state) if new else state,
            _levels(decision.bound) if decision.bound else self.tr("none"),
            _milliseconds(timings.get(decision.effect)) if decision.included else "",
            decision.why,
        )
        absent = not decision.bound and not decision.included
        sentence = f"{decision.label}: {decision.reason}"
        return EffectRow(decision.effect, texts, sentence, decision.included, absent, new)

    def rowCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 - Qt's
        """Count the effects."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008, N802 - Qt's
        """Count the columns."""
        return 0 if parent.isValid() else len(self._titles)

    def headerData(  # noqa: N802 - Qt's name
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        """Return the titles of the columns, and their meanings as tooltips."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        title, meaning = self._titles[section]
        if role == Qt.ItemDataRole.DisplayRole:
            return title
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _alignment(section)
        return meaning if role == Qt.ItemDataRole.ToolTipRole else None

    def data(self, index: _Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Return the text, tooltip, alignment and colours of a cell."""
        row, column = self.rows[index.row()], index.column()
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return row.texts[column]
            case Qt.ItemDataRole.ToolTipRole:
                return row.reason
            case Qt.ItemDataRole.TextAlignmentRole:
                return _alignment(column)
            case Qt.ItemDataRole.BackgroundRole:
                return _TINT if row.new else None
            case Qt.ItemDataRole.FontRole:
                return _bold() if column == DECISION and row.included else None
            case Qt.ItemDataRole.ForegroundRole:
                return _colour(row, column)
        return None


def _levels(bound: float) -> str:
    return f"{bound:.0f}" if 100.0 <= bound < 1e5 else f"{bound:.2g}"


def _milliseconds(seconds: float | None) -> str:
    """Format a time; an effect that is computed together with another one has none of its own."""
    if seconds is None:
        return "0"
    return f"{1e3 * seconds:.2f}" if seconds < 0.01 else f"{1e3 * seconds:.1f}"


def _alignment(column: int) -> Qt.AlignmentFlag:
    side = Qt.AlignmentFlag.AlignRight if column in (BOUND, TIME) else Qt.AlignmentFlag.AlignLeft
    return side | Qt.AlignmentFlag.AlignVCenter


def _bold() -> QFont:
    font = QFont()
    font.setBold(True)
    return font


def _colour(row: EffectRow, column: int) -> QColor | None:
    if row.absent:
        return QPalette().color(QPalette.ColorGroup.Disabled, QPalette.ColorRole.Text)
    return seen_on(QPalette(), SIMULATION) if column == DECISION and row.included else None


class _FlatSwitch(QComboBox):
    """A combo box as low as a row of the table."""

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the smallest size that shows the text."""
        return QSize(super().minimumSizeHint().width(), self.fontMetrics().height() + _LEADING)


class EffectTable(QTableView):
    """The table of effects with a switch in each row."""

    switched = Signal(str, object)
    """An effect's name, and the choice: True (on), False (off) or None (the plan decides)."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.effects = EffectModel(self)
        self.switches: dict[str, QComboBox] = {}
        self._force: Mapping[str, bool] = {}
        self.setModel(self.effects)
        self.setAccessibleName(self.tr("Effects"))
        font = self.font()
        font.setPointSizeF(0.9 * font.pointSizeF())
        self.setFont(font)
        self.setShowGrid(False)
        self.setWordWrap(False)
        self.setTabKeyNavigation(False)
        self.setSelectionMode(QTableView.SelectionMode.NoSelection)
        self.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.setVerticalScrollMode(QTableView.ScrollMode.ScrollPerPixel)
        self.setHorizontalScrollMode(QTableView.ScrollMode.ScrollPerPixel)
        self.verticalHeader().hide()
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setStretchLastSection(True)
        header.setMinimumSectionSize(24)
        self.effects.modelReset.connect(self._make_switches)

    def show_frame(self, frame: Frame, new: Collection[str]) -> None:
        """Show a picture's plan and times, some effects marked as just switched."""
        self.effects.show_frame(frame, new)

    def bring_into_view(self, effects: Collection[str]) -> None:
        """Scroll to the first of these effects."""
        for place, row in enumerate(self.effects.rows):
            if row.effect in effects:
                self.scrollTo(self.effects.index(place, EFFECT))
                return

    def show_force(self, force: Mapping[str, bool]) -> None:
        """Show which effects the user has switched, without emitting a signal."""
        self._force = force
        for effect, switch in self.switches.items():
            switch.setCurrentIndex(_STATES.index(force.get(effect)))

    def _make_switches(self) -> None:
        self.switches = {}
        for place, row in enumerate(self.effects.rows):
            switch = self._switch(row)
            self.switches[row.effect] = switch
            self.setIndexWidget(self.effects.index(place, SWITCH), switch)
        self.show_force(self._force)
        self._size_sections()

    def _switch(self, row: EffectRow) -> QComboBox:
        switch = _FlatSwitch()
        switch.setFont(self.font())
        switch.addItems([self.tr("auto"), self.tr("on"), self.tr("off")])
        switch.setAccessibleName(self.tr("Switch: {label}").format(label=row.texts[EFFECT]))
        switch.setToolTip(
            self.tr("{label}\nauto: the plan decides; on, off: you do.").format(
                label=row.texts[EFFECT]
            )
        )
        keep_wheel_for_scrolling(switch)
        switch.activated.connect(lambda index: self.switched.emit(row.effect, _STATES[index]))
        return switch

    def _size_sections(self) -> None:
        """Make every column but the last as wide as its widest text."""
        header, metrics = self.horizontalHeader(), self.fontMetrics()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        self.resizeColumnToContents(EFFECT)
        switch = next(iter(self.switches.values()))
        header.resizeSection(SWITCH, switch.minimumSizeHint().width() + 4)
        self.verticalHeader().setDefaultSectionSize(switch.minimumSizeHint().height())
        for column, widest in ((BOUND, "8.8e+08"), (DECISION, "● out, new "), (TIME, "8888.88")):
            header.resizeSection(column, metrics.horizontalAdvance(widest) + 14)
