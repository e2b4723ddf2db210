"""A picture, with the fitted bars drawn over it."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPalette, QPen, QPolygonF

from occ_gui.widgets.colours import SIMULATION
from occ_gui.widgets.guarded_paint import PaintedWidget
from occ_model.arrays import ByteArray, FloatArray

_SIZE = QSize(280, 200)
_LARGEST_DEVIATION = 0.4
"""Distance of the curve's farthest point from the middle of its tile, in tiles."""


class BarsPicture(PaintedWidget):
    """Shows a picture, and the fitted brightness of each of its tiles as a curve along the tile.

    The curve moves to the right where the tile is bright; for bars along columns, down.
    """

    def __init__(self, name: str) -> None:
        super().__init__()
        self.setAccessibleName(name)
        self.setMinimumSize(_SIZE)
        self._image: QImage | None = None
        self._waves: FloatArray | None = None
        self._is_along_columns = False

    def show_picture(self, picture: ByteArray | None) -> None:
        self._image = None
        if picture is not None:
            pixels = np.ascontiguousarray(picture)
            rows, columns = pixels.shape
            kind = QImage.Format.Format_Grayscale8
            self._image = QImage(pixels.tobytes(), columns, rows, columns, kind).copy()
        self.show_bars(None)

    def show_bars(self, waves: FloatArray | None, *, is_along_columns: bool = False) -> None:
        """Show bars of shape (tiles, points); they are along lines, or along columns."""
        self._waves, self._is_along_columns = waves, is_along_columns
        self.update()

    def paint_with(self, painter: QPainter) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        if self._image is None:
            painter.setPen(self.palette().color(QPalette.ColorRole.Mid))
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))
            painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, self.accessibleName())
            return
        place = self._find_place(self._image)
        painter.drawImage(place, self._image)
        if self._waves is not None:
            curves = self._make_curves(self._waves, place)
            for colour, width in ((QColor("white"), 4.0), (SIMULATION, 2.0)):
                painter.setPen(QPen(colour, width))
                for curve in curves:
                    painter.drawPolyline(curve)

    def _find_place(self, image: QImage) -> QRectF:
        size = image.size().scaled(self.size(), Qt.AspectRatioMode.KeepAspectRatio)
        left, top = (self.width() - size.width()) / 2, (self.height() - size.height()) / 2
        return QRectF(left, top, size.width(), size.height())

    def _make_curves(self, waves: FloatArray, place: QRectF) -> list[QPolygonF]:
        tiles, count = waves.shape
        scale = _LARGEST_DEVIATION / tiles / max(float(np.abs(waves).max()), 1e-9)
        along = (np.arange(count) + 0.5) / count
        curves = []
        for tile, wave in enumerate(waves):
            across = (tile + 0.5) / tiles + scale * wave
            right, down = (along, across) if self._is_along_columns else (across, along)
            points = zip(
                place.left() + right * place.width(), place.top() + down * place.height(),
                strict=True,
            )  # fmt: skip
            curves.append(QPolygonF([QPointF(float(x), float(y)) for x, y in points]))
        return curves
