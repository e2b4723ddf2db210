"""Pane of the comparison: the differences between two pinned scenes, and both profiles."""

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QSplitter,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from occ_gui.pins.comparison import DifferenceRow, Pin, PinnedPair
from occ_gui.pins.pin_controller import PinController
from occ_gui.shell.feature import Pane
from occ_gui.widgets.building import fill, make_read_only, paragraph, push_button
from occ_gui.widgets.colours import BAND, SIMULATION, thin_pen
from occ_gui.widgets.columns import PACKETS_IN_VIEW
from occ_gui.widgets.plain_text import in_tool_tip
from occ_gui.widgets.plot import LineLegend, new_plot

_LEAST_TABLE_WIDTH = 250  # pixels


class CompareView(QWidget):
    """Buttons to pin scenes, the table of differences, and the profiles of A and B."""

    pin_asked = Signal(str)  # the user pins the present scene as "A" or "B"

    go_asked = Signal(str)
    clear_asked = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.pin_buttons = {
            name: push_button(
                f"Pin {name}",
                f"Keep the present scene as {name}, to compare it (Ctrl+Shift+{name}).",
                lambda _=False, name=name: self.pin_asked.emit(name),
            )
            for name in ("A", "B")
        }
        self.return_buttons = {
            name: push_button(
                f"Go to {name}",
                f"Return to the scene of {name}, as one step that can be undone.",
                lambda _=False, name=name: self.go_asked.emit(name),
            )
            for name in ("A", "B")
        }
        self.clear = push_button("Clear", "Forget A and B.", self.clear_asked, name="Clear A and B")
        self.hint = paragraph()
        self._make_table()
        self._make_plot()
        self._lay_out()
        self.show_pinned(PinnedPair())

    def _make_table(self) -> None:
        tip = "Inputs that differ between A and B, then outputs."
        self.table = make_read_only(QTableWidget(0, 3), "Differences between A and B", tip)
        self.table.setHorizontalHeaderLabels(["Difference", "A", "B"])
        # A row with a long sentence can be higher than the table.
        self.table.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.table.setMinimumWidth(_LEAST_TABLE_WIDTH)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
        for column in (1, 2):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Stretch)
        # Rows are fitted after the columns, because the height of a sentence depends on the width
        # of its column.
        self._fitting = QTimer(self, singleShot=True)
        self._fitting.setInterval(0)
        self._fitting.timeout.connect(self.table.resizeRowsToContents)
        header.sectionResized.connect(lambda: self._fitting.start())

    def _make_plot(self) -> None:
        self.plot = new_plot(
            "The camera's column profiles of A and B, before enhancement",
            "column, before enhancement",
            "grey level",
        )
        self.plot.show_extremes()
        pens = {"A": thin_pen(SIMULATION), "B": thin_pen(BAND, Qt.PenStyle.DashLine)}
        self.legend = LineLegend()
        for name, pen in pens.items():
            self.legend.add_line(name, pen, name)
        self.curves = {name: self.plot.add_curve(pen) for name, pen in pens.items()}

    def _lay_out(self) -> None:
        buttons = (
            group[name] for name in ("A", "B") for group in (self.pin_buttons, self.return_buttons)
        )
        row = fill(QHBoxLayout(), *buttons, self.clear, (None, 1), self.legend)
        panes = self._panes = QSplitter(Qt.Orientation.Horizontal)
        panes.addWidget(self.table)
        panes.addWidget(self.plot)
        panes.setChildrenCollapsible(False)
        panes.setSizes([560, 380])
        fill(QVBoxLayout(self), self.hint, row, (panes, 1), None, margins=(4, 2, 4, 2), spacing=2)

    def show_pinned(self, pinned: PinnedPair) -> None:
        pins: dict[str, Pin | None] = {"A": pinned.a, "B": pinned.b}
        for name, pin in pins.items():
            self.return_buttons[name].setEnabled(pin is not None)
            self.legend.show_line(name, pin is not None)
            self.curves[name].setData([] if pin is None else pin.profile)
        existing = [pin for pin in pins.values() if pin is not None]
        self.clear.setEnabled(bool(existing))
        self.hint.setText(self._describe_next_step(pinned))
        self.hint.setVisible(bool(self.hint.text()))
        self._panes.setVisible(bool(existing))
        self.table.setVisible(len(existing) == len(pins))
        self._fill(pinned)
        if existing:
            self._fit_ranges(existing)

    def _describe_next_step(self, pinned: PinnedPair) -> str:
        if pinned.a is None and pinned.b is None:
            return (
                "To compare two scenes, press Pin A to keep the present one, change it with the "
                "sliders, and press Pin B. The differences are listed here, beside both profiles."
            )
        if pinned.a is None or pinned.b is None:
            name = "A" if pinned.a is None else "B"
            pinned_name = "B" if name == "A" else "A"
            return (
                f"{pinned_name} is pinned. Change the scene with the sliders, and press Pin "
                f"{name}: the differences are listed here."
            )
        return "" if pinned.inputs else "A and B are the same scene."

    def _fill(self, pinned: PinnedPair) -> None:
        sections = (("Inputs", pinned.inputs), ("Outputs", pinned.outputs))
        self.table.clearSpans()
        self.table.setRowCount(0)
        for title, rows in sections:
            if rows:
                self._add_title(title)
            for row in rows:
                self._add_row(row)
        self.table.resizeRowsToContents()

    def _add_title(self, title: str) -> None:
        row = self.table.rowCount()
        self.table.insertRow(row)
        item = QTableWidgetItem(title)
        font = item.font()
        font.setBold(True)
        item.setFont(font)
        item.setFlags(Qt.ItemFlag.ItemIsEnabled)
        self.table.setItem(row, 0, item)
        self.table.setSpan(row, 0, 1, 3)

    def _add_row(self, row: DifferenceRow) -> None:
        index = self.table.rowCount()
        self.table.insertRow(index)
        for column, text in enumerate((row.name, row.a, row.b)):
            item = QTableWidgetItem(text)
            item.setToolTip(in_tool_tip(row.meaning if column == 0 else text))
            item.setTextAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop)
            self.table.setItem(index, column, item)

    def _fit_ranges(self, pins: list[Pin]) -> None:
        """Show the first packets of both scenes, and levels from black to the largest."""
        first = min(pin.first_column for pin in pins)
        last = max(pin.first_column + PACKETS_IN_VIEW * pin.period_columns for pin in pins)
        last = min(last, max(len(pin.profile) - 1.0 for pin in pins))
        self.plot.setXRange(first, max(last, first + 1.0), padding=0.01)
        largest = max(float(pin.profile.max()) for pin in pins)
        self.plot.setYRange(0.0, max(20.0, largest), padding=0.06)


class ComparePane(Pane[None]):
    def __init__(self, pins: PinController) -> None:
        view = CompareView()
        super().__init__(view)
        self.view = view
        self._pins = pins
        self._is_visible, self._drawn_pair = False, PinnedPair()
        view.pin_asked.connect(pins.pin)
        view.go_asked.connect(pins.go_to)
        view.clear_asked.connect(pins.clear)
        pins.changed.connect(self._show)

    def _show(self) -> None:
        pinned = self._pins.pinned
        if self._is_visible and pinned is not self._drawn_pair:  # else zoom and scrolling stay
            self._drawn_pair = pinned
            self.view.show_pinned(pinned)

    def set_visible(self, visible: bool) -> None:
        self._is_visible = visible
        self._show()
