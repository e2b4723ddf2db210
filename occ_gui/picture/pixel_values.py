"""Pixel values: the grey level written into each pixel, where pixels are large enough."""

from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QTransform

from occ_model.arrays import ByteArray

_LEAST_WIDTH = 1.3
"""Width of a pixel from which its value is written, relative to that of the widest value."""

_WIDEST = "255"
_MAX_VALUES = 5000
"""Maximum number of values written: more pixels than that cannot be so large on any screen."""

_MIDDLE_GREY = 128


def draw_pixel_values(painter: QPainter, image: ByteArray, part: QRect, target: QRectF) -> int:
    """Write the grey levels of some pixels into them, if they are large enough."""
    to_screen = painter.worldTransform()
    place = to_screen.mapRect(target)
    width, height = place.width() / part.width(), place.height() / part.height()
    metrics = QFontMetricsF(painter.font())
    least = _LEAST_WIDTH * metrics.horizontalAdvance(_WIDEST)
    count = part.width() * part.height()
    if width < least or height < metrics.height() or count > _MAX_VALUES:
        return 0
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
    return count
