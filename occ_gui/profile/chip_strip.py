"""Strip of chips under the profile: those read from a photo, each below its columns."""

from PySide6.QtCore import QPointF, QRectF, QSize, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QToolButton, QWidget

from occ_gui.widgets.chip_cell import draw_chips
from occ_gui.widgets.copying import copy_text
from occ_gui.widgets.guarded_paint import guarded
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.pens import PHOTO
from occ_gui.widgets.plot import Plot
from occ_model.results.match import ChipReading

_CERTAIN = 0.95  # probability that all chips are right from which they are drawn in full


class ChipStrip(QWidget):
    """Cells of the chips, lit ones filled, and a button that copies them as text.

    ``left``: pixels of the plot's axis, where the button has its place.
    """

    copied = Signal(str)  # a text was copied: a sentence that says so

    def __init__(self, plot: Plot, left: int) -> None:
        super().__init__()
        self.copy = QToolButton()
        self.copy.setText("Copy")
        self.copy.setToolTip("Copy the chips read from the photo as text.")
        self.copy.setFixedWidth(left)
        self.copy.clicked.connect(self._copy)
        self.cells = _Cells(plot)
        filled(QHBoxLayout(self), self.copy, (self.cells, 1), margins=0, spacing=0)
        self.hide()

    def show_chips(self, reading: ChipReading | None) -> None:
        self.cells.reading = reading
        self.setVisible(reading is not None)
        if reading is not None:
            text = (
                f"{len(reading.chips)} chips read from the photo, "
                f"{reading.columns_per_chip:.2f} columns each; all of them are "
                f"right with a probability of {100.0 * reading.confidence:.0f} %"
            )
            self.cells.setToolTip(text)
            self.cells.setAccessibleDescription(f"{text}: {reading.text}")
        self.cells.update()

    def place(self, first_column: float, scale: float) -> None:
        """Put the photo's first column under a column of the simulation, and scale its columns."""
        self.cells.placement = (first_column, scale)
        self.cells.update()

    def _copy(self) -> None:
        if self.cells.reading is not None:
            self.copied.emit(copy_text(self.cells.reading.text))


class _Cells(QWidget):
    def __init__(self, plot: Plot) -> None:
        super().__init__()
        self._plot = plot
        self.reading: ChipReading | None = None
        self.placement = (0.0, 1.0)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName("Chips read from the photo")
        plot.getViewBox().sigXRangeChanged.connect(self._follow)

    def _follow(self) -> None:
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(100, self.fontMetrics().height() + 6)

    def rectangles(self) -> list[tuple[int, QRectF]]:
        if self.reading is None:
            return []
        first, scale = self.placement
        start, step = first + self.reading.start * scale, self.reading.columns_per_chip * scale
        found = []
        for place, chip in enumerate(self.reading.chips.tolist()):
            left, right = (self._pixel(start + (place + side) * step) for side in (0, 1))
            if right > 0.0 and left < self.width():
                found.append((chip, QRectF(left, 1.0, right - left, self.height() - 2.0)))
        return found

    def _pixel(self, column: float) -> float:
        at = self._plot.getViewBox().mapViewToScene(QPointF(column, 0.0))
        in_plot = self._plot.mapFromScene(at)
        return float(self.mapFromGlobal(self._plot.mapToGlobal(in_plot)).x())

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        painter = QPainter(self)
        certain = self.reading is not None and self.reading.confidence >= _CERTAIN
        draw_chips(painter, self.rectangles(), QColor(PHOTO), self.palette(), certain)
