"""Image item that averages the pixels under each screen pixel, which avoids aliasing."""

import math

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QImage, QPainter, QTransform
from PySide6.QtWidgets import QStyleOptionGraphicsItem, QWidget

from occ_gui.simulation.snapshot import mean_of_cells
from occ_gui.widgets.guarded_paint import guarded
from occ_model.arrays import ByteArray

_LEAST_WIDTH = 1.3  # smallest width of a pixel that shows its value, relative to the widest text
_WIDEST_TEXT = "255"
_MAX_VALUES = 5000  # most values that are written: no screen has room for more
_MIDDLE_GREY = 128


class AveragedImage(pg.GraphicsObject):  # type: ignore[misc]  # pyqtgraph has no types
    """A grey image that shows the mean of the image pixels under each screen pixel.

    Image items of pyqtgraph show only one of these pixels, so that fine stripes alias to coarse
    ones. An image pixel that is larger than a screen pixel is drawn as a rectangle;
    ``with_values`` writes its grey level into it if there is room.
    """

    def __init__(self, *, with_values: bool = False) -> None:
        super().__init__()
        self._with_values = with_values
        self.image: ByteArray = np.zeros((0, 0), dtype=np.uint8)
        self._rect = QRectF()
        self._first_row, self._last_column = -math.inf, math.inf
        self._cache: tuple[QRect, tuple[int, int], QImage] | None = None

    def set_image(self, image: ByteArray, rect: QRectF | None = None) -> None:
        """Show an image of shape (rows, columns), which is not copied.

        ``rect``: its place, by default with the centre of the first pixel at (0, 0).
        """
        rows, columns = image.shape
        rect = QRectF(-0.5, -0.5, columns, rows) if rect is None else rect
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect
        self.image = image
        self._cache = None
        self.update()

    def show_within(self, first_row: float = -math.inf, last_column: float = math.inf) -> None:
        """Show only the part of the image from this row down and left of this column."""
        if (first_row, last_column) != (self._first_row, self._last_column):
            self._first_row, self._last_column = first_row, last_column
            self.update()

    def boundingRect(self) -> QRectF:  # noqa: N802 - Qt's name
        return self._rect

    @guarded
    def paint(
        self, painter: QPainter, _option: QStyleOptionGraphicsItem, _widget: QWidget | None = None
    ) -> None:
        part, clip = self._visible_part(), QRectF(self._rect)
        clip.setTop(max(clip.top(), self._first_row))
        clip.setRight(min(clip.right(), self._last_column))
        if part.isEmpty() or clip.isEmpty():
            return
        target = self._rect_of_part(part)
        on_screen = painter.deviceTransform().mapRect(target)
        size = (max(1, math.ceil(on_screen.width())), max(1, math.ceil(on_screen.height())))
        if self._cache is None or self._cache[:2] != (part, size):
            self._cache = (part, size, self._average(part, size))
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, False)
        if clip != self._rect:
            painter.setClipRect(clip, Qt.ClipOperation.IntersectClip)
        painter.drawImage(target, self._cache[2])
        if self._with_values:
            _draw_values(painter, self.image, part, target)

    def _visible_part(self) -> QRect:
        rows, columns = self.image.shape
        view = self.viewRect()
        visible = QRectF() if view is None else view.intersected(self._rect)
        if visible.isEmpty():
            return QRect()
        x_scale, y_scale = columns / self._rect.width(), rows / self._rect.height()
        left = math.floor((visible.left() - self._rect.left()) * x_scale)
        top = math.floor((visible.top() - self._rect.top()) * y_scale)
        right = math.ceil((visible.right() - self._rect.left()) * x_scale)
        bottom = math.ceil((visible.bottom() - self._rect.top()) * y_scale)
        full_image = QRect(0, 0, columns, rows)
        return QRect(left, top, right - left, bottom - top).intersected(full_image)

    def _rect_of_part(self, part: QRect) -> QRectF:
        rows, columns = self.image.shape
        x_scale, y_scale = self._rect.width() / columns, self._rect.height() / rows
        return QRectF(
            self._rect.left() + part.left() * x_scale,
            self._rect.top() + part.top() * y_scale,
            part.width() * x_scale,
            part.height() * y_scale,
        )

    def _average(self, part: QRect, size: tuple[int, int]) -> QImage:
        pixels = self.image[
            part.top() : part.top() + part.height(), part.left() : part.left() + part.width()
        ]
        # The image is only reduced here; the painter enlarges it, without smoothing.
        pixels = np.ascontiguousarray(mean_of_cells(pixels, *size))
        rows, columns = pixels.shape
        image = QImage(pixels.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
        return image.copy()  # it refers to the array's memory, which is freed


def _draw_values(painter: QPainter, image: ByteArray, part: QRect, target: QRectF) -> None:
    """Write the grey levels of some pixels into them, if they are large enough."""
    to_screen = painter.worldTransform()
    on_screen = to_screen.mapRect(target)
    width, height = on_screen.width() / part.width(), on_screen.height() / part.height()
    metrics = QFontMetricsF(painter.font())
    least = _LEAST_WIDTH * metrics.horizontalAdvance(_WIDEST_TEXT)
    is_crowded = part.width() * part.height() > _MAX_VALUES
    if width < least or height < metrics.height() or is_crowded:
        return
    painter.save()
    painter.setWorldTransform(QTransform())
    is_flipped = to_screen.m22() < 0.0
    for row in range(part.height()):
        screen_row = part.height() - 1 - row if is_flipped else row
        for column in range(part.width()):
            level = int(image[part.top() + row, part.left() + column])
            painter.setPen(Qt.GlobalColor.black if level >= _MIDDLE_GREY else Qt.GlobalColor.white)
            corner = QPointF(
                on_screen.left() + column * width, on_screen.top() + screen_row * height
            )
            box = QRectF(corner.x(), corner.y(), width, height)
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, str(level))
    painter.restore()
