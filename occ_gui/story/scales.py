"""Scales of the story: the time above the rows, the columns below them."""

import math

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from occ_gui.story.column_axis import ColumnAxis, line_height
from occ_gui.story.story_row import RIGHT
from occ_gui.widgets.guarded_paint import guarded
from occ_gui.widgets.round_step import round_step

_HEIGHT = 18
_TICK = 5
_SPACING = 76  # fewest pixels from one number to the next


class Scale(QWidget):
    """Numbers beside their columns: ``start`` at column 0, and a step from column to column."""

    def __init__(
        self, name: str, axis: ColumnAxis, *, is_above: bool, least_step: float = 0.0
    ) -> None:
        super().__init__()
        self._name, self.axis, self._is_above = name, axis, is_above
        self._start, self._step, self._least_step = 0.0, 1.0, least_step
        self.setAccessibleName(name)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        axis.changed.connect(self.update)

    def count_from(self, start: float, step: float) -> None:
        if (start, step) != (self._start, self._step):
            self._start, self._step = start, step
            self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(200, line_height(self.fontMetrics(), _HEIGHT))

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(160, line_height(self.fontMetrics(), _HEIGHT))

    def ticks(self) -> list[tuple[float, str]]:
        low, high = (self._start + end * self._step for end in (self.axis.first, self.axis.last))
        per_pixel = (high - low) / self.axis.plot_width(self.width())
        step = max(round_step(_SPACING * per_pixel), self._least_step)
        digits = max(0, -math.floor(math.log10(step)))
        first, last = math.ceil(low / step), math.floor(high / step)
        values = [place * step for place in range(first, last + 1)]
        return [((v - self._start) / self._step, f"{v:.{digits}f}") for v in values]

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        painter = QPainter(self)
        text = self.palette().color(QPalette.ColorRole.WindowText)
        painter.setPen(text)
        painter.drawText(QRectF(0, 0, self.axis.gutter - 6, self.height()), RIGHT, self._name)
        end = float(self.height()) if self._is_above else 0.0
        tick = -_TICK if self._is_above else _TICK
        metrics = painter.fontMetrics()
        for column, number in self.ticks():
            x = round(self.axis.pixel(column, self.width())) + 0.5
            painter.setPen(QPen(self.palette().color(QPalette.ColorRole.WindowText), 1))
            painter.drawLine(QPointF(x, end), QPointF(x, end + tick))
            width = metrics.horizontalAdvance(number)
            left = min(max(x + 4, self.axis.gutter), self.width() - width)
            painter.drawText(QRectF(left, 0, width + 2, self.height()),
                             Qt.AlignmentFlag.AlignVCenter, number)  # fmt: skip
        painter.end()
