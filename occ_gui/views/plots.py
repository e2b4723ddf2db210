"""How plots look: one place for their axes, pens and colours, and for how much is in view."""

import pyqtgraph as pg
from pyqtgraph.graphicsItems.ScatterPlotItem import renderSymbol
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPalette, QPen, QPixmap

from occ_model import colours

SIMULATION = QColor(colours.SIMULATION)
BAND = QColor(colours.BAND)
PHOTO = QColor(colours.PHOTO)
THRESHOLD = QColor(colours.THRESHOLD)
REGION = QColor(colours.REGION)
NOISE = QColor(colours.NOISE)

PACKETS_IN_VIEW = 2
"""Packets that a plot over columns shows at first; the rest can be panned to."""

_LEAST_HEIGHT = 86


def thin(colour: QColor, style: Qt.PenStyle = Qt.PenStyle.SolidLine) -> QPen:
    """Make a pen of width one: wider ones cost hundreds of milliseconds on a noisy curve."""
    return pg.mkPen(colour, style=style)  # type: ignore[no-any-return]


def marker(symbol: str, size: int, fill: QColor | None, outline: QPen | None = None) -> QPixmap:
    """Draw a point as a plot does."""
    brush = pg.mkBrush(fill)
    return QPixmap.fromImage(renderSymbol(symbol, size, outline or pg.mkPen(None), brush))


def new_plot(
    name: str,
    x: str,
    y: str,
    palette: QPalette,
    left: pg.AxisItem | None = None,
    bottom: pg.AxisItem | None = None,
) -> pg.PlotWidget:
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
    axes = {"left": left, "bottom": bottom}
    plot = pg.PlotWidget(axisItems={side: axis for side, axis in axes.items() if axis is not None})
    plot.setAccessibleName(name)
    plot.setBackground(palette.color(QPalette.ColorRole.Base))
    for side, label in (("bottom", x), ("left", y)):
        axis = plot.getAxis(side)
        axis.setPen(palette.color(QPalette.ColorRole.Mid))
        axis.setTextPen(palette.color(QPalette.ColorRole.Text))
        plot.setLabel(side, label)
    plot.setMinimumHeight(_LEAST_HEIGHT)
    plot.setMenuEnabled(False)
    plot.hideButtons()
    plot.getViewBox().disableAutoRange()
    return plot
