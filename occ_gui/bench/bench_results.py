"""Results of the bench: bit error rates or bits a second, in two plots and a table."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QHBoxLayout, QHeaderView, QTableWidget, QTableWidgetItem, QWidget

from occ_gui.widgets.axes import LogAxis
from occ_gui.widgets.building import fill, make_read_only
from occ_gui.widgets.colours import BAND, NOISE, PHOTO, REGION, SIMULATION, lighten_for, thin_pen
from occ_gui.widgets.plot import Plot, new_plot
from occ_model.results.bit_errors import BenchBounds, BenchPoint, BenchRequest

RATES, BITS = "rates", "bits"  # the quantity to draw: bit error rates, or bits a second

AXES = ("exposure", "noise")

SYMBOLS = ("o", "s", "t1", "d", "star", "p")
COLOURS: tuple[QColor, ...] = (SIMULATION, BAND, PHOTO, REGION, NOISE)

FLOOR = {RATES: -6, BITS: 0}  # power of ten at which all smaller values are drawn
_MARGIN = 0.06  # margin beside the points, as a fraction of their range
_TOP_MARGIN = 0.3  # margin above the points, in powers of ten

_SYMBOL_SIZE = 8
_FARTHEST_POWER, _LEAST_RANGE = 12.0, 0.01


@dataclass(eq=False, slots=True)
class _Curve:
    line: pg.PlotCurveItem
    intervals: pg.PlotCurveItem
    with_errors: pg.ScatterPlotItem  # points at which errors occurred
    without_errors: pg.ScatterPlotItem  # points at which none did: only their upper bound

    @property
    def items(self) -> tuple[pg.GraphicsObject, ...]:
        return self.intervals, self.line, self.with_errors, self.without_errors


@dataclass(frozen=True, slots=True)
class CurvePoint:
    """A point of a plot; rates and their intervals in powers of ten."""

    x: float  # the exposure in symbols or the signal-to-noise ratio in dB
    value: float  # the rate, or the bits a second; NaN if no error occurred
    low: float  # lower end of the interval
    high: float  # upper end of the interval


def make_curve_point(point: BenchPoint, quantity: str, frames_a_second: float) -> CurvePoint:
    errors, floor = point.errors, FLOOR[quantity]
    if quantity == RATES:
        value = _take_logarithm(errors.rate, floor) if errors.errors else math.nan
        return CurvePoint(
            point.place,
            value,
            _take_logarithm(errors.low, floor),
            _take_logarithm(errors.high, floor),
        )
    low, high = errors.bits_a_second_interval(frames_a_second)
    value = _take_logarithm(errors.bits_a_second(frames_a_second), floor)
    return CurvePoint(point.place, value, _take_logarithm(low, floor), _take_logarithm(high, floor))


def _take_logarithm(value: float, floor: int) -> float:
    return max(math.log10(value), floor) if value > 0.0 else float(floor)


class BenchPlots(QWidget):
    def __init__(self, quantity: str) -> None:
        super().__init__()
        self._quantity = quantity
        self._decoders: tuple[str, ...] = ()
        left = "bit error rate" if quantity == RATES else "bits a second"
        names = {
            "exposure": ("over the exposure", "exposure (symbols)"),
            "noise": ("over the noise", "signal-to-noise ratio (dB)"),
        }
        self.plots: dict[str, Plot] = {}
        self.curves: dict[str, list[_Curve]] = {axis: [] for axis in AXES}
        self.bounds: dict[str, pg.PlotCurveItem] = {}
        self._nulls: list[pg.InfiniteLine] = []
        row = fill(QHBoxLayout(self), margins=0)
        for axis, (name, bottom) in names.items():
            plot = new_plot(
                f"{left} {name}",
                bottom,
                left,
                left=LogAxis("left", FLOOR[quantity]),
            )
            plot.limit("left", _FARTHEST_POWER, _LEAST_RANGE)
            plot.showGrid(x=True, y=True, alpha=0.15)
            self.bounds[axis] = pg.PlotCurveItem()
            plot.addItem(self.bounds[axis], ignoreBounds=True)
            self.plots[axis] = plot
            plot.follow_palette(self._colour_items)
            row.addWidget(plot, 3 if axis == "exposure" else 2)

    def _colour_items(self, palette: QPalette) -> None:
        grey = palette.color(QPalette.ColorRole.Text)
        for bound in self.bounds.values():
            bound.setPen(thin_pen(grey, Qt.PenStyle.DashLine))
        for null in self._nulls:
            null.setPen(thin_pen(palette.color(QPalette.ColorRole.Mid), Qt.PenStyle.DotLine))
        for curves in self.curves.values():
            for number, curve in enumerate(curves):
                colour = lighten_for(palette, COLOURS[number % len(COLOURS)])
                for item in (curve.line, curve.intervals, curve.without_errors):
                    item.setPen(thin_pen(colour))
                curve.with_errors.setBrush(colour)

    def show_begun(self, decoders: Sequence[str]) -> None:
        for axis, plot in self.plots.items():
            for curve in self.curves[axis]:
                for item in curve.items:
                    plot.removeItem(item)
            self.curves[axis] = [self._new_curve(plot, n) for n in range(len(decoders))]
            self.bounds[axis].setData([], [])
        for null in self._nulls:
            self.plots["exposure"].removeItem(null)
        self._nulls = []
        self._decoders = tuple(decoders)
        self._colour_items(self.palette())

    @staticmethod
    def _new_curve(plot: Plot, number: int) -> _Curve:
        symbol = SYMBOLS[number % len(SYMBOLS)]
        curve = _Curve(
            pg.PlotCurveItem(),
            pg.PlotCurveItem(connect="pairs"),
            pg.ScatterPlotItem(symbol=symbol, size=_SYMBOL_SIZE, pen=None),
            pg.ScatterPlotItem(symbol="t", size=_SYMBOL_SIZE, brush=None),
        )
        for item in curve.items:
            plot.addItem(item, ignoreBounds=True)
        return curve

    def show_bounds(self, bounds: BenchBounds, frames_a_second: float) -> None:
        """Draw the nulls and, in the plots of bits a second, the upper bound."""
        plot = self.plots["exposure"]
        for null in self._nulls:
            plot.removeItem(null)
        self._nulls = [pg.InfiniteLine(x, angle=90) for x in bounds.nulls]
        for null in self._nulls:
            plot.addItem(null, ignoreBounds=True)
        if self._quantity == BITS:
            for axis, (x, most) in bounds.most_bits.items():
                powers = [_take_logarithm(frames_a_second * bits, FLOOR[BITS]) for bits in most]
                self.bounds[axis].setData(list(x), powers)
        self._colour_items(self.palette())
        self._fit()

    def show_points(self, points: Sequence[BenchPoint], frames_a_second: float) -> None:
        for axis in AXES:
            for decoder, curve in zip(self._decoders, self.curves[axis], strict=True):
                curve_points = [
                    make_curve_point(point, self._quantity, frames_a_second)
                    for point in points
                    if (point.axis, point.errors.decoder) == (axis, decoder)
                ]
                _draw(curve, sorted(curve_points, key=lambda point: point.x))
        self._fit()

    def _fit(self) -> None:
        values: list[float] = []
        for axis, plot in self.plots.items():
            places: list[float] = []
            curves = self.curves[axis]
            for item in (*(i for c in curves for i in c.items), self.bounds[axis]):
                x, y = item.getData()
                places += list(x)
                values += list(y)
            if places:
                margin = _MARGIN * (max(places) - min(places)) or 1.0
                plot.setXRange(min(places) - margin, max(places) + margin, padding=0)
        floor = FLOOR[self._quantity]
        # An interval whose lower end is zero is cut off at the bottom.
        visible = values if self._quantity == BITS else [value for value in values if value > floor]
        for plot in self.plots.values():
            low, high = min(visible, default=floor), max(visible, default=floor + 1.0)
            plot.setYRange(low - _TOP_MARGIN, high + _TOP_MARGIN, padding=0)


def _draw(curve: _Curve, points: Sequence[CurvePoint]) -> None:
    places = [place for place, point in enumerate(points) if not math.isnan(point.value)]
    x, y = [points[place].x for place in places], [points[place].value for place in places]
    # The line is interrupted at points without an error, because their rate is not known.
    is_joined = [int(after == place + 1) for place, after in pairwise((*places, -1))]
    curve.line.setData(x, y, connect=np.array(is_joined, dtype=np.int32))
    curve.with_errors.setData(x, y)
    ends_x = [point.x for point in points for _ in range(2)]
    curve.intervals.setData(ends_x, [end for point in points for end in (point.low, point.high)])
    without_errors = [point for point in points if math.isnan(point.value)]
    curve.without_errors.setData(
        [point.x for point in without_errors], [point.high for point in without_errors]
    )


class BenchTable(QTableWidget):
    """Bit error rates or bits a second with their intervals; tooltips say why nothing is read."""

    def __init__(self) -> None:
        super().__init__()
        self._places: dict[tuple[str, float, float], int] = {}
        self._decoders: tuple[str, ...] = ()
        make_read_only(self, "Table of the bench").setAlternatingRowColors(True)

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

    def show_points(
        self, points: Sequence[BenchPoint], quantity: str, frames_a_second: float
    ) -> None:
        for point in points:
            row = self._places[point.axis, point.exposure, point.decibels]
            column = 2 + self._decoders.index(point.errors.decoder)
            self._put(row, column, format_cell(point, quantity, frames_a_second), point.explanation)

    def _put(self, row: int, column: int, text: str, tip: str = "") -> None:
        item = QTableWidgetItem(text)
        item.setTextAlignment(Qt.AlignmentFlag.AlignCenter)
        item.setToolTip(tip)
        self.setItem(row, column, item)


def format_cell(point: BenchPoint, quantity: str, frames_a_second: float) -> str:
    errors = point.errors
    if quantity == RATES:
        return f"{errors.rate:.2g} ({errors.low:.2g} – {errors.high:.2g})"  # noqa: RUF001
    low, high = errors.bits_a_second_interval(frames_a_second)
    return f"{errors.bits_a_second(frames_a_second):,.0f} ({low:,.0f} – {high:,.0f})"  # noqa: RUF001
