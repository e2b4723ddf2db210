"""Numbers beside the points of a plot, placed so that they cover neither points nor each other."""

from collections.abc import Iterable, Sequence

import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor

_SIDES = ((1, -1), (-1, -1), (1, 1), (-1, 1), (0, -1), (0, 1), (1, 0), (-1, 0))
"""Possible places of a number: right or left of its point, above or below it."""

_DISTANCE = 11.0
"""Distance in pixels from a point's centre to the centre of its number."""

_POINT = 8.0
"""Width of a point in pixels."""


class PointNumbers:
    """Numbers points from 0; a number that would cover another, or a point, is left out.

    Parameters
    ----------
    plot
        The plot.
    """

    def __init__(self, plot: pg.PlotWidget) -> None:
        self._plot = plot
        self._colour = QColor()
        self._items: list[pg.TextItem] = []
        self._places: list[QPointF] = []
        self._others: list[QPointF] = []
        plot.getViewBox().sigRangeChanged.connect(self._arrange)
        plot.getViewBox().sigResized.connect(self._arrange)

    def show(
        self, xs: Sequence[float], ys: Sequence[float], others: Iterable[tuple[float, float]] = ()
    ) -> None:
        """Show a number beside each of these points, clear of these and of other points."""
        self._places = [QPointF(x, y) for x, y in zip(xs, ys, strict=True)]
        self._others = [QPointF(x, y) for x, y in others]
        while len(self._items) < len(self._places):
            item = pg.TextItem(str(len(self._items)), color=self._colour, anchor=(0.5, 0.5))
            self._plot.addItem(item, ignoreBounds=True)
            self._items.append(item)
        self._arrange()

    def set_colour(self, colour: QColor) -> None:
        """Set the colour of the numbers."""
        self._colour = colour
        for item in self._items:
            item.setColor(colour)

    def set_opacity(self, opacity: float) -> None:
        """Set the opacity of the numbers."""
        for item in self._items:
            item.setOpacity(opacity)

    def _arrange(self) -> None:
        box = self._plot.getViewBox()
        points = [box.mapViewToScene(place) for place in (*self._places, *self._others)]
        taken = [_around(point, _POINT, _POINT) for point in points]
        area = box.sceneBoundingRect()
        for number, item in enumerate(self._items):
            item.hide()
            if number >= len(self._places):
                continue
            size = item.textItem.boundingRect()
            width, height = size.width() - 6.0, size.height() - 8.0  # without its margins
            for right, down in _SIDES:
                centre = points[number] + QPointF(right * _DISTANCE, down * _DISTANCE)
                rect = _around(centre, width, height)
                if area.contains(rect) and not any(rect.intersects(other) for other in taken):
                    taken.append(rect)
                    item.setPos(box.mapSceneToView(centre))
                    item.show()
                    break


def _around(centre: QPointF, width: float, height: float) -> QRectF:
    return QRectF(centre.x() - width / 2, centre.y() - height / 2, width, height)
