"""Table of the bench: a row for each place, a column for each decoder."""

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
)

from occ_gui.bench.bench_plot import RATES
from occ_model.results.bench import BenchPoint, BenchRequest


class BenchTable(QTableWidget):
    """Bit error rates or bits a second, with their intervals; why nothing is read as a tooltip."""

    def __init__(self) -> None:
        super().__init__()
        self._places: dict[tuple[str, float, float], int] = {}
        self._decoders: tuple[str, ...] = ()
        self.setAccessibleName("Table of the bench")
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setAlternatingRowColors(True)
        self.verticalHeader().hide()

    def show_begun(self, request: BenchRequest) -> None:
        self.clear()
        self._decoders = request.decoders
        self._places = {point[1:]: row for row, point in enumerate(request.points)}
        self.setRowCount(len(request.points))
        self.setColumnCount(2 + len(request.decoders))
        self.setHorizontalHeaderLabels(["exposure (symbols)", "SNR (dB)", *request.decoders])
        for row, (_, _, exposure, decibels) in enumerate(request.points):
            for column, value in enumerate((exposure, decibels)):
                self._put(row, column, f"{value:g}")
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        for column in (0, 1):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)

    def show_points(self, points: Sequence[BenchPoint], what: str, frames_a_second: float) -> None:
        for point in points:
            row = self._places[point.axis, point.exposure, point.decibels]
            column = 2 + self._decoders.index(point.errors.decoder)
            self._put(row, column, cell_text(point, what, frames_a_second), point.explanation)

    def _put(self, row: int, column: int, text: str, tip: str = "") -> None:
        item = QTableWidgetItem(text)
        item.setTextAlignment(Qt.AlignmentFlag.AlignCenter)
        item.setToolTip(tip)
        self.setItem(row, column, item)


def cell_text(point: BenchPoint, what: str, frames_a_second: float) -> str:
    errors = point.errors
    if what == RATES:
        return f"{errors.rate:.2g} ({errors.low:.2g} – {errors.high:.2g})"  # noqa: RUF001
    low, high = errors.bits_a_second_interval(frames_a_second)
    return f"{errors.bits_a_second(frames_a_second):,.0f} ({low:,.0f} – {high:,.0f})"  # noqa: RUF001
