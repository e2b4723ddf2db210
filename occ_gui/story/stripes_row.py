"""Row of the stripes: the picture cropped to the panel, and the whole frame as a thumbnail."""

import math

import cv2
import numpy as np
from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QImage, QPainter, QPaintEvent, QPalette, QPen, QResizeEvent
from PySide6.QtWidgets import QAbstractButton, QWidget

from occ_gui.simulation.snapshot import PictureView, mean_of_cells
from occ_gui.story.column_axis import GUTTER, ColumnAxis, Crosshair
from occ_gui.story.story_row import StoryRow
from occ_gui.widgets.colours import REGION
from occ_gui.widgets.guarded_paint import guarded
from occ_model.arrays import ByteArray, FloatArray

_LEAST_HEIGHT = 40
_NAME_HEIGHT = 22  # pixels of the row's name above the thumbnail
_LEAST_THUMBNAIL = 32  # smallest height in pixels of a thumbnail in which a frame can be recognized


class StripesRow(StoryRow):
    """The rows of the picture that show the panel, averaged over each pixel of the screen."""

    def __init__(self, axis: ColumnAxis, crosshair: Crosshair) -> None:
        super().__init__("Picture", axis, crosshair)
        self.setMinimumHeight(_LEAST_HEIGHT)
        self._rows = self._all_rows = range(0)
        self._image: ByteArray | None = None
        self._corners: FloatArray | None = None
        self.thumbnail = FrameThumbnail(self)
        axis.changed.connect(self._mark_view)

    def show_picture(self, picture: PictureView) -> None:
        self._image, self._corners, self._rows = picture.image, picture.corners, picture.rows
        self._all_rows = range(picture.size[0])
        if picture.is_whole:
            self.thumbnail.show_image(picture.image, *picture.size)
        self._mark_view()
        self.redraw()

    def rows_per_pixel(self) -> float:
        """Return the picture's rows per screen pixel, the same for every draft."""
        first, last = self._find_panel_rows(self._all_rows)
        pixels = max(1.0, self.height() * self.devicePixelRatioF())
        return (last - first) / pixels

    def panel_rows(self) -> tuple[int, int]:
        """Return the panel's first row in the whole picture and the one after its last."""
        return self._find_panel_rows(self._rows)

    def _find_panel_rows(self, rows: range) -> tuple[int, int]:
        """Return the index in ``rows`` of the panel's first row, and that after its last.

        If the panel is outside the picture, they include all rows.
        """
        if self._corners is None:
            return 0, 0
        top, bottom = self._corners[:, 1].min(), self._corners[:, 1].max()
        first = max(math.ceil((top - rows.start) / rows.step), 0)
        last = min(math.floor((bottom - rows.start) / rows.step) + 1, len(rows))
        return (first, last) if first < last else (0, len(rows))

    def draw(self, painter: QPainter, area: QRectF) -> None:
        if self._image is None:
            return
        painter.fillRect(area, self.colour(QPalette.ColorRole.Mid))
        first_row, last_row = self.panel_rows()
        columns = self._image.shape[1]
        ratio = self.devicePixelRatioF()
        left = max(self.x_of(-0.5), area.left())
        right = min(self.x_of(columns - 0.5), area.right())
        if right <= left:
            return
        # Aligned to the pixels of the screen, so that nothing is scaled a second time.
        pixels = np.arange(np.floor(left * ratio), np.ceil(right * ratio) + 1.0) / ratio
        edges = np.array([self.column_at(x) for x in (pixels[0], pixels[-1])]) + 0.5
        edges = np.linspace(edges[0], edges[1], len(pixels))
        low = max(int(edges[0]), 0)
        high = min(int(np.ceil(edges[-1])) + 1, columns)
        part = self._image[first_row:last_row, low:high]
        grey = resample(part, edges - low, max(1, round(area.height() * ratio)))
        rows, cells = grey.shape
        image = QImage(grey.data, cells, rows, cells, QImage.Format.Format_Grayscale8)
        image.setDevicePixelRatio(ratio)
        painter.drawImage(QRectF(pixels[0], area.top(), cells / ratio, rows / ratio), image)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        height = max(self.height() - _NAME_HEIGHT - 3, 0)
        self.thumbnail.setGeometry(4, _NAME_HEIGHT, GUTTER - 12, height)
        self.thumbnail.setVisible(height >= _LEAST_THUMBNAIL)

    def _mark_view(self) -> None:
        # The first row of a draft is in the middle of those that it stands for.
        above, step = self._rows.start // self._rows.step, self._rows.step
        first, last = ((above + row) * step for row in self.panel_rows())
        self.thumbnail.show_view(self.axis.first, self.axis.last, first, last)


class FrameThumbnail(QAbstractButton):
    """The whole frame, small, with the part in view; a click shows the picture large."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._pixels: ByteArray | None = None
        self._image: QImage | None = None
        self._size = (0, 0)
        self.view = QRectF()
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setAccessibleName("Show the whole picture")
        self.setToolTip(
            "The whole picture, with the part that is shown here: click to see it large."
        )

    def show_image(self, pixels: ByteArray, rows: int, columns: int) -> None:
        self._size = (rows, columns)
        self._pixels, self._image = pixels, None
        self.update()

    def _scale_image(self, pixels: ByteArray, rect: QRectF) -> QImage:
        ratio = self.devicePixelRatioF()
        width, height = max(1, round(rect.width() * ratio)), max(1, round(rect.height() * ratio))
        small = np.ascontiguousarray(mean_of_cells(pixels, width, height))
        rows, columns = small.shape
        image = QImage(small.data, columns, rows, columns, QImage.Format.Format_Grayscale8).copy()
        image = image.scaled(width, height)  # repeats the rows of a draft
        image.setDevicePixelRatio(ratio)
        return image

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._image = None

    def show_view(self, first: float, last: float, first_row: int, last_row: int) -> None:
        self.view = QRectF(first, first_row, last - first, last_row - first_row)
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(GUTTER - 12, _LEAST_HEIGHT)

    def image_rect(self) -> QRectF:
        rows, columns = self._size
        if not rows or not columns:
            return QRectF()
        scale = min((self.width() - 2) / columns, (self.height() - 2) / rows)
        return QRectF(1, 1, columns * scale, rows * scale)

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        painter = QPainter(self)
        rect = self.image_rect()
        if self._pixels is None or rect.width() < 4:
            return
        if self._image is None or self._image.devicePixelRatioF() != self.devicePixelRatioF():
            self._image = self._scale_image(self._pixels, rect)
        painter.drawImage(rect.topLeft(), self._image)
        scale = rect.width() / self._size[1]
        left = rect.left() + (self.view.left() + 0.5) * scale
        top = rect.top() + self.view.top() * scale
        view = QRectF(left, top, self.view.width() * scale, self.view.height() * scale)
        view = view.intersected(rect)
        painter.setPen(QPen(REGION, 1.5))
        painter.drawRect(view)
        is_highlighted = self.hasFocus() or self.underMouse()
        role = QPalette.ColorRole.Highlight if is_highlighted else QPalette.ColorRole.Mid
        painter.setPen(QPen(self.palette().color(role), 2 if is_highlighted else 1))
        painter.drawRect(rect)


def resample(pixels: ByteArray, edges: FloatArray, rows: int) -> ByteArray:
    """Return the exact means of a picture over cells of the screen, of shape (rows, cells).

    ``edges``: the edges of the cells, in columns from the left edge of the picture, whose outermost
    columns continue beyond it. ``rows``: if the picture has fewer, its rows are repeated.
    """
    height = min(rows, pixels.shape[0])
    reduced = cv2.resize(pixels, (pixels.shape[1], height), interpolation=cv2.INTER_AREA)
    columns = reduced.shape[1]
    # A cell's mean is the difference of two values of the running sum along a row, which single
    # precision holds exactly if all sums are below 2^24.
    dtype = np.float32 if 255 * columns < 2**24 else np.float64
    sums = np.zeros((height, columns + 1), dtype=dtype)
    np.cumsum(reduced, axis=1, dtype=dtype, out=sums[:, 1:])
    positions = np.clip(edges, 0.0, columns)
    full_columns = np.minimum(positions.astype(np.int64), columns - 1)
    integral = sums.take(full_columns, axis=1)
    integral += reduced.take(full_columns, axis=1) * (positions - full_columns).astype(dtype)
    means = integral[:, 1:] - integral[:, :-1]
    widths = np.diff(positions)
    is_empty = widths <= 0.0
    means *= (1.0 / np.where(is_empty, 1.0, widths)).astype(dtype)
    if is_empty.any():  # beyond the picture
        nearest = np.clip(np.floor(edges[:-1][is_empty]).astype(np.int64), 0, columns - 1)
        means[:, is_empty] = reduced[:, nearest]
    means += 0.5
    cells = means.astype(np.uint8)
    if height < rows:
        cells = cv2.resize(cells, (cells.shape[1], rows), interpolation=cv2.INTER_NEAREST_EXACT)
    return np.ascontiguousarray(cells)
