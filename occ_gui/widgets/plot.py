"""How plots look: one place for their axes, pens and colours, and for how much is in view."""

from collections.abc import Callable

import pyqtgraph as pg
from pyqtgraph.graphicsItems.ScatterPlotItem import Symbols
from PySide6.QtCore import QEvent, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPalette, QPen, QResizeEvent
from PySide6.QtWidgets import QSizePolicy

from occ_gui.widgets.axes import Axis
from occ_gui.widgets.contrast import pen_on, seen_on
from occ_gui.widgets.legend import Drawing
from occ_model import colours

SIMULATION = QColor(colours.SIMULATION)
BAND = QColor(colours.BAND)
PHOTO = QColor(colours.PHOTO)
THRESHOLD = QColor(colours.THRESHOLD)
REGION = QColor(colours.REGION)
NOISE = QColor(colours.NOISE)
BEFORE = QColor("#8A8A8A")
"""What was there before the latest change: grey, and so nothing else's colour."""

PACKETS_IN_VIEW = 2
"""Packets that a plot over columns shows at first; the rest can be panned to."""

_FARTHEST = 2e6
"""Columns, levels or runs from zero that can be brought into view: twice the most columns."""

_LEAST_SPAN = 0.01
"""Columns, levels or runs across which a plot can be zoomed in."""

_LEAST_HEIGHT = 86
_NAMED_FROM = 76
"""Pixels of height from which a plot has room for the name of its lower axis."""


class Plot(pg.PlotWidget):  # type: ignore[misc]  # pyqtgraph has no types
    """A plot that names its lower axis where it is high enough, and where that is wanted."""

    _is_named = False
    _dressed: tuple[Callable[[QPalette], None], ...] = ()

    def dress(self, palette: QPalette) -> None:
        """Take the colours of a palette."""
        self.setBackground(palette.color(QPalette.ColorRole.Base))
        for side in ("bottom", "left"):
            axis = self.getAxis(side)
            axis.setPen(palette.color(QPalette.ColorRole.Mid))
            axis.setTextPen(palette.color(QPalette.ColorRole.Text))
        for dress in self._dressed:
            dress(palette)

    def dress_with(self, dress: Callable[[QPalette], None]) -> None:
        """Give what is drawn in it the palette's colours, now and whenever they change."""
        self._dressed = (*self._dressed, dress)
        dress(self.palette())

    def add_curve(self, pen: QPen) -> pg.PlotDataItem:
        """Add a curve without points yet, in a colour that can be seen on any background."""
        curve = self.plot(pen=pen)
        self.dress_with(lambda palette: curve.setPen(pen_on(palette, pen)))
        return curve

    def limit(self, side: str, farthest: float, least_span: float) -> None:
        """Set how far a view goes, so that no turn of the wheel asks for what cannot be drawn.

        Parameters
        ----------
        side
            The axis, ``"left"`` or ``"bottom"``.
        farthest
            The distance from zero that can be brought into view, in the axis's unit.
        least_span
            What the axis shows at least, in its unit.
        """
        axis = "X" if side == "bottom" else "Y"
        ends = {f"{axis.lower()}Min": -farthest, f"{axis.lower()}Max": farthest}
        self.getViewBox().setLimits(**ends, **{f"min{axis}Range": least_span})

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Follow the palette, as when the theme changes."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self.plotItem is not None:
            self.dress(self.palette())

    def name_bottom(self, wanted: bool) -> None:
        """Say whether the lower axis is to be named."""
        self._is_named = wanted
        self._show_name()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Name the axis if there is room for its name now."""
        super().resizeEvent(event)
        if self._is_named and self.plotItem is not None:  # there is none once it is closed
            self._show_name()

    def _show_name(self) -> None:
        self.getAxis("bottom").showLabel(self._is_named and self.height() >= _NAMED_FROM)


def thin(colour: QColor, style: Qt.PenStyle = Qt.PenStyle.SolidLine) -> QPen:
    """Make a pen of width one: wider ones cost hundreds of milliseconds on a noisy curve."""
    return pg.mkPen(colour, style=style)  # type: ignore[no-any-return]


def marker(symbol: str, size: float, fill: QColor | None) -> Drawing:
    """Draw a point as a plot does, for a legend: filled, or a ring in the colour of text."""

    def draw(painter: QPainter, place: QRectF, palette: QPalette) -> None:
        ring = QPen(palette.color(QPalette.ColorRole.Text), 1.5 / size)  # scaled with the point
        painter.setPen(ring if fill is None else pg.mkPen(None))
        painter.setBrush(pg.mkBrush(None if fill is None else seen_on(palette, fill)))
        painter.translate(place.center())
        painter.scale(size, size)
        painter.drawPath(Symbols[symbol])

    return draw


def new_plot(
    name: str,
    x: str,
    y: str,
    palette: QPalette,
    left: pg.AxisItem | None = None,
    bottom: pg.AxisItem | None = None,
) -> Plot:
    """Make an empty plot that ranges itself only when told to.

    Parameters
    ----------
    name
        What it shows, for those who do not see it.
    x, y
        What the axes show.
    palette
        Whose colours it takes.
    left, bottom
        The axes, where plain ones do not suit.
    """
    axes = {"left": left or Axis("left"), "bottom": bottom or Axis("bottom")}
    plot = Plot(axisItems=axes, enableMenu=False)
    plot.setAccessibleName(name)
    for side, label in (("bottom", x), ("left", y)):
        plot.setLabel(side, label)
    plot.dress(palette)
    plot.name_bottom(True)
    plot.setMinimumHeight(_LEAST_HEIGHT)
    # As high as there is room for; what a plot would like by itself is out of all proportion.
    plot.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Ignored)
    plot.hideButtons()
    for side in ("left", "bottom"):
        plot.limit(side, _FARTHEST, _LEAST_SPAN)
    plot.getViewBox().disableAutoRange()
    return plot
