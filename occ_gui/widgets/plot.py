"""Plots with common axes and limits of zooming, and a legend."""

from collections.abc import Callable
from typing import TypeAlias

import pyqtgraph as pg
from pyqtgraph.graphicsItems.ScatterPlotItem import Symbols
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPalette, QPen, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QWidget

from occ_gui.widgets.axes import Axis
from occ_gui.widgets.building import fill
from occ_gui.widgets.colours import lighten_for, pen_on
from occ_gui.widgets.event_filters import leave_drops_to_window
from occ_gui.widgets.guarded_paint import PaintedWidget

_LINE = QSize(24, 12)

DrawSample: TypeAlias = Callable[[QPainter, QRectF, QPalette], None]
"""Draws a sample of a line or a point into a rectangle, in the colours of a palette."""


class LineLegend(QWidget):
    def __init__(self) -> None:
        super().__init__()
        self._row = fill(QHBoxLayout(self), margins=0)
        self._entries: dict[str, QWidget] = {}

    def add_line(self, key: str, pen: QPen, text: str) -> None:
        """Add an entry, which is shown until :meth:`show_line` hides it."""
        thick_pen = QPen(pen)
        thick_pen.setWidth(max(2, pen.width()))
        thick_pen.setCosmetic(False)  # as wide as the curve on any screen

        def draw(painter: QPainter, place: QRectF, palette: QPalette) -> None:
            middle = place.center().y()
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
            painter.setPen(pen_on(palette, thick_pen))
            painter.drawLine(QPointF(place.left(), middle), QPointF(place.right(), middle))

        self.add_sample(key, draw, _LINE, text)

    def add_sample(
        self, key: str, draw: DrawSample, size: QSize, text: str, meaning: str = ""
    ) -> None:
        entry = QWidget(toolTip=meaning)
        sample = (LegendSample(draw, size), 0, Qt.AlignmentFlag.AlignVCenter)
        fill(QHBoxLayout(entry), sample, QLabel(text), margins=(0, 0, 6, 0))
        self._row.addWidget(entry)
        self._entries[key] = entry

    def show_line(self, key: str, visible: bool) -> None:
        self._entries[key].setVisible(visible)


class LegendSample(PaintedWidget):
    """A sample of a line or a point, which follows the palette and the scale of the screen."""

    def __init__(self, draw: DrawSample, size: QSize) -> None:
        super().__init__()
        self._draw = draw
        self.setFixedSize(size)

    def paint_with(self, painter: QPainter) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._draw(painter, QRectF(self.rect()), self.palette())


CURVE_WIDTH = 2.0
"""Width of a curve in pixels of the window. For 1800 points, pyqtgraph draws a solid curve line by
line in 1 to 4 ms of processor time, and a dashed curve as a path in 7 ms."""

_MAX_RANGE = 2e6
"""Largest distance from zero in view, in columns, levels or runs: twice the most columns."""

_LEAST_SPAN = 0.01  # smallest range in view, in columns, levels or runs

_LEAST_HEIGHT = 86
_MIN_HEIGHT_FOR_AXIS_NAME = 76
"""Least height in pixels of a plot that shows the name of its lower axis."""


class Plot(pg.PlotWidget):  # type: ignore[misc]  # pyqtgraph has no types
    """A plot that shows the name of its lower axis if it is high enough."""

    _is_named = False
    _palette_callbacks: tuple[Callable[[QPalette], None], ...] = ()

    def apply_palette(self, palette: QPalette) -> None:
        self.setBackground(palette.color(QPalette.ColorRole.Base))
        for side in ("bottom", "left"):
            axis = self.getAxis(side)
            axis.setPen(palette.color(QPalette.ColorRole.Mid))
            axis.setTextPen(palette.color(QPalette.ColorRole.Text))
        for apply_palette in self._palette_callbacks:
            apply_palette(palette)

    def follow_palette(self, apply_palette: Callable[[QPalette], None]) -> None:
        """Call a function with the palette, now and whenever it changes."""
        self._palette_callbacks = (*self._palette_callbacks, apply_palette)
        apply_palette(self.palette())

    def add_curve(self, pen: QPen, *, is_crowded: bool = False) -> pg.PlotDataItem:
        """Add an empty curve of sufficient contrast; a crowded curve keeps the width of its pen."""
        curve = self.plot(pen=pen)
        set_width = QPen if is_crowded else self.stroke
        self.follow_palette(lambda palette: curve.setPen(set_width(pen_on(palette, pen))))
        return curve

    def stroke(self, pen: QPen) -> QPen:
        """Return a pen with the width of a curve on the present screen."""
        wide_pen = QPen(pen)
        # pyqtgraph takes the width of a pen in pixels of the screen.
        wide_pen.setWidthF(CURVE_WIDTH * self.devicePixelRatioF())
        return wide_pen

    def event(self, event: QEvent) -> bool:
        """Redraw the curves, equally wide, on a screen of another resolution."""
        is_handled = bool(super().event(event))
        if event.type() == QEvent.Type.DevicePixelRatioChange and self.plotItem is not None:
            self.apply_palette(self.palette())
        return is_handled

    def show_extremes(self) -> None:
        """Draw only the columns in view; of those that share a pixel, the extremes."""
        self.setDownsampling(auto=True, mode="peak")
        self.setClipToView(True)

    def limit(self, side: str, farthest: float, least_span: float) -> None:
        """Limit panning and zooming to what can be drawn.

        ``farthest`` is the largest distance from zero that can be in view, and ``least_span`` the
        smallest range, both in the unit of the axis.
        """
        axis = "X" if side == "bottom" else "Y"
        ends = {f"{axis.lower()}Min": -farthest, f"{axis.lower()}Max": farthest}
        self.getViewBox().setLimits(**ends, **{f"min{axis}Range": least_span})

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if self.plotItem is None:  # once the plot is closed
            return
        if event.type() == QEvent.Type.PaletteChange:
            self.apply_palette(self.palette())
        if event.type() == QEvent.Type.FontChange:
            for side in ("bottom", "left"):
                axis = self.getAxis(side)
                # pyqtgraph leaves the axis' name in the font in which it was made.
                axis.label.setFont(self.font())
                axis._updateLabel()  # which adapts the axis to it

    def show_axis_name(self, visible: bool) -> None:
        self._is_named = visible
        self._show_name()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        if self._is_named and self.plotItem is not None:  # None once the plot is closed
            self._show_name()

    def _show_name(self) -> None:
        self.getAxis("bottom").showLabel(
            self._is_named and self.height() >= _MIN_HEIGHT_FOR_AXIS_NAME
        )


def marker(symbol: str, size: float, fill: QColor | None) -> DrawSample:
    """Return a function that draws a point of a plot: filled, or as a ring in the text colour."""

    def draw(painter: QPainter, place: QRectF, palette: QPalette) -> None:
        ring = QPen(palette.color(QPalette.ColorRole.Text), 1.5 / size)  # scaled below
        painter.setPen(ring if fill is None else pg.mkPen(None))
        painter.setBrush(pg.mkBrush(None if fill is None else lighten_for(palette, fill)))
        painter.translate(place.center())
        painter.scale(size, size)
        painter.drawPath(Symbols[symbol])

    return draw


def new_plot(
    name: str,
    x: str,
    y: str,
    left: pg.AxisItem | None = None,
    bottom: pg.AxisItem | None = None,
) -> Plot:
    """Create an empty plot without automatic ranging."""
    axes = {"left": left or Axis("left"), "bottom": bottom or Axis("bottom")}
    plot = Plot(axisItems=axes, enableMenu=False)
    plot.setAccessibleName(name)
    for side, label in (("bottom", x), ("left", y)):
        plot.setLabel(side, label)
    plot.apply_palette(plot.palette())
    plot.show_axis_name(True)
    plot.setMinimumHeight(_LEAST_HEIGHT)
    # As high as its pane, because the size hint of pyqtgraph is far too large.
    plot.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Ignored)
    plot.hideButtons()
    for side in ("left", "bottom"):
        plot.limit(side, _MAX_RANGE, _LEAST_SPAN)
    plot.getViewBox().disableAutoRange()
    leave_drops_to_window(plot)  # for plots that are made after the window
    plot.setAcceptDrops(False)
    return plot
