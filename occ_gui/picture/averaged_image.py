"""Image item that averages the pixels under each screen pixel, which avoids false stripes."""

import math
from collections.abc import Sequence

import cv2
import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QImage, QPainter, QTransform
from PySide6.QtWidgets import QStyleOptionGraphicsItem, QWidget

from occ_gui.simulation.snapshot import halved
from occ_gui.widgets.guarded_paint import guarded
from occ_model.arrays import ByteArray

_LEAST_WIDTH = 1.3  # of a pixel whose value is written, relative to that of the widest value
_WIDEST_TEXT = "255"
_MAX_VALUES = 5000  # that are written: more pixels than that cannot be so large on any screen
_MIDDLE_GREY = 128


class AveragedImage(pg.GraphicsObject):  # type: ignore[misc]  # pyqtgraph has no types
    """A grey image that shows the mean of the pixels under each pixel of the screen.

    Taking one of them instead, as image items do, turns fine stripes into coarse ones that do not
    exist. A pixel of the image that is larger than one of the screen is drawn as a square;
    ``with_values`` writes its grey level into it where there is room.
    """

    def __init__(self, *, with_values: bool = False) -> None:
        super().__init__()
        self._with_values = with_values
        self.image: ByteArray = np.zeros((0, 0), dtype=np.uint8)
        self.halves: tuple[ByteArray, ...] = ()
        self._rect = QRectF()
        self._first_row, self._last_column = -math.inf, math.inf
        self._drawn: tuple[QRect, tuple[int, int], QImage] | None = None

    def set_image(
        self, image: ByteArray, rect: QRectF | None = None, halves: Sequence[ByteArray] = ()
    ) -> None:
        """Show an image of shape (rows, columns), which is not copied.

        ``rect``: its place, by default with the first pixel's centre at (0, 0).
        """
        rows, columns = image.shape
        rect = QRectF(-0.5, -0.5, columns, rows) if rect is None else rect
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect
        self.image, self.halves = image, tuple(halves)
        self._drawn = None
        self.update()

    def show_within(self, first_row: float = -math.inf, last_column: float = math.inf) -> None:
        """Show only the part at or below this row, and left of this column, of the view."""
        if (first_row, last_column) != (self._first_row, self._last_column):
            self._first_row, self._last_column = first_row, last_column
            self.update()

    def boundingRect(self) -> QRectF:  # noqa: N802 - Qt's name
        return self._rect

    @guarded
    def paint(
        self, painter: QPainter, _option: QStyleOptionGraphicsItem, _widget: QWidget | None = None
    ) -> None:
        part, shown = self._visible_part(), QRectF(self._rect)
        shown.setTop(max(shown.top(), self._first_row))
        shown.setRight(min(shown.right(), self._last_column))
        if part.isEmpty() or shown.isEmpty():
            return
        target = self._target(part)
        on_screen = painter.deviceTransform().mapRect(target)
        size = (max(1, math.ceil(on_screen.width())), max(1, math.ceil(on_screen.height())))
        if self._drawn is None or self._drawn[:2] != (part, size):
            self._drawn = (part, size, self._averaged(part, size))
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, False)
        if shown != self._rect:
            painter.setClipRect(shown, Qt.ClipOperation.IntersectClip)
        painter.drawImage(target, self._drawn[2])
        if self._with_values:
            _draw_values(painter, self.image, part, target)

    def _visible_part(self) -> QRect:
        rows, columns = self.image.shape
        view = self.viewRect()
        seen = QRectF() if view is None else view.intersected(self._rect)
        if seen.isEmpty():
            return QRect()
        x_scale, y_scale = columns / self._rect.width(), rows / self._rect.height()
        left = math.floor((seen.left() - self._rect.left()) * x_scale)
        top = math.floor((seen.top() - self._rect.top()) * y_scale)
        right = math.ceil((seen.right() - self._rect.left()) * x_scale)
        bottom = math.ceil((seen.bottom() - self._rect.top()) * y_scale)
        whole = QRect(0, 0, columns, rows)
        return QRect(left, top, right - left, bottom - top).intersected(whole)

    def _target(self, part: QRect) -> QRectF:
        rows, columns = self.image.shape
        x_scale, y_scale = self._rect.width() / columns, self._rect.height() / rows
        return QRectF(
            self._rect.left() + part.left() * x_scale,
            self._rect.top() + part.top() * y_scale,
            part.width() * x_scale,
            part.height() * y_scale,
        )

    def _averaged(self, part: QRect, size: tuple[int, int]) -> QImage:
        pixels = self.image[
            part.top() : part.top() + part.height(), part.left() : part.left() + part.width()
        ]
        # Only reduced along each axis here: the painter enlarges, without smoothing.
        smaller = (min(size[0], part.width()), min(size[1], part.height()))
        if pixels.shape == self.image.shape:
            pixels = self._smallest_for(*smaller)
        pixels = np.ascontiguousarray(_mean_of_cells(pixels, *smaller))
        rows, columns = pixels.shape
        image = QImage(pixels.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
        return image.copy()  # the array's memory is freed

    def _smallest_for(self, columns: int, rows: int) -> ByteArray:
        """Return the smallest of the image and its halves with at least this many pixels."""
        large = [h for h in self.halves if h.shape[0] >= rows and h.shape[1] >= columns]
        return large[-1] if large else self.image


def _mean_of_cells(pixels: ByteArray, columns: int, rows: int) -> ByteArray:
    """Average an image down to a size that is no larger than its own.

    It is halved repeatedly, which is fast; only the last step has another ratio, less than two.
    The edge that halving leaves out is less than a pixel of the screen.
    """
    while pixels.shape[0] >= 2 * rows and pixels.shape[1] >= 2 * columns:
        pixels = halved(pixels)
    if pixels.shape == (rows, columns):
        return pixels
    smaller = cv2.resize(pixels, (columns, rows), interpolation=cv2.INTER_AREA)
    return np.asarray(smaller, dtype=np.uint8)


def _draw_values(painter: QPainter, image: ByteArray, part: QRect, target: QRectF) -> None:
    """Write the grey levels of some pixels into them, if they are large enough."""
    to_screen = painter.worldTransform()
    place = to_screen.mapRect(target)
    width, height = place.width() / part.width(), place.height() / part.height()
    metrics = QFontMetricsF(painter.font())
    least = _LEAST_WIDTH * metrics.horizontalAdvance(_WIDEST_TEXT)
    is_crowded = part.width() * part.height() > _MAX_VALUES
    if width < least or height < metrics.height() or is_crowded:
        return
    painter.save()
    painter.setWorldTransform(QTransform())
    flipped = to_screen.m22() < 0.0
    for row in range(part.height()):
        line = part.height() - 1 - row if flipped else row
        for column in range(part.width()):
            level = int(image[part.top() + row, part.left() + column])
            painter.setPen(Qt.GlobalColor.black if level >= _MIDDLE_GREY else Qt.GlobalColor.white)
            corner = QPointF(place.left() + column * width, place.top() + line * height)
            box = QRectF(corner.x(), corner.y(), width, height)
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, str(level))
    painter.restore()
