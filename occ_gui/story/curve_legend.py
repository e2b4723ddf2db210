"""Legend of the profile's curves, painted in as many lines as it needs."""

from collections.abc import Mapping, Sequence
from itertools import zip_longest

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPalette, QPen, QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QSizePolicy, QWidget

from occ_gui.widgets.building import fill
from occ_gui.widgets.colours import pen_on
from occ_gui.widgets.event_filters import call_at
from occ_gui.widgets.guarded_paint import PaintedWidget

_SWATCH, _GAP, _ENTRY_GAP = 24, 6, 16  # pixels of a line, after it, and between entries
_SPACING = 6  # pixels between the legend and the controls beside it


class CurveLegend(PaintedWidget):
    """Lines with names, wrapped as needed; space is reserved for the ``usual`` keys."""

    def __init__(self, lines: Mapping[str, tuple[QPen, str]], usual: tuple[str, ...] = ()) -> None:
        super().__init__()
        self._lines, self._usual = dict(lines), usual
        self.keys: tuple[str, ...] = ()
        self.note = ""
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName("Curves of the profile")
        call_at(self, self._fit_height, QEvent.Type.FontChange)

    def rename(self, key: str, name: str) -> None:
        pen, old_name = self._lines[key]
        if name != old_name:
            self._lines[key] = (pen, name)
            keys, self.keys = self.keys, ()
            self.show_lines(keys, self.note, self.toolTip())

    def show_lines(self, keys: tuple[str, ...], note: str = "", meaning: str = "") -> None:
        """Show these entries and a remark after them, whose tooltip is its meaning."""
        self.setToolTip(meaning)
        if (keys, note) != (self.keys, self.note):
            self.keys, self.note = keys, note
            texts = [self._lines[key][1] for key in keys] + ([note] if note else [])
            self.setAccessibleDescription(", ".join(texts))
            self._fit_height()
            self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._fit_height()

    def _fit_height(self) -> None:
        # Not by Qt's height for width, which a row of several widgets queries too late.
        height = self.heightForWidth(self.width())
        if height != self.height() or height != self.minimumHeight():
            self.setFixedHeight(height)

    @property
    def widest(self) -> int:
        return max(map(self._width, self._usual), default=0)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(120, self.heightForWidth(self.width()))

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(_SWATCH, self.fontMetrics().height() + 2)

    def heightForWidth(self, width: int) -> int:  # noqa: N802 - Qt's name
        usual = self._place_entries([*map(self._width, self._usual)], width)
        placed = self._place_entries(self._widths(), width)
        lines = 1 + max((line for _, line in (*usual, *placed)), default=0)
        return lines * self.fontMetrics().height() + 2

    def _width(self, key: str) -> int:
        return _SWATCH + _GAP + self.fontMetrics().horizontalAdvance(self._lines[key][1])

    def _widths(self) -> list[int]:
        note = [self.fontMetrics().horizontalAdvance(self.note)] if self.note else []
        return [*map(self._width, self.keys), *note]

    @staticmethod
    def _place_entries(widths: Sequence[int], available_width: int) -> list[tuple[int, int]]:
        """Return the left edge and the line of each entry."""
        places, left, line = list[tuple[int, int]](), 0, 0
        for width in widths:
            if left and left + width > available_width:
                left, line = 0, line + 1
            places.append((left, line))
            left += width + _ENTRY_GAP
        return places

    def paint_with(self, painter: QPainter) -> None:
        text = self.palette().color(QPalette.ColorRole.WindowText)
        places = self._place_entries(self._widths(), self.width())
        height = painter.fontMetrics().height()
        top = (self.height() - height * (1 + max((line for _, line in places), default=0))) / 2
        for (left, line), key in zip_longest(places, self.keys):
            place = QRectF(left, top + line * height, self.width() - left, height)
            name = self.note
            if key is not None:
                pen, name = self._lines[key]
                thick_pen = QPen(pen_on(self.palette(), pen))
                thick_pen.setWidth(2)
                thick_pen.setCosmetic(False)  # as wide as the curve at any scale of the screen
                painter.setPen(thick_pen)
                middle = place.center().y()
                painter.drawLine(QPointF(left, middle), QPointF(left + _SWATCH, middle))
                place.setLeft(left + _SWATCH + _GAP)
            painter.setPen(text)
            painter.drawText(place, Qt.AlignmentFlag.AlignVCenter, name)


class LegendLine(QWidget):
    """A legend, and to its right the controls of what is shown."""

    def __init__(self, legend: CurveLegend) -> None:
        super().__init__()
        self._legend = legend
        self.controls = fill(QHBoxLayout(), (None, 0), spacing=_SPACING)
        row = QBoxLayout(QBoxLayout.Direction.LeftToRight, self)
        self._layout = fill(row, (legend, 1), self.controls, margins=0, spacing=_SPACING)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        available_width = self.contentsRect().width() - self.controls.sizeHint().width() - _SPACING
        directions = QBoxLayout.Direction
        direction = (
            directions.LeftToRight
            if available_width >= self._legend.widest
            else directions.TopToBottom
        )
        if direction != self._layout.direction():
            self._layout.setDirection(direction)
