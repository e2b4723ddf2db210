"""Names beside the points of a plot, placed so that they cover neither points nor each other."""

import math
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, QSizeF
from PySide6.QtGui import QColor, QPen

_GAP = 4.0
"""Least distance in pixels from a point's centre to its name."""

_STEP = 6.0
"""Pixels between possible places of a name."""

_STEPS = 20
"""Possible places of a name on each side of its point."""

_LINE_POINTS = 12
"""Points of a line at which it is checked that it crosses no name."""

_FONT_SHARE = 0.9
"""Size of the names, in that of the other texts."""

_POINT = 9.0
"""Width of a point in pixels."""

_LED_FROM = 14.0
"""Distance in pixels from which a line leads from a point to its name."""


@dataclass(frozen=True, slots=True)
class NamedPoint:
    """A point of a plot.

    Parameters
    ----------
    x, y
        Its place in the plot's own units.
    name
        What stands beside it.
    """

    x: float
    y: float
    name: str


class PointNames:
    """Writes the name of each point beside it, clear of all points and other names.

    Where there is no room beside a point, its name stands apart, and a line leads to it. A name for
    which there is no room at all is left out.

    Parameters
    ----------
    plot
        The plot.
    """

    def __init__(self, plot: pg.PlotWidget) -> None:
        self._plot = plot
        self._points: Sequence[NamedPoint] = ()
        self._colour = QColor()
        self._texts: list[pg.TextItem] = []
        self._lines: list[pg.PlotCurveItem] = []
        self._shown: dict[str, QRectF] = {}
        self._taken: list[QRectF] = []
        plot.getViewBox().sigRangeChanged.connect(self._arrange)
        plot.getViewBox().sigResized.connect(self._arrange)

    @property
    def places(self) -> dict[str, QRectF]:
        """The names that are shown, and their places in pixels of the plot."""
        return dict(self._shown)

    def show(self, points: Sequence[NamedPoint], colour: QColor) -> None:
        """Name these points, the most important first."""
        self._points, self._colour = points, colour
        while len(self._texts) < len(points):
            text, line = pg.TextItem(anchor=(0.5, 0.5)), pg.PlotCurveItem()
            text.textItem.document().setDocumentMargin(1.0)
            font = self._plot.font()
            font.setPointSizeF(_FONT_SHARE * font.pointSizeF())
            text.setFont(font)
            for item in (line, text):
                self._plot.addItem(item, ignoreBounds=True)
            self._texts.append(text)
            self._lines.append(line)
        self._arrange()

    def set_opacity(self, opacity: float) -> None:
        """Set the opacity of the names."""
        for item in (*self._texts, *self._lines):
            item.setOpacity(opacity)

    def _arrange(self) -> None:
        box = self._plot.getViewBox()
        places = [box.mapViewToScene(QPointF(point.x, point.y)) for point in self._points]
        self._taken = [_around(place, _POINT, _POINT) for place in places]
        self._shown = {}
        for item in (*self._texts, *self._lines):
            item.hide()
        for point, place, text, line in zip(
            self._points, places, self._texts, self._lines, strict=False
        ):
            text.setText(point.name, self._colour)
            size = text.textItem.boundingRect().size()
            others = [other for other in places if _distance(other, place) > _POINT]
            # A line may cross a name, or a name stand by another point, only where there is no
            # other way.
            rect = (
                self._free(place, size, others, self._shown.values())
                or self._free(place, size, others, ())
                or self._free(place, size, (), ())
            )
            if rect is None:
                continue
            self._taken.append(rect)
            self._shown[point.name] = rect
            text.setPos(box.mapSceneToView(rect.center()))
            text.show()
            end = _nearest(rect, place)
            if _distance(place, end) >= _LED_FROM:
                to = box.mapSceneToView(end)
                line.setPen(QPen(self._colour, 0))
                line.setData([point.x, to.x()], [point.y, to.y()])
                line.show()

    def _free(
        self,
        place: QPointF,
        size: QSizeF,
        others: Iterable[QPointF],
        names: Collection[QRectF],
    ) -> QRectF | None:
        """Find the nearest place for a name that covers nothing and stands by no other point.

        Parameters
        ----------
        place, size
            The point's place, and the size of its name.
        others
            Other points: the name must not stand nearer to one of them than to its own.
        names
            Names that the line to it must not cross.
        """
        area = self._plot.getViewBox().sceneBoundingRect()
        for offset in _offsets(size.width(), size.height()):
            rect = _around(place + offset, size.width(), size.height())
            if not area.contains(rect) or any(rect.intersects(other) for other in self._taken):
                continue
            end = _nearest(rect, place)
            own = min(_distance(place, end), _LED_FROM)
            if any(_distance(other, _nearest(rect, other)) <= own for other in others):
                continue
            if _crosses(place, end, names):
                continue
            return rect
        return None


@lru_cache(maxsize=64)
def _offsets(width: float, height: float) -> tuple[QPointF, ...]:
    """Return places for a name's centre, from near to far."""
    steps = [_STEP * step for step in range(_STEPS)]
    found = [
        QPointF(across, along)
        for across in (0.0, *(side * (width / 2 + _GAP + s) for s in steps for side in (1, -1)))
        for along in (0.0, *(side * (height / 2 + _GAP + s) for s in steps for side in (-1, 1)))
        if across or along
    ]

    def distance(centre: QPointF) -> float:
        right, down = abs(centre.x()) - width / 2, abs(centre.y()) - height / 2
        return math.hypot(max(right, 0.0), max(down, 0.0))

    return tuple(sorted(found, key=distance))


def _distance(one: QPointF, other: QPointF) -> float:
    return math.hypot(one.x() - other.x(), one.y() - other.y())


def _nearest(rect: QRectF, point: QPointF) -> QPointF:
    """Return the point of a rectangle that is nearest to another point."""
    x = min(max(point.x(), rect.left()), rect.right())
    return QPointF(x, min(max(point.y(), rect.top()), rect.bottom()))


def _crosses(start: QPointF, end: QPointF, rects: Iterable[QRectF]) -> bool:
    """Return whether a line crosses any of some rectangles."""
    steps = [step / _LINE_POINTS for step in range(_LINE_POINTS + 1)]
    between = [start + (end - start) * step for step in steps]
    return any(rect.contains(point) for rect in rects for point in between)


def _around(centre: QPointF, width: float, height: float) -> QRectF:
    return QRectF(centre.x() - width / 2, centre.y() - height / 2, width, height)
