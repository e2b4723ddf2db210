"""Scales of the story: the time above the rows, the columns below them."""

import math

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from occ_gui.story.column_axis import ColumnAxis, line_height
from occ_gui.widgets.guarded_paint import guarded
from occ_gui.widgets.round_step import round_step
from occ_model.scene.scene import Scene

_HEIGHT = 18
_TICK = 5
_SPACING = 76  # fewest pixels from one number to the next

_MICRO = 1e6


class Scale(QWidget):
    def __init__(self, name: str, axis: ColumnAxis, is_above: bool) -> None:
        super().__init__()
        self._name, self.axis, self._is_above = name, axis, is_above
        self.setAccessibleName(name)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        axis.changed.connect(self.update)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(200, line_height(self.fontMetrics(), _HEIGHT))

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(160, line_height(self.fontMetrics(), _HEIGHT))

    def value_of(self, column: float) -> float:
        return column

    def column_of(self, value: float) -> float:
        return value

    def ticks(self) -> list[tuple[float, str]]:
        low, high = self.value_of(self.axis.first), self.value_of(self.axis.last)
        per_pixel = (high - low) / self.axis.plot_width(self.width())
        step = self.least_step(round_step(_SPACING * per_pixel))
        digits = max(0, -math.floor(math.log10(step)))
        first, last = math.ceil(low / step), math.floor(high / step)
        values = [place * step for place in range(first, last + 1)]
        return [(self.column_of(value), f"{value:.{digits}f}") for value in values]

    def least_step(self, step: float) -> float:
        return step

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        painter = QPainter(self)
        text = self.palette().color(QPalette.ColorRole.WindowText)
        painter.setPen(text)
        flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(QRectF(0, 0, self.axis.gutter - 6, self.height()), flags, self._name)
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


class ColumnScale(Scale):
    def __init__(self, axis: ColumnAxis) -> None:
        super().__init__("column", axis, is_above=False)

    def least_step(self, step: float) -> float:
        return max(step, 1.0)


class TimeScale(Scale):
    def __init__(self, axis: ColumnAxis) -> None:
        super().__init__("time (µs)", axis, is_above=True)
        self._start, self._step = 0.0, 1.0

    def show_scene(self, scene: Scene) -> None:
        counted = (scene.model.start_time * _MICRO, scene.camera.readout_time * _MICRO)
        if counted != (self._start, self._step):
            self._start, self._step = counted
            self.update()

    def value_of(self, column: float) -> float:
        return self._start + column * self._step

    def column_of(self, value: float) -> float:
        return (value - self._start) / self._step
