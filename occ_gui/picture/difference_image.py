"""How far two images differ, drawn without false stripes."""

import math

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage, QPainter
from PySide6.QtWidgets import QStyleOptionGraphicsItem, QWidget

from occ_gui.picture.cell_means import cell_means
from occ_gui.widgets.guarded_paint import guarded
from occ_model.arrays import ByteArray, FloatArray

_NO_IMAGE: ByteArray = np.zeros((0, 0), dtype=np.uint8)

_Layer = tuple[ByteArray, QRectF]


class DifferenceImage(pg.GraphicsObject):  # type: ignore[misc]  # pyqtgraph has no types
    """The absolute difference of two images where both lie, black where they are alike.

    Both are averaged over the pixels of the screen first: only what is seen is worked out, and
    stripes finer than a pixel of the screen make no coarser ones.
    """

    def __init__(self) -> None:
        super().__init__()
        self._layers: tuple[_Layer, _Layer] = ((_NO_IMAGE, QRectF()), (_NO_IMAGE, QRectF()))
        self._gain = 1
        self._means: dict[int, tuple[QRectF, tuple[int, int], FloatArray]] = {}

    def set_image(self, layer: int, image: ByteArray, rect: QRectF) -> None:
        """Give one of the two images, 0 or 1, and where it lies; it is not copied."""
        first, second = self._layers
        new = (image, QRectF(rect))
        self.prepareGeometryChange()
        self._layers = (new, second) if layer == 0 else (first, new)
        self._means.pop(layer, None)
        self.update()

    def set_gain(self, gain: int) -> None:
        """Say how many times the difference is drawn."""
        self._gain = gain
        self.update()

    def boundingRect(self) -> QRectF:  # noqa: N802 - Qt's name
        """Where both images lie."""
        (_, first), (_, second) = self._layers
        return first.intersected(second)

    @guarded
    def paint(
        self,
        painter: QPainter,
        _option: QStyleOptionGraphicsItem,
        _widget: QWidget | None = None,
    ) -> None:
        """Draw the part that can be seen, at the size it is seen."""
        view = self.viewRect()
        grid = QRectF() if view is None else view.intersected(self.boundingRect())
        if grid.isEmpty():
            return
        on_screen = painter.deviceTransform().mapRect(grid)
        shape = (max(1, math.ceil(on_screen.height())), max(1, math.ceil(on_screen.width())))
        difference = np.abs(self._averaged(0, grid, shape) - self._averaged(1, grid, shape))
        levels = np.minimum(self._gain * difference + 0.5, 255.0).astype(np.uint8, order="C")
        rows, columns = shape
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, False)
        image = QImage(levels.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
        painter.drawImage(grid, image)

    def _averaged(self, layer: int, grid: QRectF, shape: tuple[int, int]) -> FloatArray:
        """Average an image over the screen's pixels, unless that has been done."""
        known = self._means.get(layer)
        if known is not None and known[:2] == (grid, shape):
            return known[2]
        means = cell_means(*self._layers[layer], grid, shape)
        self._means[layer] = (QRectF(grid), shape, means)
        return means
