"""Map of one decoder over two parameters: rates, axes, theoretical limits, present setting."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QBrush,
    QColor,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPalette,
    QPen,
    QPolygonF,
)
from PySide6.QtWidgets import QSizePolicy

from occ_gui.detection_map.axis_ticks import make_ticks, write_axis_title
from occ_gui.widgets.guarded_paint import PaintedWidget
from occ_model.arrays import FloatArray, IndexArray
from occ_model.scene.parameter_kinds import Quantity

STYLES: dict[str, Qt.PenStyle] = {
    "band": Qt.PenStyle.SolidLine,
    "null": Qt.PenStyle.DashLine,
    "packets": Qt.PenStyle.DotLine,
    "saturation": Qt.PenStyle.DashDotLine,
}
"""Dash pattern of each limit, distinguishable on any colour."""

Point = tuple[float, float]  # positions along both axes, from 0 to 1

_INK, _PAPER = QColor("black"), QColor("white")
_CASING = QColor(255, 255, 255, 210)
_END_TOLERANCE = 1e-6
"""A line that ends within this distance of an axis's end, in axis lengths, was cut off there."""

_TICK = 4
_GAP = 3
_STEPS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Down: (0, -1),
    Qt.Key.Key_Up: (0, 1),
}


class MapPlot(PaintedWidget):
    """Draws one map; unknown points are blank, points that the model refuses are hatched.

    It does not use pyqtgraph: two such plots would take 77 ms to make instead of 0.2 ms and twice
    as long to paint, and would still need code for labels, hatching and picking.
    """

    picked = Signal(int, int)  # the point that the user chose, by its indices along both axes

    pointed = Signal(object)  # the point under the mouse or chosen by the arrow keys, None for none

    def __init__(self) -> None:
        super().__init__()
        self.title = ""
        self.lines: dict[str, list[FloatArray]] = {}
        self.setting: Point | None = None
        self._axes: tuple[Quantity, Quantity] | None = None
        self._shape = (1, 1)
        self.image = QImage()
        self._refused_cells: Sequence[tuple[int, int]] = ()
        self._cursor: tuple[int, int] | None = None
        self._area = QRectF()
        self._area_key: tuple[QSize, bool] | None = None
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setCursor(Qt.CursorShape.CrossCursor)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(320, 200)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(150, 90)

    def show_axes(self, x: Quantity, y: Quantity) -> None:
        self._axes = (x, y)
        self.image, self._refused_cells, self.lines = QImage(), (), {}
        self._cursor = None
        self.update()

    def show_picture(self, image: QImage, shape: tuple[int, int], refused: IndexArray) -> None:
        self.image, self._shape = image, shape
        self._refused_cells = [(int(x), int(y)) for x, y in zip(*refused.nonzero(), strict=True)]
        self.update()

    def area(self) -> QRectF:
        """Return the rectangle inside the axes, in pixels."""
        key = (self.size(), bool(self.title))
        if self._area_key != key:
            self._area_key, self._area = key, self._find_area()
        return self._area

    def _find_area(self) -> QRectF:
        metrics = self.fontMetrics()
        left = metrics.height() + metrics.horizontalAdvance("0.05") + _TICK + 2 * _GAP
        bottom = 2 * metrics.height() + _TICK + _GAP
        top = metrics.height() + _GAP if self.title else _GAP + metrics.height() / 2
        right = metrics.horizontalAdvance("100") / 2  # half of the last number lies outside the map
        return QRectF(self.rect()).adjusted(left, top, -right, -bottom)

    def place_of(self, point: Point) -> QPointF:
        """Return the pixel of a point, given in fractions of both axes."""
        area = self.area()
        (x, y), (across, up) = point, self._shape
        if self.image.isNull():  # without cells, the ends of the axes are their limits
            return QPointF(area.left() + x * area.width(), area.bottom() - y * area.height())
        return QPointF(
            area.left() + (x * (across - 1) + 0.5) / across * area.width(),
            area.bottom() - (y * (up - 1) + 0.5) / up * area.height(),
        )

    def cell_at(self, pixel: QPointF) -> tuple[int, int] | None:
        """Return the point whose cell contains a pixel; None outside the map."""
        area = self.area()
        if self.image.isNull() or not area.contains(pixel):
            return None
        across = (pixel.x() - area.left()) / area.width() * self._shape[0]
        up = (area.bottom() - pixel.y()) / area.height() * self._shape[1]
        return min(int(across), self._shape[0] - 1), min(int(up), self._shape[1] - 1)

    def paint_with(self, painter: QPainter) -> None:
        area = self.area()
        painter.fillRect(area, self.palette().color(QPalette.ColorRole.Base))
        painter.drawImage(area, self.image)
        hatch = QBrush(self.palette().color(QPalette.ColorRole.Mid), Qt.BrushStyle.BDiagPattern)
        for cell in self._refused_cells:
            painter.fillRect(self._find_cell_area(*cell), hatch)
        painter.setPen(self.palette().color(QPalette.ColorRole.Mid))
        painter.drawRect(area)
        self.draw_axes(painter, area)
        painter.setClipRect(area)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for key, lines in self.lines.items():
            self._draw_lines(painter, key, lines)
        self._draw_marks(painter, area)

    def _find_cell_area(self, x: int, y: int) -> QRectF:
        area = self.area()
        width, height = area.width() / self._shape[0], area.height() / self._shape[1]
        return QRectF(area.left() + x * width, area.bottom() - (y + 1) * height, width, height)

    def draw_axes(self, painter: QPainter, area: QRectF) -> None:
        if self._axes is None:
            return
        line = self.fontMetrics().height()
        text = self.palette().color(QPalette.ColorRole.WindowText)
        painter.setPen(text)
        centre = Qt.AlignmentFlag.AlignCenter
        x, y = self._axes
        for tick in make_ticks(x, int(area.width() / 38)):
            tick_x = self.place_of((tick.place, 0.0)).x()
            painter.drawLine(QPointF(tick_x, area.bottom()), QPointF(tick_x, area.bottom() + _TICK))
            painter.drawText(
                QRectF(tick_x - 30, area.bottom() + _TICK, 60, line), centre, tick.text
            )
        for tick in make_ticks(y, int(area.height() / (1.3 * line))):
            tick_y = self.place_of((0.0, tick.place)).y()
            painter.drawLine(QPointF(area.left() - _TICK, tick_y), QPointF(area.left(), tick_y))
            number_area = QRectF(0, tick_y - line / 2, area.left() - _TICK - _GAP, line)
            painter.drawText(
                number_area, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, tick.text
            )
        title_area = QRectF(area.left(), self.height() - line, area.width(), line)
        painter.drawText(title_area, centre, self._fit_title(x, area.width()))
        painter.drawText(QRectF(area.left(), 0, area.width(), line), centre, self.title)
        painter.save()
        painter.translate(0, area.bottom())
        painter.rotate(-90)
        painter.drawText(
            QRectF(0, 0, area.height(), line), centre, self._fit_title(y, area.height())
        )
        painter.restore()

    def _fit_title(self, quantity: Quantity, width: float) -> str:
        metrics = self.fontMetrics()
        title = write_axis_title(quantity)
        if metrics.horizontalAdvance(title) <= width:
            return title
        short = write_axis_title(quantity, short=True)
        return metrics.elidedText(short, Qt.TextElideMode.ElideRight, int(width))

    def _draw_lines(self, painter: QPainter, key: str, lines: list[FloatArray]) -> None:
        pen = QPen(_INK, 1.6, STYLES[key])
        casing = QPen(_CASING, 3.6)
        for line in lines:
            path = QPolygonF([self.place_of(point) for point in self._extend_to_edges(line)])
            for layer in (casing, pen):
                painter.setPen(layer)
                painter.drawPolyline(path)

    def _extend_to_edges(self, line: FloatArray) -> list[Point]:
        """Extend a line that ends at the centres of the outermost cells to the edge of the map."""
        points: list[Point] = [(float(x), float(y)) for x, y in line]
        if len(points) < 2 or self.image.isNull():
            return points
        first, last = points[0], points[-1]
        start = self._find_exit(points[1], first)
        end = self._find_exit(points[-2], last)
        return [*([start] if start else []), *points, *([end] if end else [])]

    def _find_exit(self, previous: Point, end: Point) -> Point | None:
        """Return where a line leaves the map; None if it ends inside the range of both axes."""
        steps = []
        for start, stop, count in zip(previous, end, self._shape, strict=True):
            change, margin = stop - start, 0.5 / max(count - 1, 1)
            is_at_end = min(abs(stop), abs(1.0 - stop)) < _END_TOLERANCE
            if is_at_end and change and (change > 0.0) == (stop > 0.5):
                steps.append(margin / abs(change))
        if not steps:
            return None
        step = min(steps)
        (x0, y0), (x1, y1) = previous, end
        return x1 + step * (x1 - x0), y1 + step * (y1 - y0)

    def _draw_marks(self, painter: QPainter, area: QRectF) -> None:
        if self._cursor is not None:
            painter.setPen(QPen(_PAPER, 1.5))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(self._find_cell_area(*self._cursor))
        if self.setting is None:
            return
        centre = self.place_of(self.setting)
        for pen in (QPen(QColor(0, 0, 0, 160), 3.0), QPen(_PAPER, 1.0)):
            painter.setPen(pen)
            painter.drawLine(QPointF(centre.x(), area.top()), QPointF(centre.x(), area.bottom()))
            painter.drawLine(QPointF(area.left(), centre.y()), QPointF(area.right(), centre.y()))
        painter.setPen(QPen(_INK, 1.5))
        painter.setBrush(_PAPER)
        painter.drawEllipse(centre, 4.0, 4.0)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        self._point_at(self.cell_at(event.position()))

    def leaveEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().leaveEvent(event)
        self._point_at(None)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        cell = self.cell_at(event.position())
        if cell is not None and event.button() == Qt.MouseButton.LeftButton:
            self.picked.emit(*cell)

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 - Qt's name
        """Move from point to point with the arrow keys, and choose one with Enter."""
        key = Qt.Key(event.key())
        if key in _STEPS and not self.image.isNull():
            self._step(*_STEPS[key])
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self._cursor is not None:
            self.picked.emit(*self._cursor)
        else:
            super().keyPressEvent(event)

    def _step(self, across: int, up: int) -> None:
        start = self._cursor
        if start is None:
            x, y = self.setting or (0.5, 0.5)
            start = (round(x * (self._shape[0] - 1)), round(y * (self._shape[1] - 1)))
        axes = zip(start, (across, up), self._shape, strict=True)
        x, y = (min(max(place + step, 0), count - 1) for place, step, count in axes)
        self._point_at((int(x), int(y)))

    def _point_at(self, cell: tuple[int, int] | None) -> None:
        if cell != self._cursor:
            self._cursor = cell
            self.pointed.emit(cell)
            self.update()
