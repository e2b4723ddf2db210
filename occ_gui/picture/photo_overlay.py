"""Photo over the simulated picture: blended, split at a line, or as their difference."""

import math

import cv2
import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QObject, QPointF, QRectF, Signal
from PySide6.QtGui import QImage, QPainter
from PySide6.QtWidgets import QStyleOptionGraphicsItem, QWidget

from occ_gui.picture.averaged_image import AveragedImage
from occ_gui.simulation.snapshot import halve
from occ_gui.values.choices import OVERLAYS, Placement
from occ_gui.widgets.colours import PHOTO, REGION
from occ_gui.widgets.guarded_paint import guarded
from occ_model.arrays import ByteArray, FloatArray

_NO_IMAGE: ByteArray = np.zeros((0, 0), dtype=np.uint8)

_LINE_PEN = pg.mkPen(REGION, width=2)
_FRAME_PEN = pg.mkPen(PHOTO, width=2)

_Layer = tuple[ByteArray, QRectF]


def rect_of(image: ByteArray, placement: Placement) -> QRectF:
    """Return the rectangle of a placed image; the placement is the centre of its first pixel."""
    rows, columns = image.shape
    half = placement.scale / 2
    return QRectF(
        placement.column - half,
        placement.row - half,
        columns * placement.scale,
        rows * placement.scale,
    )


class DifferenceImage(pg.GraphicsObject):  # type: ignore[misc]  # pyqtgraph has no types
    """The absolute difference of two images where they overlap, black where they are equal.

    Both images are first averaged over the pixels of the screen, so that only the visible part is
    computed and stripes finer than a screen pixel are not aliased.
    """

    def __init__(self) -> None:
        super().__init__()
        self._layers: tuple[_Layer, _Layer] = ((_NO_IMAGE, QRectF()), (_NO_IMAGE, QRectF()))
        self.gain = 1
        self._means: dict[int, tuple[QRectF, tuple[int, int], FloatArray]] = {}

    def set_image(self, layer: int, image: ByteArray, rect: QRectF) -> None:
        first, second = self._layers
        new = (image, QRectF(rect))
        self.prepareGeometryChange()
        self._layers = (new, second) if layer == 0 else (first, new)
        self._means.pop(layer, None)
        self.update()

    def set_gain(self, gain: int) -> None:
        self.gain = gain
        self.update()

    def boundingRect(self) -> QRectF:  # noqa: N802 - Qt's name
        (_, first), (_, second) = self._layers
        return first.intersected(second)

    @guarded
    def paint(
        self, painter: QPainter, _option: QStyleOptionGraphicsItem, _widget: QWidget | None = None
    ) -> None:
        view = self.viewRect()
        grid = QRectF() if view is None else view.intersected(self.boundingRect())
        if grid.isEmpty():
            return
        on_screen = painter.deviceTransform().mapRect(grid)
        shape = (max(1, math.ceil(on_screen.height())), max(1, math.ceil(on_screen.width())))
        difference = np.abs(self._average(0, grid, shape) - self._average(1, grid, shape))
        levels = np.minimum(self.gain * difference + 0.5, 255.0).astype(np.uint8, order="C")
        rows, columns = shape
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, False)
        image = QImage(levels.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
        painter.drawImage(grid, image)

    def _average(self, layer: int, grid: QRectF, shape: tuple[int, int]) -> FloatArray:
        cached = self._means.get(layer)
        if cached is not None and cached[:2] == (grid, shape):
            return cached[2]
        means = cell_means(*self._layers[layer], grid, shape)
        self._means[layer] = (QRectF(grid), shape, means)
        return means


def difference_cells(first: _Layer, second: _Layer, most: int) -> tuple[FloatArray, QRectF] | None:
    """Return the absolute difference of two images in grey levels, and their common rectangle.

    It is averaged over at most ``most`` cells per side, each at least one unit of the rectangles.
    Returns None if the images do not overlap.
    """
    grid = first[1].intersected(second[1])
    if grid.isEmpty():
        return None
    side = max(1.0, max(grid.width(), grid.height()) / most)
    shape = (max(1, round(grid.height() / side)), max(1, round(grid.width() / side)))
    return np.abs(cell_means(*first, grid, shape) - cell_means(*second, grid, shape)), grid


def cell_means(image: ByteArray, rect: QRectF, grid: QRectF, shape: tuple[int, int]) -> FloatArray:
    """Average an image over the cells of a grid of this shape, in grey levels.

    Each cell is the exact mean of the pixels under it, weighted by the common area, so that images
    of different sizes are compared without aliasing.
    """
    rows, columns = image.shape
    x = _edges(grid.left() - rect.left(), grid.width(), columns / rect.width(), shape[1], columns)
    y = _edges(grid.top() - rect.top(), grid.height(), rows / rect.height(), shape[0], rows)
    # At least one pixel, even if the grid only touches the edge of the image.
    left, top = min(int(x[0]), columns - 1), min(int(y[0]), rows - 1)
    right, bottom = max(int(np.ceil(x[-1])), left + 1), max(int(np.ceil(y[-1])), top + 1)
    pixels = image[top:bottom, left:right]
    pixels, x, y = _halve_while_fine(pixels, x - left, y - top)
    # The running integral is bilinear within each pixel, so this interpolation is exact.
    integral = cv2.integral(np.ascontiguousarray(pixels), sdepth=cv2.CV_64F)
    total = _interpolate(_interpolate(np.asarray(integral, dtype=np.float64), y).T, x).T
    area = np.outer(np.diff(y), np.diff(x))
    means = np.diff(np.diff(total, axis=0), axis=1) / np.maximum(area, 1e-12)
    return np.asarray(means, dtype=np.float64)


def _edges(start: float, width: float, scale: float, cells: int, pixels: int) -> FloatArray:
    edges = (start + width * np.arange(cells + 1) / cells) * scale
    return np.asarray(np.clip(edges, 0.0, pixels), dtype=np.float64)


def _halve_while_fine(
    pixels: ByteArray, x: FloatArray, y: FloatArray
) -> tuple[ByteArray, FloatArray, FloatArray]:
    """Halve an image, which is fast, while a cell spans at least four of its pixels."""
    while min(_mean_cell_size(x), _mean_cell_size(y)) >= 4.0 and min(pixels.shape) >= 2:
        pixels = halve(pixels)
        rows, columns = pixels.shape
        x, y = np.minimum(x / 2, columns), np.minimum(y / 2, rows)
    return pixels, x, y


def _mean_cell_size(edges: FloatArray) -> float:
    return float(edges[-1] - edges[0]) / (len(edges) - 1)


def _interpolate(values: FloatArray, positions: FloatArray) -> FloatArray:
    below = np.minimum(positions.astype(np.intp), len(values) - 2)
    fraction = (positions - below)[:, None]
    return np.asarray(
        values[below] * (1 - fraction) + values[below + 1] * fraction, dtype=np.float64
    )


class PhotoOverlay(QObject):
    """The graphics items over the simulated picture while a photo is shown over it."""

    placed = Signal(object)  # the user moved or scaled the photo: a Placement

    def __init__(self, box: pg.ViewBox) -> None:
        super().__init__()
        self.simulated = _NO_IMAGE
        self._photo: ByteArray | None = None
        self.placement = Placement()
        self.mode = OVERLAYS[0]
        self._is_movable = False
        self._is_updating_frame = False
        self._photo_item, self.difference = AveragedImage(), DifferenceImage()
        self.line = pg.InfiniteLine(angle=0, movable=True, pen=_LINE_PEN)
        self.line.sigPositionChanged.connect(self._split)
        self.line.sigDragged.connect(self._release_line)
        self._line_is_centred = True
        self.frame = pg.ROI((0, 0), (1, 1), pen=_FRAME_PEN, rotatable=False)
        self.frame.addScaleHandle((1, 1), (0, 0), lockAspect=True)
        self.frame.addScaleHandle((0, 0), (1, 1), lockAspect=True)
        self.frame.sigRegionChanged.connect(self._follow_frame)
        for depth, item in enumerate((self._photo_item, self.difference, self.line, self.frame)):
            item.setZValue(10 + depth)
            box.addItem(item, ignoreBounds=True)
        self.opacity = 0.5
        self._arrange()

    def set_simulated(self, image: ByteArray) -> None:
        """Set the picture under the photo, with the centre of its first pixel at (0, 0)."""
        self.simulated = image
        if self.mode == "difference":
            self._compare()

    def set_photo(self, photo: ByteArray | None) -> None:
        self._photo = photo
        self._line_is_centred = True
        self._arrange()

    def set_placement(self, placement: Placement) -> None:
        self.placement = placement
        self._arrange()

    def set_mode(self, mode: str) -> None:
        """Set how the photo is shown, one of OVERLAYS; the first leaves the picture uncovered."""
        self.mode = mode
        self._arrange()

    def set_opacity(self, opacity: float) -> None:
        self.opacity = opacity
        self._arrange()

    def set_movable(self, movable: bool) -> None:
        self._is_movable = movable
        self._arrange()

    @property
    def split_row(self) -> float:
        return float(self.line.value())

    def _arrange(self) -> None:
        photo = self._photo
        is_over = photo is not None and self.mode != "beside"
        self._photo_item.setVisible(is_over and self.mode != "difference")
        self._photo_item.setOpacity(self.opacity if self.mode == "blend" else 1.0)
        self.line.setVisible(is_over and self.mode == "split")
        self.difference.setVisible(is_over and self.mode == "difference")
        self.frame.setVisible(is_over and self._is_movable)
        if photo is None or not is_over:
            return
        rect = rect_of(photo, self.placement)
        self._photo_item.set_image(photo, rect)
        if self._line_is_centred:
            self.line.setValue(rect.center().y())
        self._split()
        if self.mode == "difference":
            self.difference.set_image(1, photo, rect)
            self._compare()
        self._is_updating_frame = True
        self.frame.setPos(rect.topLeft(), update=False)
        self.frame.setSize((rect.width(), rect.height()))
        self._is_updating_frame = False

    def _compare(self) -> None:
        self.difference.set_image(0, self.simulated, rect_of(self.simulated, Placement()))

    def _split(self) -> None:
        self._photo_item.show_within(self.line.value() if self.mode == "split" else -math.inf)

    def _release_line(self) -> None:
        self._line_is_centred = False

    def _follow_frame(self) -> None:
        if self._is_updating_frame or self._photo is None:
            return
        corner: QPointF = self.frame.pos()
        scale = float(self.frame.size().x()) / self._photo.shape[1]
        self.placed.emit(Placement(corner.x() + scale / 2, corner.y() + scale / 2, scale))
