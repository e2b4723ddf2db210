"""How plots look: one place for their axes, pens and colours."""

import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPalette, QPen

from occ_model import colours

SIMULATION = QColor(colours.SIMULATION)
BAND = QColor(colours.BAND)
PHOTO = QColor(colours.PHOTO)
THRESHOLD = QColor(colours.THRESHOLD)
REGION = QColor(colours.REGION)


def thin(colour: QColor, style: Qt.PenStyle = Qt.PenStyle.SolidLine) -> QPen:
    """Make a pen of width one: wider ones cost hundreds of milliseconds on a noisy curve."""
    return pg.mkPen(colour, style=style)  # type: ignore[no-any-return]


def new_plot(name: str, x: str, y: str, palette: QPalette, least_height: int = 90) -> pg.PlotWidget:
    """Make an empty plot that ranges itself only when told to.

    Parameters
    ----------
    name
        What it shows, for those who do not see it.
    x, y
        What the axes show.
    palette
        Whose colours it takes.
    least_height
        In pixels.
    """
    plot = pg.PlotWidget()
    plot.setAccessibleName(name)
    plot.setBackground(palette.color(QPalette.ColorRole.Base))
    dress_axis(plot, "bottom", x, palette)
    dress_axis(plot, "left", y, palette)
    plot.setMinimumHeight(least_height)
    plot.setMenuEnabled(False)
    plot.hideButtons()
    plot.getViewBox().disableAutoRange()
    return plot


def dress_axis(plot: pg.PlotWidget, side: str, label: str, palette: QPalette) -> None:
    """Give an axis its label and the palette's colours."""
    axis = plot.getAxis(side)
    axis.setPen(palette.color(QPalette.ColorRole.Mid))
    axis.setTextPen(palette.color(QPalette.ColorRole.Text))
    plot.setLabel(side, label)
