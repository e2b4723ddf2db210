"""Form of the lamps in a photo: a button that finds them, their table, and a region by hand."""

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.scene.units import NONE

_MOST_ROWS = 6
"""Rows of the table that are seen without scrolling."""

_ROW_HEIGHT = 24


class LampForm(QWidget):
    """What of a photo is matched: all of it, one of its lamps, or a rectangle drawn by hand."""

    find_asked = Signal()
    chosen = Signal(int)
    """The user chose the lamp of this index."""

    by_hand_chosen = Signal(bool)
    """Whether the user matches a rectangle drawn on the photo."""

    whole_asked = Signal()
    """The user matches the whole photo again."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.search = QPushButton("Find &lamps")
        self.search.setToolTip(
            "Find every lamp in the photo, and whether its light changes while the picture is "
            "read out. Choose one to match it by itself."
        )
        self.search.clicked.connect(self.find_asked)
        self.by_hand = QPushButton("Re&gion by hand")
        self.by_hand.setCheckable(True)
        self.by_hand.setToolTip(
            "Match only a rectangle: drag on the photo beside it to draw another one, its "
            "middle to move it, and its corners to make it larger or smaller."
        )
        self.by_hand.toggled.connect(self.by_hand_chosen)
        self.whole = QPushButton("&Whole photo")
        self.whole.setToolTip("Search the whole photo for stripes again.")
        self.whole.clicked.connect(self.whole_asked)
        self.place = QLabel()
        self.place.setWordWrap(True)
        self.place.setAccessibleName("What is matched")
        self._make_table()
        buttons = QHBoxLayout()
        for button in (self.search, self.by_hand, self.whole):
            buttons.addWidget(button)
        buttons.addStretch()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addLayout(buttons)
        layout.addWidget(self.table)
        layout.addWidget(self.place)
        self.show_lamps((), None)
        self.show_region(None)

    def _make_table(self) -> None:
        self.table = QTableWidget(0, 4)
        self.table.setHorizontalHeaderLabels(["Lamp", "Columns", "Chip (px)", "Periods"])
        self.table.setAccessibleName("Lamps in the photo")
        self.table.setToolTip(
            "The lamps, the brightest first: the columns that each covers, the columns of a "
            "chip with their standard deviation, and the periods in view. A doubtful lamp says why."
        )
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.table.verticalHeader().hide()
        self.table.verticalHeader().setDefaultSectionSize(_ROW_HEIGHT)
        self.table.setTabKeyNavigation(False)  # so that the keyboard can leave it
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setStretchLastSection(True)
        self.table.itemSelectionChanged.connect(self._choose)

    def show_lamps(self, lamps: Sequence[Lamp], chosen: int | None) -> None:
        """Show these lamps, one of them chosen, in place of the previous ones."""
        with QSignalBlocker(self.table):
            self.table.setRowCount(len(lamps))
            for row, lamp in enumerate(lamps):
                for column, text in enumerate(self._texts(row, lamp)):
                    item = QTableWidgetItem(text)
                    item.setToolTip("\n".join(f"Doubtful: {doubt}." for doubt in lamp.doubts))
                    self.table.setItem(row, column, item)
            self.table.clearSelection()
            if chosen is not None:
                self.table.selectRow(chosen)
        rows = min(len(lamps), _MOST_ROWS)
        self.table.setFixedHeight(self.table.horizontalHeader().sizeHint().height()
                                  + rows * _ROW_HEIGHT + 4)  # fmt: skip
        self.table.setVisible(bool(lamps))

    def _texts(self, row: int, lamp: Lamp) -> tuple[str, str, str, str]:
        region = lamp.region
        columns = f"{region.first_column}\u2013{region.last_column - 1}"
        product = lamp.switching_frequency_times_readout
        if product is None:
            return str(row + 1), columns, "no stripes", ""
        error = None if lamp.product_uncertainty is None else lamp.product_uncertainty / product**2
        chip = NONE.format_estimate(1.0 / product, error)
        doubt = ", doubtful" if lamp.is_doubtful else ""
        periods = "code" if lamp.periods is None else f"{lamp.periods:.1f}"
        return str(row + 1), columns, chip, f"{periods}{doubt}"

    def show_sentence(self, sentence: str) -> None:
        """Show what became of the search for lamps."""
        self.place.setText(sentence)

    def show_region(self, region: Region | None, lamp: int | None = None) -> None:
        """Show what is matched: a rectangle, a lamp of this index, or the whole photo."""
        self.whole.setEnabled(region is not None)
        if region is None:
            self.place.setText("The whole photo will be searched for stripes.")
            return
        what = (
            "A region by hand" if lamp is None
            else f"Lamp {lamp + 1}"
        )  # fmt: skip
        words = "{what} will be matched: columns {left} to {right}, rows {top} to {bottom}."
        self.place.setText(
            words.format(
                what=what, left=region.first_column, right=region.last_column - 1,
                top=region.first_row, bottom=region.last_row - 1,
            )
            + ("" if lamp is not None else " Drag on the photo to draw another one.")
        )  # fmt: skip

    def show_by_hand(self, by_hand: bool) -> None:
        """Show whether a rectangle is drawn by hand, without emitting a signal."""
        with QSignalBlocker(self.by_hand):
            self.by_hand.setChecked(by_hand)

    def show_searching(self) -> None:
        """Show that lamps are being searched."""
        self.search.setEnabled(False)
        self.place.setText("Searching for lamps…")

    def show_searched(self) -> None:
        """Show that no lamps are being searched any more."""
        self.search.setEnabled(True)

    def _choose(self) -> None:
        rows = {item.row() for item in self.table.selectedItems()}
        if len(rows) == 1:
            self.chosen.emit(rows.pop())
