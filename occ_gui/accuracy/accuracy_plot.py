"""Plot of error against computing time, one point for each way of simulating."""

import math
from collections.abc import Sequence
from itertools import accumulate

import pyqtgraph as pg
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QColor, QPalette, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from occ_gui.accuracy.named_points import NamedPoint, choose_points
from occ_gui.widgets.axes import LogAxis
from occ_gui.widgets.building import ElidedLabel, fill, push_button
from occ_gui.widgets.colours import BAND, PHOTO, REGION, SIMULATION, lighten_for, thin_pen
from occ_gui.widgets.event_filters import call_at
from occ_gui.widgets.plot import new_plot
from occ_model.results.accuracy import (
    ACCURACY_PARTS,
    CLOSED_FORM,
    LEAST_ERROR,
    AccuracyPoint,
    Forecast,
)

SYMBOLS = dict(zip(ACCURACY_PARTS, ("o", "s", "t1", "t"), strict=True))
COLOURS: dict[str, QColor] = dict(
    zip(ACCURACY_PARTS, (SIMULATION, BAND, PHOTO, REGION), strict=True)
)

_GLYPHS = {"o": "●", "s": "■", "t1": "▲", "t": "▼"}  # the symbols as characters
_LEGEND_NAMES = (
    "sampled exposure",
    "some effects",
    "columns alone",
    "some rows (draft)",
)  # names of the parts in the legend
_FLOOR = round(math.log10(LEAST_ERROR))  # power of ten at which all smaller errors are drawn
_LEAST_HEIGHT = 56  # pixels; small, because the panes of a low window share its height

_LEAST_HEIGHT_WITH_LEGEND = 220  # pixels

_LABEL_GAP = 14  # pixels between an axis, its numbers and its label
_CURVE_PARTS = ("integration",)  # the parts whose points are joined
_OUTDATED_OPACITY = 0.3  # opacity of points that were measured for an earlier scene
_MARGIN = 0.35  # smallest margin around the points, in powers of ten
_RING_MARGIN = 10.0  # margin in pixels for the ring around a point
_FARTHEST_POWER = 12.0  # largest power of ten on the axes; its negative is the smallest
_LEAST_RANGE = 0.01  # smallest range of the axes, in powers of ten


class AccuracyPlot(QWidget):
    """Computing time and error of each way of simulating the scene.

    Until new points are measured, the last complete ones stay, faded.
    """

    def __init__(self) -> None:
        super().__init__()
        self._points: list[AccuracyPoint] = []
        self._named_points: Sequence[NamedPoint] = ()
        self._front: list[AccuracyPoint] = []
        self._last_points: tuple[AccuracyPoint, ...] = ()
        self._is_measuring = False
        self._is_outdated = False
        self._fits_points = True
        self.title = ElidedLabel("Error over time", how=Qt.TextElideMode.ElideMiddle)
        self.legend = QLabel(wordWrap=True)
        self.legend.setAccessibleName("Legend")
        axes = {"left": LogAxis("left", _FLOOR), "bottom": LogAxis("bottom")}
        labels = ("Error over time", "time (ms)", "error (levels)")
        self.plot = new_plot(*labels, **axes)
        for side in ("left", "bottom"):
            self.plot.limit(side, _FARTHEST_POWER, _LEAST_RANGE)
        box = self.plot.getViewBox()
        box.sigRangeChangedManually.connect(self._keep_range)
        box.sigResized.connect(self._fit)
        self.plot.setMinimumHeight(_LEAST_HEIGHT)
        self._widen_axis()
        call_at(self, self._widen_axis, QEvent.Type.FontChange)
        self._make_items()
        self.plot.follow_palette(self._colour_items)
        self._lay_out()
        self._fit()

    def _widen_axis(self) -> None:
        """Fit the axis to its widest number and its label: pyqtgraph does so only while drawing."""
        widest = self.fontMetrics().horizontalAdvance(f"≤ {LEAST_ERROR:g}")
        self.plot.getAxis("left").setWidth(widest + self.fontMetrics().height() + _LABEL_GAP)

    def _make_items(self) -> None:
        self.lines = {part: pg.PlotCurveItem() for part in _CURVE_PARTS}
        self.scatters = {
            part: pg.ScatterPlotItem(
                symbol=SYMBOLS[part], size=8, pen=None,
                hoverable=True, tip=lambda data, **_: _describe(data),
            )
            for part in ACCURACY_PARTS
        }  # fmt: skip
        self.rings = pg.ScatterPlotItem(symbol="o", size=15, brush=None)
        # The Pareto front: sets of effects of which none is beaten in both time and error.
        self.front = pg.PlotCurveItem()
        self.front_points = pg.ScatterPlotItem(
            symbol="+", size=7, brush=None,
            hoverable=True, tip=lambda data, **_: data,
        )  # fmt: skip
        self.front_ring = pg.ScatterPlotItem(symbol="o", size=11, brush=None)
        self._floor = pg.InfiniteLine(_FLOOR, angle=0)
        front = (self.front, self.front_points, self.front_ring)
        points = (*self.lines.values(), *self.scatters.values(), self.rings)
        for item in (self._floor, *front, *points):
            self.plot.addItem(item, ignoreBounds=True)

    def _colour_items(self, palette: QPalette) -> None:
        ring = pg.mkPen(palette.color(QPalette.ColorRole.Text), width=1.5)
        self.rings.setPen(ring)
        for part, scatter in self.scatters.items():
            scatter.setBrush(lighten_for(palette, COLOURS[part]))
        for part, line in self.lines.items():
            line.setPen(self.plot.stroke(thin_pen(lighten_for(palette, COLOURS[part]))))
        front_pen = thin_pen(lighten_for(palette, COLOURS["effects"]))
        self.front.setPen(self.plot.stroke(front_pen))
        self.front_points.setPen(front_pen)
        self.front_ring.setPen(ring)
        self._write_legend(palette)
        grey = palette.color(QPalette.ColorRole.Mid)
        self._floor.setPen(thin_pen(grey, Qt.PenStyle.DashLine))

    def _write_legend(self, palette: QPalette) -> None:
        entries = [
            (_GLYPHS[SYMBOLS[part]], lighten_for(palette, COLOURS[part]), word)
            for part, word in zip(ACCURACY_PARTS, _LEGEND_NAMES, strict=True)
        ]
        entries.append(("+", lighten_for(palette, COLOURS["effects"]), "plan's largest error"))
        entries.append(("○", palette.color(QPalette.ColorRole.Text), "now, or next"))
        self.legend.setText(
            "&nbsp; ".join(
                f"<span style='color:{colour.name()}'>{glyph}</span>&nbsp;{word}"
                for glyph, colour, word in entries
            )
        )

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self.legend.setVisible(self.height() >= _LEAST_HEIGHT_WITH_LEGEND)

    def show_effect_sets(self, forecast: Forecast) -> None:
        """Draw the forecast time and error limit of each set of effects that a plan may choose."""
        pairs = zip(forecast.effect_sets, forecast.effect_set_seconds, strict=True)
        timed_sets = [
            (effect_set, seconds)
            for effect_set, seconds in pairs
            if seconds is not None and effect_set.error < math.inf
        ]
        timed_sets.sort(key=lambda pair: (pair[1], pair[0].error))
        forced = {d.effect for d in forecast.plan.decisions if d.forced and d.included}
        self._front = [
            AccuracyPoint(
                "effects",
                ", ".join(sorted(effect_set.effects)) or "no effects",
                seconds,
                effect_set.error,
                current=effect_set.effects
                <= set(forecast.plan.included)
                <= effect_set.effects | forced,
                unit=forecast.plan.unit,
            )
            for effect_set, seconds in timed_sets
        ]
        # With measured times, another set may beat a set in both error and time.
        before = accumulate((point.error for point in self._front), min, initial=math.inf)
        pairs_before = zip(self._front, before, strict=False)
        best = [point for point, least in pairs_before if point.error < least]
        self._front = [point for point in self._front if point in best or point.current]
        xs, ys = _take_logarithms(self._front)
        self.front.setData(*_take_logarithms(best))
        tips = [
            f"{p.name}: {1e3 * p.seconds:.3g} ms, at most {p.error:.3g} {p.unit}"
            for p in self._front
        ]
        self.front_points.setData(xs, ys, data=tips)
        self.front_ring.setData(
            *_take_logarithms([point for point in self._front if point.current])
        )
        self._fit()

    def _lay_out(self) -> None:
        self.fit_button = push_button("Fit", "Show all points.", self._show_all)
        head = fill(QHBoxLayout(), (self.title, 1), self.fit_button)
        fill(QVBoxLayout(self), head, self.legend, (self.plot, 1), margins=0, spacing=2)

    @property
    def study_points(self) -> tuple[AccuracyPoint, ...]:
        """All points of the current scene; none while the study is incomplete."""
        return () if self._is_measuring or self._is_outdated else self._last_points

    def show_unit(self, unit: str) -> None:
        self.plot.setLabel("left", f"error ({unit})")

    def show_study_begun(self) -> None:
        self._is_measuring, self._is_outdated, self._points = True, False, []
        self._show_state("measuring…")

    def show_point(self, point: AccuracyPoint, number: int, total: int) -> None:
        self._points.append(point)
        self._draw(self._points, 1.0)
        self._show_state(f"measuring… {number} of {total}")

    def show_study_finished(self) -> None:
        self._is_measuring, self._last_points = False, tuple(self._points)
        self._draw(self._points, 1.0)
        self._show_state("measured")

    def show_study_outdated(self) -> None:
        """Fade the points: they belong to an earlier scene, and no more are measured."""
        if self._is_outdated:  # called at every move of a slider
            return
        was_measuring, self._is_measuring, self._is_outdated = self._is_measuring, False, True
        self._draw(self._last_points or self._points, _OUTDATED_OPACITY)
        if was_measuring:
            self._show_state("stopped")
        elif self._last_points:
            self._show_state("of the previous scene")

    def show_study_failed(self, sentence: str) -> None:
        self.show_study_outdated()
        self._show_state(sentence)

    def _show_state(self, state: str) -> None:
        self.title.set_full_text(f"Error over time: {state}")

    def _draw(self, points: Sequence[AccuracyPoint], opacity: float) -> None:
        self._named_points = choose_points(points)
        for part in ACCURACY_PARTS:
            named_points = [named for named in self._named_points if named.point.part == part]
            coordinates = _take_logarithms([named.point for named in named_points])
            self.scatters[part].setData(*coordinates, data=named_points)
            self.scatters[part].setOpacity(opacity)
        for part, line in self.lines.items():
            curve = [p for p in points if p.part == part and not p.current]
            line.setData(*_take_logarithms([point for point in curve if point.name != CLOSED_FORM]))
            line.setOpacity(opacity)
        current = [named.point for named in self._named_points if named.point.current]
        self.rings.setData(*_take_logarithms(current))
        self.rings.setOpacity(opacity)
        self._fit()

    def _show_all(self) -> None:
        self._fits_points = True
        self._fit()

    def _keep_range(self) -> None:
        self._fits_points = False

    def _fit(self) -> None:
        """Show all points; during a study the previous ones too, so that the axes do not jump."""
        if not self._fits_points:
            return
        previous = self._last_points if self._is_measuring else ()
        xs, ys = _take_logarithms(
            (*(named.point for named in self._named_points), *previous, *self._front)
        )
        box = self.plot.getViewBox()
        box.setXRange(min(xs, default=-2.0) - _MARGIN, max(xs, default=3.0) + _MARGIN, padding=0)
        top = max(ys, default=2.0)
        margin = max(
            _MARGIN,
            _RING_MARGIN * (top - _FLOOR) / max(box.height() - 2 * _RING_MARGIN, _RING_MARGIN),
        )
        box.setYRange(_FLOOR - margin, top + margin, padding=0)


def _take_logarithms(points: Sequence[AccuracyPoint]) -> tuple[list[float], list[float]]:
    """Return the decimal logarithms of the times in milliseconds and of the errors in levels."""
    times = [math.log10(max(1e3 * point.seconds, 1e-6)) for point in points]
    return times, [math.log10(max(point.error, LEAST_ERROR)) for point in points]


def _describe(named: NamedPoint) -> str:
    point = named.point
    numbers = f"{1e3 * point.seconds:.3g} ms, {point.error:.3g} {point.unit}"
    return f"{named.name}: {numbers}\n({ACCURACY_PARTS[point.part]})"
