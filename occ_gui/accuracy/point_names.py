"""Names beside the points of a plot, placed so that they cover neither points nor each other."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, QSizeF
from PySide6.QtGui import QBrush, QColor, QPen

from occ_model.arrays import BoolArray, FloatArray

_GAP = 4.0
"""Least distance in pixels from a point's centre to its name."""

_STEP = 6.0
"""Pixels between possible places of a name."""

_STEPS = 20
"""Possible places of a name on each side of its point."""

_PARTS = (24, 96, 384)
"""Where the possible places, from near to far, are divided to be looked at one part at a time."""

_LINE_POINTS = 24
"""Points of a line at which it is checked that it crosses no name and passes no point."""

_FONT_SHARE = 0.9
"""Size of the names, in that of the other texts."""

_POINT = 9.0
"""Width of a point in pixels."""

_PLATE = 215
"""Opacity of the plate under a name, of 255."""

_LEAST_LEADER = 14.0
"""Distance in pixels from which a line leads from a point to its name."""


@dataclass(frozen=True, slots=True)
class NamedPoint:
    """A point of a plot."""

    x: float
    y: float
    name: str


class PointNames:
    """Writes the name of each point beside it, clear of all points and other names.

    Where there is no room beside a point, its name stands apart, and a line leads to it. A name for
    which there is no room at all is left out.
    """

    def __init__(self, plot: pg.PlotWidget) -> None:
        self._plot = plot
        self._points: Sequence[NamedPoint] = ()
        self._colour = QColor()
        self._texts: list[pg.TextItem] = []
        self._lines: list[pg.PlotCurveItem] = []
        self._shown: dict[str, QRectF] = {}
        self._arranged: tuple[object, ...] = ()
        plot.getViewBox().sigRangeChanged.connect(self._arrange)
        plot.getViewBox().sigResized.connect(self._arrange)

    @property
    def places(self) -> dict[str, QRectF]:
        """The names that are shown, and their places in pixels of the plot."""
        return dict(self._shown)

    def show(self, points: Sequence[NamedPoint], colour: QColor, paper: QColor) -> None:
        """Name these points, the most important first, in one colour on plates of another."""
        self._points, self._colour = points, colour
        plate = QColor(paper)
        plate.setAlpha(_PLATE)
        while len(self._texts) < len(points):
            text, line = pg.TextItem(anchor=(0.5, 0.5)), pg.PlotCurveItem()
            text.setZValue(1.0)  # its plate hides a line that would strike it through
            text.textItem.document().setDocumentMargin(1.0)
            font = self._plot.font()
            font.setPointSizeF(_FONT_SHARE * font.pointSizeF())
            text.setFont(font)
            for item in (line, text):
                self._plot.addItem(item, ignoreBounds=True)
            self._texts.append(text)
            self._lines.append(line)
        for text in self._texts:
            text.fill = QBrush(plate)
        self._arrange()

    def set_opacity(self, opacity: float) -> None:
        """Set the opacity of the names."""
        for item in (*self._texts, *self._lines):
            item.setOpacity(opacity)

    def _arrange(self) -> None:
        box = self._plot.getViewBox()
        area = box.sceneBoundingRect()
        places = [box.mapViewToScene(QPointF(point.x, point.y)) for point in self._points]
        # One step of a wheel changes the range of each axis, and may say so several times.
        wanted = (area, tuple(places), tuple(self._points), self._colour)
        if wanted == self._arranged:
            return
        self._arranged = wanted
        free = _FreePlaces(area, places)
        self._shown = {}
        for item in (*self._texts, *self._lines):
            item.hide()
        for point, place, text, line in zip(
            self._points, places, self._texts, self._lines, strict=False
        ):
            if (text.toPlainText(), text.color) != (point.name, self._colour):
                text.setText(point.name, self._colour)
            rect = free.take(place, text.textItem.boundingRect().size())
            if rect is None:
                continue
            self._shown[point.name] = rect
            text.setPos(box.mapSceneToView(rect.center()))
            text.show()
            end = _nearest(rect, place)
            if _distance(place, end) >= _LEAST_LEADER:
                to = box.mapSceneToView(end)
                line.setPen(QPen(self._colour, 0))
                line.setData([point.x, to.x()], [point.y, to.y()])
                line.show()


class _FreePlaces:
    """The places of a plot at which no point and no name stands yet."""

    def __init__(self, area: QRectF, points: Sequence[QPointF]) -> None:
        self._area = _ends([area])[0]
        self._points = np.array([(point.x(), point.y()) for point in points]).reshape(-1, 2)
        self._taken = [_around(point, _POINT, _POINT) for point in points]
        self._names: list[QRectF] = []
        self._lines = np.empty((0, 2))

    def take(self, point: QPointF, size: QSizeF) -> QRectF | None:
        """Take the nearest place for the name of a point; None where there is none."""
        at = np.array([point.x(), point.y()])
        centres = at + _offsets(size.width(), size.height())
        # A line may cross a name, or a name stand by another point, only where there is no other
        # way.
        last: list[FloatArray] = [centres[:0], centres[:0]]
        for part in np.split(centres, _PARTS):  # mostly there is a place near by
            free = part[self._is_free(part, size)]
            alone = free[~self._is_by_another(free, size, at)]
            best = alone[~self._is_crossing(alone, size, at)]
            if len(best):
                return self._fill(best[0], size, at)
            last = [
                former if len(former) else new
                for former, new in zip(last, (alone, free), strict=True)
            ]
        found = next((places for places in last if len(places)), None)
        return None if found is None else self._fill(found[0], size, at)

    def _fill(self, centre: FloatArray, size: QSizeF, at: FloatArray) -> QRectF:
        rect = _around(QPointF(*centre.tolist()), size.width(), size.height())
        self._taken.append(rect)
        self._names.append(rect)
        along = _lines_to(centre[None, :], size, at)[0]
        if np.hypot(*(along[-1] - at)) >= _LEAST_LEADER:
            self._lines = np.concatenate([self._lines, along])
        return rect

    def _is_free(self, centres: FloatArray, size: QSizeF) -> BoolArray:
        """Return which names would lie within the plot and cover nothing."""
        low, high = _corners(centres, size)
        inside = (low >= self._area[:2]).all(axis=1) & (high <= self._area[2:]).all(axis=1)
        taken = _ends(self._taken)
        apart = (low[:, None] >= taken[:, 2:]) | (high[:, None] <= taken[:, :2])
        free: BoolArray = inside & np.all(np.any(apart, axis=2), axis=1)
        return free

    def _is_by_another(self, centres: FloatArray, size: QSizeF, at: FloatArray) -> BoolArray:
        """Return which names would stand nearer to another point than to their own."""
        own = np.minimum(_distances(centres, size, at[None, :])[:, 0], _LEAST_LEADER)
        apart = np.hypot(*(self._points - at).T) > _POINT
        others = _distances(centres, size, self._points[apart])
        return np.asarray((others <= own[:, None]).any(axis=1), dtype=np.bool_)

    def _is_crossing(self, centres: FloatArray, size: QSizeF, at: FloatArray) -> BoolArray:
        """Return which names would lie on another's line, or their own on a name or a point."""
        along = _lines_to(centres, size, at)
        crossed = _holds(centres, size, self._lines).any(axis=1)
        for rect in _ends(self._names):
            within = (along >= rect[:2]) & (along <= rect[2:])
            crossed |= within.all(axis=2).any(axis=1)
        others = self._points[np.hypot(*(self._points - at).T) > _POINT]
        away = np.hypot(*np.moveaxis(along[:, :, None] - others, -1, 0))
        return np.asarray(crossed | (away < _POINT / 2.0).any(axis=(1, 2)), dtype=np.bool_)


def _lines_to(centres: FloatArray, size: QSizeF, at: FloatArray) -> FloatArray:
    """Return points of the lines from a point to its possible names, shape (names, points, 2)."""
    ends = np.clip(at, *_corners(centres, size))
    shares = np.linspace(0.0, 1.0, _LINE_POINTS + 1)
    return np.asarray(at + (ends[:, None] - at) * shares[:, None])


def _holds(centres: FloatArray, size: QSizeF, points: FloatArray) -> BoolArray:
    """Return which rectangles hold which points, shape (rectangles, points)."""
    low, high = _corners(centres, size)
    held = (points >= low[:, None]) & (points <= high[:, None])
    return np.asarray(held.all(axis=2), dtype=np.bool_)


@lru_cache(maxsize=64)
def _offsets(width: float, height: float) -> FloatArray:
    """Return places for a name's centre from near to far, shape (places, 2)."""
    steps = _STEP * np.arange(_STEPS)
    beside, below = (half + _GAP + steps for half in (width / 2, height / 2))
    # At each distance first to the right, and first above.
    across = np.concatenate([[0.0], np.stack([beside, -beside], axis=1).ravel()])
    along = np.concatenate([[0.0], np.stack([-below, below], axis=1).ravel()])
    found = np.stack(np.meshgrid(across, along, indexing="ij"), axis=-1).reshape(-1, 2)[1:]
    distance = np.hypot(*np.maximum(np.abs(found) - [width / 2, height / 2], 0.0).T)
    found = found[np.argsort(distance, kind="stable")]
    found.flags.writeable = False  # it is cached and shared
    return np.asarray(found)


def _corners(centres: FloatArray, size: QSizeF) -> tuple[FloatArray, FloatArray]:
    """Return the upper left and the lower right corners of rectangles, shape (rectangles, 2)."""
    half = np.array([size.width(), size.height()]) / 2
    return centres - half, centres + half


def _ends(rects: Sequence[QRectF]) -> FloatArray:
    """Return left, top, right and bottom of rectangles, shape (rectangles, 4)."""
    ends = [(rect.left(), rect.top(), rect.right(), rect.bottom()) for rect in rects]
    return np.array(ends, dtype=np.float64).reshape(-1, 4)


def _distances(centres: FloatArray, size: QSizeF, points: FloatArray) -> FloatArray:
    """Return the distance from each rectangle to each point, shape (rectangles, points)."""
    low, high = _corners(centres, size)
    nearest = np.clip(points, low[:, None], high[:, None])
    return np.asarray(np.hypot(*np.moveaxis(points - nearest, -1, 0)))


def _distance(one: QPointF, other: QPointF) -> float:
    return math.hypot(one.x() - other.x(), one.y() - other.y())


def _nearest(rect: QRectF, point: QPointF) -> QPointF:
    """Return the point of a rectangle that is nearest to another point."""
    x = min(max(point.x(), rect.left()), rect.right())
    return QPointF(x, min(max(point.y(), rect.top()), rect.bottom()))


def _around(centre: QPointF, width: float, height: float) -> QRectF:
    return QRectF(centre.x() - width / 2, centre.y() - height / 2, width, height)
