"""Axis of the columns in view, scales, crosshair and gutter, shared by the rows of the story."""

import math
from collections.abc import Sequence

from PySide6.QtCore import QObject, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFont, QFontMetrics, QPainter, QPalette, QPen
from PySide6.QtWidgets import QSizePolicy

from occ_gui.widgets.columns import round_step
from occ_gui.widgets.guarded_paint import PaintedWidget

LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter

GUTTER = 104  # pixels at the left of each row for its name and levels, at the usual text size

MARGIN = 12  # pixels at the right of each row
_LEAST_SPAN = 4.0  # fewest columns in view
_MARGIN_FRACTION = 0.5  # most empty space beside the picture, as a fraction of the range in view

_WIDEST_WORD = "chips"  # the widest of the words beside a row's name
GAPS = 14  # pixels between and around a name and the word beside it
_LARGEST_GUTTER = 2 * GUTTER  # more would leave the columns too little room

CURSOR_NAMES = ("1", "2")  # not A and B, which are the names of pinned scenes
_CURSOR_STARTS = (0.3, 0.6)  # as fractions of the range in view


class ColumnAxis(QObject):
    """The range of columns in view.

    Column ``i`` lies at ``i``; as a pixel of the picture it reaches from ``i - 0.5`` to
    ``i + 0.5``. The time at ``i`` is that at which its exposure begins.
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.first, self.last = -0.5, 99.5
        self._home = (self.first, self.last)
        self._picture_range = (self.first, self.last)
        self.gutter = GUTTER  # pixels at the left of each row
        self.is_following = True

    @property
    def span(self) -> float:
        return self.last - self.first

    def find_pixel(self, column: float, width: float) -> float:
        """Return where a column lies in a row of this width, in pixels from its left."""
        return self.gutter + (column - self.first) / self.span * self.plot_width(width)

    def find_column(self, pixel: float, width: float) -> float:
        return self.first + (pixel - self.gutter) / self.plot_width(width) * self.span

    def plot_width(self, width: float) -> float:
        """Return the pixels of a row of this width that show columns."""
        return max(1.0, width - self.gutter - MARGIN)

    def set_gutter(self, pixels: int) -> None:
        if pixels != self.gutter:
            self.gutter = pixels
            self.changed.emit()

    def set_home(self, first: float, last: float, columns: int) -> None:
        self._home = (first, last)
        self._picture_range = (-0.5, columns - 0.5)
        if self.is_following:
            self._set(*self._home)
        else:
            self._set(*self._clamp(self.first, self.last))

    def fit(self) -> None:
        self.is_following = True
        self._set(*self._home)

    def zoom(self, factor: float, fixed: float) -> None:
        """Show ``factor`` times as many columns; the column ``fixed`` stays in its place."""
        widest = (self._picture_range[1] - self._picture_range[0]) * (1.0 + _MARGIN_FRACTION)
        span = min(max(self.span * factor, _LEAST_SPAN), max(widest, _LEAST_SPAN))
        fraction = (fixed - self.first) / self.span
        self._move(fixed - fraction * span, fixed + (1.0 - fraction) * span)

    def pan(self, columns: float) -> None:
        """Move by a number of columns, to the right if it is positive."""
        self._move(self.first + columns, self.last + columns)

    def reveal(self, first: float, last: float) -> None:
        """Move as little as possible so that these columns are in view."""
        if first < self.first:
            self.pan(first - self.first)
        elif last > self.last:
            self.pan(min(last - self.last, first - self.first))

    def _move(self, first: float, last: float) -> None:
        self.is_following = False
        self._set(*self._clamp(first, last))

    def _clamp(self, first: float, last: float) -> tuple[float, float]:
        """Shift a range so that the picture stays in view."""
        margin = _MARGIN_FRACTION * (last - first)
        low, high = self._picture_range[0] - margin, self._picture_range[1] + margin
        shift = max(low - first, 0.0) + min(high - last, 0.0)
        return first + shift, last + shift

    def _set(self, first: float, last: float) -> None:
        if (first, last) != (self.first, self.last):
            self.first, self.last = first, last
            self.changed.emit()


class MeasureCursors(QObject):
    """Two columns that the user moves to measure, or none."""

    changed = Signal()  # a cursor has moved, or they have been switched on or off

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.columns: list[float] = []  # empty while nothing is measured

    def switch(self, on: bool, first: float, last: float) -> None:
        self.columns = (
            [first + fraction * (last - first) for fraction in _CURSOR_STARTS] if on else []
        )
        self.changed.emit()

    def move(self, index: int, column: float, columns: int) -> None:
        if self.columns:
            self.columns[index] = min(max(column, 0.0), columns - 1.0)
            self.changed.emit()

    def find_nearest(self, column: float, most: float) -> int | None:
        """Return the index of the nearest cursor, unless it is more than ``most`` columns away."""
        distances = [(abs(other - column), index) for index, other in enumerate(self.columns)]
        distance, index = min(distances, default=(math.inf, None))
        return index if distance <= most else None


class Crosshair(QObject):
    """The column under the mouse, the column whose exposure is shown, and the cursors."""

    pointed_at = Signal()  # the mouse is at another column, or at none

    chosen = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.mouse_column: int | None = None
        self.column: int | None = None
        self.columns = 0
        self.cursors = MeasureCursors(self)

    def set_columns(self, columns: int, first: int) -> None:
        """Set the number of columns; choose ``first`` if none is chosen yet."""
        self.columns = columns
        self.choose(first if self.column is None else self.column)
        if self.mouse_column is not None:
            self.point_at(self.mouse_column)

    def point_at(self, column: float | None) -> None:
        nearest = None if column is None else round(column)
        if nearest is not None and not 0 <= nearest < self.columns:
            nearest = None
        if nearest != self.mouse_column:
            self.mouse_column = nearest
            self.pointed_at.emit()

    def choose(self, column: float) -> None:
        if not self.columns:
            return
        nearest = min(max(round(column), 0), self.columns - 1)
        if nearest != self.column:
            self.column = nearest
            self.chosen.emit()

    @property
    def shown_column(self) -> int | None:
        """The column whose values are shown: that under the mouse, else the chosen one."""
        return self.column if self.mouse_column is None else self.mouse_column


def line_height(metrics: QFontMetrics, usual: int, margin: int = 2) -> int:
    """Return the height of a line of text in pixels, with a margin, and at least ``usual``."""
    return max(usual, metrics.height() + margin)


def find_gutter_width(font: QFont, names: Sequence[str]) -> int:
    """Return the width in pixels of the rows' names with their levels."""
    widest = max(measure_name(name, font) for name in names)
    return min(max(GUTTER, widest + GAPS), _LARGEST_GUTTER)


def measure_name(name: str, font: QFont) -> int:
    """Return the width in pixels of a row's name and the word beside it, without gaps."""
    bold = QFont(font)
    bold.setBold(True)
    word = QFontMetrics(font).horizontalAdvance(_WIDEST_WORD)
    return QFontMetrics(bold).horizontalAdvance(name) + word


_HEIGHT = 18
_TICK = 5
_SPACING = 76  # fewest pixels between two numbers


class Scale(PaintedWidget):
    """An axis with numbers: ``start`` at column 0, and ``step`` more at each next column."""

    def __init__(
        self, name: str, axis: ColumnAxis, *, is_above: bool, least_step: float = 0.0
    ) -> None:
        super().__init__()
        self._name, self.axis, self._is_above = name, axis, is_above
        self._start, self._step, self._least_step = 0.0, 1.0, least_step
        self.setAccessibleName(name)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        axis.changed.connect(self.update)

    def count_from(self, start: float, step: float, name: str) -> None:
        if (start, step, name) != (self._start, self._step, self._name):
            self._start, self._step, self._name = start, step, name
            self.setAccessibleName(name)
            self.update()

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(160, line_height(self.fontMetrics(), _HEIGHT))

    def list_ticks(self) -> list[tuple[float, str]]:
        low, high = (self._start + end * self._step for end in (self.axis.first, self.axis.last))
        per_pixel = (high - low) / self.axis.plot_width(self.width())
        step = max(round_step(_SPACING * per_pixel), self._least_step)
        digits = max(0, -math.floor(math.log10(step)))
        first, last = math.ceil(low / step), math.floor(high / step)
        values = [multiple * step for multiple in range(first, last + 1)]
        return [((value - self._start) / self._step, f"{value:.{digits}f}") for value in values]

    def paint_with(self, painter: QPainter) -> None:
        text = self.palette().color(QPalette.ColorRole.WindowText)
        painter.setPen(text)
        painter.drawText(QRectF(0, 0, self.axis.gutter - 6, self.height()), RIGHT, self._name)
        end = float(self.height()) if self._is_above else 0.0
        tick = -_TICK if self._is_above else _TICK
        metrics = painter.fontMetrics()
        for column, number in self.list_ticks():
            x = round(self.axis.find_pixel(column, self.width())) + 0.5
            painter.setPen(QPen(self.palette().color(QPalette.ColorRole.WindowText), 1))
            painter.drawLine(QPointF(x, end), QPointF(x, end + tick))
            width = metrics.horizontalAdvance(number)
            left = min(max(x + 4, self.axis.gutter), self.width() - width)
            painter.drawText(QRectF(left, 0, width + 2, self.height()),
                             Qt.AlignmentFlag.AlignVCenter, number)  # fmt: skip
