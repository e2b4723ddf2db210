"""Colour maps for success rates, suitable for colour-blind users, and the colour bar."""

from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QImage, QPainter, QPalette
from PySide6.QtWidgets import QSizePolicy

from occ_gui.widgets.guarded_paint import PaintedWidget
from occ_model.arrays import BoolArray, ByteArray, FloatArray

RATES, DIFFERENCES = "viridis", "CET-CBD1"

_COLOURS = 256
_PALE = 120  # opacity of a doubtful value, of 255


@cache
def colour_table(name: str) -> ByteArray:
    """Return the colours of a colour map from its lower end, shape (256, 3)."""
    # Read from pyqtgraph's file, because importing pyqtgraph would delay the first picture.
    package = find_spec("pyqtgraph")
    folder = Path("" if package is None else package.origin or "").parent
    values = np.loadtxt(folder / "colors" / "maps" / f"{name}.csv", delimiter=",", comments=";")
    return np.floor(255 * values + 0.5).astype(np.uint8)


def to_colours(
    values: FloatArray, low: float, high: float, name: str, is_doubtful: BoolArray | bool = False
) -> ByteArray:
    """Map values, shape (x, y), to colours, shape (x, y, 4).

    Doubtful ones are pale, and not-a-number is transparent.
    """
    is_known = np.isfinite(values)
    fraction = np.where(is_known, (values - low) / (high - low), 0.0)
    steps = np.rint(np.clip(fraction, 0.0, 1.0) * (_COLOURS - 1)).astype(np.int64)
    colours = np.empty((*values.shape, 4), dtype=np.uint8)
    colours[..., :3] = colour_table(name)[steps]
    colours[..., 3] = np.where(is_known, np.where(is_doubtful, _PALE, 255), 0)
    return colours


def make_image(colours: ByteArray) -> QImage:
    """Make an image of colours, shape (x, y, 4), with the first y at the bottom."""
    rows = np.ascontiguousarray(colours.transpose(1, 0, 2)[::-1])
    height, width = rows.shape[:2]
    image = QImage(rows.data, width, height, 4 * width, QImage.Format.Format_RGBA8888)
    return image.copy()  # the array's memory is freed


_BAR_WIDTH = 12
_GAP = 4


class ColourBar(PaintedWidget):
    def __init__(self) -> None:
        super().__init__()
        self._colours = QImage()
        self.numbers: tuple[tuple[float, str], ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)

    def show_colours(
        self, colours: QImage, numbers: tuple[tuple[float, str], ...], name: str
    ) -> None:
        """Show colours and numbers.

        ``colours``: an image one pixel wide, with the upper end first.
        ``numbers``: positions from 0 at the bottom to 1 at the top, with the text at each.
        """
        self._colours, self.numbers = colours, numbers
        self.setAccessibleName(name)
        self.setToolTip(name)
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        metrics = self.fontMetrics()
        widest = max((metrics.horizontalAdvance(text) for _, text in self.numbers), default=0)
        return QSize(_BAR_WIDTH + 2 * _GAP + widest, 6 * metrics.height())

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(self.sizeHint().width(), 3 * self.fontMetrics().height())

    def paint_with(self, painter: QPainter) -> None:
        line_height = self.fontMetrics().height()
        bar = QRectF(_GAP, line_height / 2, _BAR_WIDTH, self.height() - line_height)
        painter.drawImage(bar, self._colours)
        painter.setPen(self.palette().color(QPalette.ColorRole.Mid))
        painter.drawRect(bar)
        painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
        most_numbers = max(2, int(self.height() / (1.4 * line_height)))
        step = 1 if len(self.numbers) <= most_numbers else len(self.numbers) - 1
        for position, text in self.numbers[::step]:
            top = bar.bottom() - position * bar.height() - line_height / 2
            area = QRectF(bar.right() + _GAP, top, self.width(), line_height)
            painter.drawText(area, Qt.AlignmentFlag.AlignVCenter, text)
