"""Exposure of one column on the LED's waveform; the column is chosen in the plot of the profile."""

import numpy as np
import pyqtgraph as pg
from pyqtgraph.GraphicsScene.mouseEvents import MouseClickEvent
from PySide6.QtCore import QEvent, QObject, QPointF, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QBrush, QColor, QKeyEvent, QPalette, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QSpinBox, QVBoxLayout, QWidget

from occ_gui.widgets.building import check_box, fill, name_widget, paragraph
from occ_gui.widgets.colours import BAND, REGION, SIMULATION, pen_on, thin_pen
from occ_gui.widgets.columns import KEY_STEPS
from occ_gui.widgets.event_filters import keep_wheel_for_scrolling
from occ_gui.widgets.plot import Plot, new_plot
from occ_model.results.teaching import ExposureWindow
from occ_model.scene.units import SECOND

_MICRO = 1e6
_SHADE_ALPHA = 60
_LEAST_HEIGHT = 92

_LEAST_SPAN = 1e-6  # smallest range of the time axis, as a fraction of the drawn time


class ColumnPicker(QObject):
    hovered = Signal(int)
    clicked = Signal(int)

    stepped = Signal(int)  # the number of columns to move to the right; negative: to the left

    released = Signal()

    def __init__(self, plot: Plot) -> None:
        super().__init__(plot)
        self._plot = plot
        self._box = plot.getViewBox()
        self._is_active = False
        self._marked_column: int | None = None
        self._is_held = False
        self.marker = pg.InfiniteLine(angle=90)
        self.marker.setZValue(20)
        self.marker.hide()
        plot.addItem(self.marker, ignoreBounds=True)
        plot.scene().sigMouseMoved.connect(self._hover)
        plot.scene().sigMouseClicked.connect(self._click)
        plot.installEventFilter(self)
        plot.follow_palette(self._colour_items)

    def set_active(self, active: bool) -> None:
        self._is_active = active
        self.marker.setVisible(active)

    def show_column(self, column: int, is_held: bool) -> None:
        """Mark a column with a dashed line, or with a solid line if it is held."""
        self._is_held = is_held
        self._colour_items(self._plot.palette())
        self.marker.setValue(column)
        self._marked_column = column

    def _colour_items(self, palette: QPalette) -> None:
        style = Qt.PenStyle.SolidLine if self._is_held else Qt.PenStyle.DashLine
        self.marker.setPen(thin_pen(palette.color(QPalette.ColorRole.Text), style))

    def _hover(self, place: QPointF) -> None:
        column = self._find_column(place)
        if self._is_active and column is not None and column != self._marked_column:
            self._marked_column = column
            self.hovered.emit(column)

    def _click(self, event: MouseClickEvent) -> None:
        column = self._find_column(event.scenePos())
        if self._is_active and column is not None and event.button() == Qt.MouseButton.LeftButton:
            self.clicked.emit(column)

    def _find_column(self, place: QPointF) -> int | None:
        if not self._box.sceneBoundingRect().contains(place):
            return None
        return int(round(self._box.mapSceneToView(place).x()))  # noqa: RUF046 - it has no type

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Move from column to column with the arrow keys, and release a held column with Escape."""
        if (
            self._is_active
            and event.type() == QEvent.Type.KeyPress
            and isinstance(event, QKeyEvent)
        ):
            key = Qt.Key(event.key())
            if key in KEY_STEPS:
                self.stepped.emit(KEY_STEPS[key])
                return True
            if key == Qt.Key.Key_Escape:
                self.released.emit()
                return True
        return super().eventFilter(watched, event)


class ExposurePlot(QWidget):
    column_chosen = Signal(int)

    hold_chosen = Signal(bool)  # whether the column stays chosen when the mouse moves

    def __init__(self) -> None:
        super().__init__()
        self.sentence = paragraph(name="Exposure of the column")
        self.sentence.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self._make_plot()
        self._make_controls()
        row = fill(QHBoxLayout(), QLabel("Column"), self.column, self.hold, (None, 1))
        self._layout = fill(
            QVBoxLayout(self), row, self.sentence, (self.plot, 1), margins=(4, 2, 4, 4), spacing=2
        )

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self._fit_height()

    def _fit_height(self) -> None:
        """Reserve the height of all lines of the sentence; a splitter reserves too little."""
        height = self._layout.minimumHeightForWidth(self.width())
        self.setMinimumHeight(max(height, 0))  # -1 without a sentence

    def _make_plot(self) -> None:
        self.plot = new_plot("Exposure of a column on the LED's waveform", "time (µs)", "LED")
        self.plot.setMinimumHeight(_LEAST_HEIGHT)
        self.plot.setMouseEnabled(x=True, y=False)
        self.plot.getAxis("left").setTicks([[(0.0, "off"), (1.0, "on")]])
        colour = QColor(REGION)
        colour.setAlpha(_SHADE_ALPHA)
        self.shade = pg.LinearRegionItem(brush=colour, pen=thin_pen(REGION), movable=False)
        self.shade.setZValue(-10)
        hatched = QBrush(BAND, Qt.BrushStyle.BDiagPattern)
        self.lit = pg.BarGraphItem(x0=[], x1=[], y0=0.0, y1=1.0, pen=thin_pen(BAND), brush=hatched)
        self.chips = pg.PlotCurveItem()
        self.plot.follow_palette(
            lambda palette: self.chips.setPen(pen_on(palette, thin_pen(SIMULATION)))
        )
        for item in (self.shade, self.lit, self.chips):
            item.hide()
            self.plot.addItem(item, ignoreBounds=True)

    def _make_controls(self) -> None:
        self.column = name_widget(
            QSpinBox(),
            "Column whose exposure is shown",
            "The column of the picture whose exposure is shown. The mouse over the profile, and "
            "the arrow keys there, choose it, too.",
        )
        self.column.setKeyboardTracking(False)
        keep_wheel_for_scrolling(self.column)
        self.column.valueChanged.connect(self.column_chosen)
        self.hold = check_box(
            "Hold", "Keep this column wherever the mouse is, as a click on the profile does."
        )
        self.hold.clicked.connect(self.hold_chosen)

    def show_column(self, column: int, columns: int, is_held: bool) -> None:
        with QSignalBlocker(self.column):
            self.column.setRange(0, columns - 1)
            self.column.setValue(column)
        self.hold.setChecked(is_held)

    def show_window(self, window: ExposureWindow, level: float, *, has_edges: bool = False) -> None:
        """Show a column's exposure and level; ``has_edges``: whether that is lit by slow edges."""
        edges = window.edges * _MICRO
        start, end = window.start * _MICRO, window.end * _MICRO
        last = edges[-1]
        self.chips.setData(edges, window.levels, stepMode="center")
        self.shade.setRegion((start, min(end, last)))
        parts = window.lit_parts * _MICRO
        self.lit.setOpts(x0=parts[:, 0], x1=parts[:, 1], y1=window.lit_parts[:, 2])
        for item in (self.shade, self.chips):
            item.show()
        self.lit.setVisible(len(parts) > 0)
        self.plot.limit("bottom", 2.0 * last, _LEAST_SPAN * last)
        self.plot.setXRange(0.0, last, padding=0.01)
        # A lamp on the mains is brighter than its mean in a part of each cycle.
        brightest = max(1.0, float(window.levels.max()))
        self.plot.setYRange(-0.12 * brightest, 1.25 * brightest, padding=0)
        fraction = f"{100.0 * window.on_time / window.exposure_time:.0f} %"
        light = f"light {fraction}"
        if np.isin(window.levels, (0.0, 1.0)).all():
            verb, delay = ("switched on", ", lit later by its rise,") if has_edges else ("on", "")
            light = f"LED {verb} for {SECOND.format(window.on_time, 4)} ({fraction}){delay}"
        text = (
            f"Column {window.column}: {SECOND.format(window.exposure_time, 4)} exposure, "
            f"{light} → {level:.1f} grey levels"
        )
        if window.shortened:
            text += f"; only the first {len(window.levels)} changes of the light are drawn"
        self.sentence.setText(text)
        self._fit_height()
        self.plot.setAccessibleDescription(text)
