"""Timeline of a film: frames and packets, read or lost, and the frame that is shown."""

import math

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPalette,
    QPen,
    QPixmap,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from occ_gui.video.film_reading import LOOKS, Marks, MarkState, brush_of, draw_mark
from occ_gui.widgets.columns import round_step
from occ_gui.widgets.guarded_paint import guarded

_LEAST_GUTTER, _NAME_PADDING, _MARGIN = 64, 6, 10
"""Least width of the names of the rows, room around them, and the margin at the right."""

_FRAMES, _PACKETS, _TICKS, _GAP = 24, 18, 18, 4  # heights of the rows and between, in pixels
_LEAST_SPACING = 80.0  # least pixels between two ticks
_LEAST_MARK = 3.0  # least width in pixels of a single mark; narrower ones are counted in bins

_STEPS = {
    Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1,
    Qt.Key.Key_PageUp: -10, Qt.Key.Key_PageDown: 10,
}  # fmt: skip


class Timeline(QWidget):
    """Frames and packets over time; a click, a drag or a key shows another frame."""

    frame_chosen = Signal(int)  # the frame that the user wants to see
    play_asked = Signal()  # the user starts or stops the film by the space bar

    def __init__(self) -> None:
        super().__init__()
        self.frames, self.packets = Marks(), Marks()
        self.index = 0
        self._first = self._last = 0.0  # the ends of the film, in seconds
        self._pixmap: QPixmap | None = None
        self.setAccessibleName("Timeline")
        self.setToolTip(
            "Frames and packets over time. Click or drag to see a frame; Left and Right step "
            "by one, Page up and Page down by ten, Home and End go to the ends, Space plays."
        )
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self._describe()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(400, _FRAMES + _PACKETS + _TICKS + 3 * _GAP)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(200, self.sizeHint().height())

    def show_frames(self, frames: Marks) -> None:
        self.frames = frames
        self._first, self._last = frames.extent
        self.index = min(self.index, max(len(frames) - 1, 0))
        self._redraw()

    def show_packets(self, packets: Marks) -> None:
        self.packets = packets
        self._redraw()

    def show_index(self, index: int) -> None:
        if index != self.index:
            self.index = index
            self._describe()
            self.update()

    def _redraw(self) -> None:
        self._pixmap = None
        self._describe()
        self.update()

    def _describe(self) -> None:
        count = len(self.frames)
        if not 0 <= self.index < count:
            self.setAccessibleDescription("no film")
            return
        self.setAccessibleDescription(
            f"frame {self.index + 1} of {count}, "
            f"{float(self.frames.starts[self.index]):.3f} s, "
            f"{LOOKS[MarkState(int(self.frames.states[self.index]))].spoken}"
        )

    # Layout.

    def _gutter(self) -> int:
        names = "frames", "packets"
        widest = max(map(self.fontMetrics().horizontalAdvance, names))
        return max(widest + 2 * _NAME_PADDING, _LEAST_GUTTER)

    def _area(self) -> QRectF:
        gutter = self._gutter()
        width = max(1.0, self.width() - gutter - _MARGIN)
        return QRectF(gutter, _GAP, width, _FRAMES + _GAP + _PACKETS)

    def x_of(self, time: float) -> float:
        """Return the position of a time, in pixels from the left."""
        area, span = self._area(), self._last - self._first
        return area.left() + ((time - self._first) / span * area.width() if span > 0.0 else 0.0)

    def frame_at(self, x: float) -> int:
        """Return the index of the frame at a pixel, limited to those of the film."""
        area = self._area()
        time = self._first + (x - area.left()) / area.width() * (self._last - self._first)
        order = np.argsort(self.frames.starts, kind="stable")  # the times of some films go back
        place = int(np.searchsorted(self.frames.starts, time, side="right", sorter=order)) - 1
        return int(order[max(place, 0)]) if len(order) else 0

    # Drawing.

    @guarded
    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        ratio = self.devicePixelRatioF()
        if self._pixmap is None or self._pixmap.devicePixelRatioF() != ratio:
            self._pixmap = self._draw_pixmap(ratio)
        painter = QPainter(self)
        painter.drawPixmap(QPoint(0, 0), self._pixmap)
        self._draw_index(painter)
        if self.hasFocus():
            painter.setPen(QPen(self.palette().color(QPalette.ColorRole.Highlight), 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(QRectF(self.rect()).adjusted(1, 1, -1, -1))

    def _draw_pixmap(self, ratio: float) -> QPixmap:
        pixmap = QPixmap(self.size() * ratio)
        pixmap.setDevicePixelRatio(ratio)
        pixmap.fill(self.palette().color(QPalette.ColorRole.Window))
        painter = QPainter(pixmap)
        painter.setFont(self.font())
        area = self._area()
        for name, marks, top, height in (
            ("frames", self.frames, area.top(), _FRAMES),
            ("packets", self.packets, area.top() + _FRAMES + _GAP, _PACKETS),
        ):
            place = QRectF(area.left(), top, area.width(), height)
            painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
            name_place = QRectF(0, place.top(), area.left() - _NAME_PADDING, place.height())
            flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(name_place, flags, name)
            painter.fillRect(place, self.palette().color(QPalette.ColorRole.Base))
            self._draw_marks(painter, place, marks)
        self._draw_ticks(painter, area)
        painter.end()
        return pixmap

    def _draw_marks(self, painter: QPainter, place: QRectF, marks: Marks) -> None:
        if not len(marks):
            return
        is_visible = (marks.ends > self._first) & (marks.starts < self._last)
        if place.width() / max(int(is_visible.sum()), 1) < _LEAST_MARK:
            self._draw_bins(painter, place, marks)
            return
        palette = self.palette()
        for start, end, state in zip(
            marks.starts[is_visible].tolist(),
            marks.ends[is_visible].tolist(),
            marks.states[is_visible].tolist(),
            strict=True,
        ):
            left, right = self.x_of(start), self.x_of(end)
            width = max(right - left - 1.0, 1.5)
            cell = QRectF(left, place.top(), width, place.height())
            draw_mark(painter, cell.intersected(place), MarkState(state), palette)

    def _draw_bins(self, painter: QPainter, place: QRectF, marks: Marks) -> None:
        """Draw how many marks of each state lie in bins of a few pixels, as stacked bars."""
        bins = max(1, int(place.width() / _LEAST_MARK))
        counts = marks.count_states(np.linspace(self._first, self._last, bins + 1))
        painter.setPen(Qt.PenStyle.NoPen)
        states = (MarkState.READ, MarkState.UNCHECKED, MarkState.LOST)
        brushes = {state: brush_of(state, self.palette()) for state in states}
        for number, row in enumerate(counts.tolist()):
            total, bottom = sum(row), place.bottom()
            left = place.left() + number * _LEAST_MARK
            for state in states:
                height = place.height() * row[state] / total if total else 0.0
                if height:
                    bar = QRectF(left, bottom - height, _LEAST_MARK, height)
                    painter.setBrush(brushes[state])
                    painter.drawRect(bar)
                    bottom -= height

    def _draw_ticks(self, painter: QPainter, area: QRectF) -> None:
        painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
        if self._last <= self._first:
            return
        step, digits = tick_step(self._last - self._first, area.width())
        first = int(np.ceil(self._first / step - 1e-9))
        last = int(np.floor(self._last / step + 1e-9))
        for number in range(first, last + 1):
            x = self.x_of(number * step)
            painter.drawLine(QPointF(x, area.bottom() + 1), QPointF(x, area.bottom() + 4))
            text = f"{number * step:.{digits}f} s"
            width = painter.fontMetrics().horizontalAdvance(text)
            left = min(max(x - width / 2, area.left()), area.right() - width)
            painter.drawText(QPointF(left, area.bottom() + _TICKS - 2), text)

    def _draw_index(self, painter: QPainter) -> None:
        if not 0 <= self.index < len(self.frames):
            return
        area = self._area()
        left = self.x_of(float(self.frames.starts[self.index]))
        right = max(self.x_of(float(self.frames.ends[self.index])), left + 2.0)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        ink, paper = (
            self.palette().color(role)
            for role in (QPalette.ColorRole.Text, QPalette.ColorRole.Base)
        )
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for colour, width in ((paper, 5), (ink, 2)):
            painter.setPen(QPen(colour, width))
            painter.drawRect(QRectF(left, area.top() - 1, right - left, area.height() + 2))
        middle = (left + right) / 2
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(ink)
        points = (QPointF(middle - 5, 0), QPointF(middle + 5, 0), QPointF(middle, 5))
        painter.drawPolygon(QPolygonF(points))

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._pixmap = None

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.FontChange):
            self._redraw()

    # The mouse and the keys.

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        if event.button() == Qt.MouseButton.LeftButton:
            self._seek(self.frame_at(event.position().x()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._seek(self.frame_at(event.position().x()))

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 - Qt's name
        """Step with the arrow keys, go to the ends with Home and End, play with the space bar."""
        key = Qt.Key(event.key())
        if key in _STEPS:
            self._seek(self.index + _STEPS[key])
        elif key == Qt.Key.Key_Home:
            self._seek(0)
        elif key == Qt.Key.Key_End:
            self._seek(len(self.frames) - 1)
        elif key == Qt.Key.Key_Space:
            self.play_asked.emit()
        else:
            super().keyPressEvent(event)

    def _seek(self, index: int) -> None:
        index = min(max(index, 0), len(self.frames) - 1)
        if index >= 0 and index != self.index:
            self.show_index(index)
            self.frame_chosen.emit(index)


def tick_step(span: float, width: float) -> tuple[float, int]:
    """Return the step between ticks in seconds, and the number of its decimals.

    ``span``: the time in view, in seconds, more than zero. ``width``: its length in pixels.
    """
    step = round_step(span * _LEAST_SPACING / max(width, 1.0))
    # Without the factor, a rounding error could give a step of 0.001 a fourth digit.
    return step, max(0, -math.floor(math.log10(step * 1.001)))
