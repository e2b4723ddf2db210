"""Parts below the profile of a photo: the residual, and the chips that were read."""

from typing import TYPE_CHECKING

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QPainter
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from occ_gui.values.photo_results import PhotoProfile
from occ_gui.widgets.building import ElidedLabel, fill
from occ_gui.widgets.chip_cell import draw_chips
from occ_gui.widgets.colours import PHOTO, THRESHOLD, thin_pen
from occ_gui.widgets.guarded_paint import PaintedWidget
from occ_gui.widgets.plain_text import copy_text
from occ_gui.widgets.plot import Plot, new_plot
from occ_model.results.chip_reading import ChipReading
from occ_model.results.comparison import Comparison

if TYPE_CHECKING:
    from occ_model.photo.reading.load import Photo

_LEAST_HEIGHT = 56  # pixels

_PADDING = 0.2  # room beyond the outermost ticks of the axis, as a fraction of their distance

_STEPS = (5.0, 10.0, 15.0, 20.0, 30.0, 50.0, 75.0, 100.0, 150.0, 200.0, 255.0)
"""Grey levels at which the axis can end; they are few, so that the axis rarely changes."""


_CERTAIN_PROBABILITY = 0.95
"""Smallest probability that all chips are right at which they are drawn in full colour."""


class ResidualPlot(QWidget):
    """Photo minus simulation over column, with their correlation and RMSE."""

    def __init__(self, linked: pg.PlotWidget) -> None:
        super().__init__()
        self.numbers = ElidedLabel()
        self.numbers.setAccessibleName("Agreement of photo and simulation")
        self.plot = new_plot(
            "Residual, photo minus simulation",
            "column",
            "levels",  # a longer label would be cut off; the line above names the residual
        )
        self.plot.setMinimumHeight(_LEAST_HEIGHT)
        self.plot.show_extremes()
        # pyqtgraph's own link would shift one plot if their frames are not aligned on the screen.
        linked.getViewBox().sigXRangeChanged.connect(self._follow_columns)
        self._linked = linked
        self._follow_columns(linked.getViewBox(), linked.viewRange()[0])
        self.plot.getViewBox().sigRangeChangedManually.connect(self._move_linked_plot)
        zero = pg.InfiniteLine(angle=0, pen=thin_pen(THRESHOLD, Qt.PenStyle.DashDotLine))
        self.plot.addItem(zero, ignoreBounds=True)
        self.curve = self.plot.add_curve(thin_pen(PHOTO))
        self._photo: Photo | None = None
        self._limit = _STEPS[0]
        """Limit of the axis; for one photo it never shrinks, so that a smaller residual shows."""
        fill(QVBoxLayout(self), self.numbers, (self.plot, 1), margins=0, spacing=1)

    def _follow_columns(self, _box: pg.ViewBox, columns: tuple[float, float]) -> None:
        self.plot.setXRange(*columns, padding=0)

    def _move_linked_plot(self) -> None:
        # Move the other plot as the user would, so that it no longer follows panel or packets.
        self._linked.setXRange(*self.plot.viewRange()[0], padding=0)
        box = self._linked.getViewBox()
        box.sigRangeChangedManually.emit(box.mouseEnabled())

    def show_profile(self, profile: PhotoProfile) -> None:
        comparison = profile.comparison
        self.plot.setVisible(comparison is not None)
        if comparison is None:
            self.curve.setData([], [])
            self.numbers.set_full_text(profile.sentence or "Searching for stripes…")
            return
        residual = comparison.residual
        columns = comparison.first_column + np.arange(len(residual), dtype=np.float64)
        self.curve.setData(columns, residual)
        usual = comparison.usual_residual
        limit = next((step for step in _STEPS if usual <= step), _STEPS[-1])
        if profile.photo is not None and profile.photo is self._photo:
            limit = max(limit, self._limit)
        if not profile.is_outdated:
            self._photo, self._limit = profile.photo, limit
        self.plot.setYRange(-limit, limit, padding=_PADDING)
        ticks = [(level, f"{level:.0f}") for level in (-limit, 0.0, limit)]
        self.plot.getAxis("left").setTicks([ticks])
        self.numbers.set_full_text(self._describe(comparison, (1.0 + 2.0 * _PADDING) * limit))

    def _describe(self, comparison: Comparison, axis_limit: float) -> str:
        text = (
            f"Residual, photo minus simulation: correlation {comparison.correlation:.4f}, RMSE "
            f"{comparison.rmse:.2f} grey levels"
        )
        if comparison.largest_residual > axis_limit:
            text += f"; largest residual {comparison.largest_residual:.0f}, outside the axis"
        return text


class ChipStrip(QWidget):
    """The chips as cells, filled where the LED is on, to the right of a button that copies them.

    ``button_width``: in pixels.
    """

    copied = Signal(str)  # a text was copied: a sentence that says so

    def __init__(self, plot: Plot, button_width: int) -> None:
        super().__init__()
        self.copy = QToolButton()
        self.copy.setText("Copy")
        self.copy.setToolTip("Copy the chips read from the photo as text.")
        self.copy.setFixedWidth(button_width)
        self.copy.clicked.connect(self._copy)
        self.cells = _Cells(plot)
        fill(QHBoxLayout(self), self.copy, self.cells, margins=0, spacing=0)
        self.hide()

    def show_chips(self, reading: ChipReading | None) -> None:
        self.cells.reading = reading
        self.setVisible(reading is not None)
        if reading is not None:
            text = (
                f"{len(reading.chips)} chips read from the photo, "
                f"{reading.columns_per_chip:.2f} columns each; the probability that all of them "
                f"are right is {100.0 * reading.confidence:.0f} %"
            )
            self.cells.setToolTip(text)
            self.cells.setAccessibleDescription(f"{text}: {reading.text}")
        self.cells.update()

    def place(self, first_column: float, scale: float) -> None:
        """Set the column of the simulation at the photo's first column, and the photo's scale."""
        self.cells.placement = (first_column, scale)
        self.cells.update()

    def _copy(self) -> None:
        if self.cells.reading is not None:
            self.copied.emit(copy_text(self.cells.reading.text))


class _Cells(PaintedWidget):
    def __init__(self, plot: Plot) -> None:
        super().__init__()
        self._plot = plot
        self.reading: ChipReading | None = None
        self.placement = (0.0, 1.0)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName("Chips read from the photo")
        plot.getViewBox().sigXRangeChanged.connect(self._follow_columns)

    def _follow_columns(self) -> None:
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(100, self.fontMetrics().height() + 6)

    def rectangles(self) -> list[tuple[int, QRectF]]:
        if self.reading is None:
            return []
        first, scale = self.placement
        start, step = first + self.reading.start * scale, self.reading.columns_per_chip * scale
        cells = []
        for index, chip in enumerate(self.reading.chips.tolist()):
            left, right = (self._find_pixel(start + edge * step) for edge in (index, index + 1))
            if right > 0.0 and left < self.width():
                cells.append((chip, QRectF(left, 1.0, right - left, self.height() - 2.0)))
        return cells

    def _find_pixel(self, column: float) -> float:
        point = self._plot.getViewBox().mapViewToScene(QPointF(column, 0.0))
        in_plot = self._plot.mapFromScene(point)
        return float(self.mapFromGlobal(self._plot.mapToGlobal(in_plot)).x())

    def paint_with(self, painter: QPainter) -> None:
        is_certain = self.reading is not None and self.reading.confidence >= _CERTAIN_PROBABILITY
        draw_chips(painter, self.rectangles(), QColor(PHOTO), self.palette(), is_certain)
