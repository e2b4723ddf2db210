"""Row of the story: a picture over the columns, with the crosshair, zoomed and moved by mouse."""

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPalette,
    QPen,
    QPixmap,
    QRegion,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy

from occ_gui.story.column_axis import CURSOR_NAMES, GAPS, LEFT, ColumnAxis, Crosshair, measure_name
from occ_gui.widgets.columns import KEY_STEPS
from occ_gui.widgets.event_filters import call_at
from occ_gui.widgets.guarded_paint import PaintedWidget, are_equal
from occ_model.arrays import FloatArray

_ZOOMS = {Qt.Key.Key_Plus: 0.8, Qt.Key.Key_Equal: 0.8, Qt.Key.Key_Minus: 1.25}

_NOTCH = 120  # angle of a wheel's notch, in Qt's units
_ZOOM_PER_NOTCH = 0.85

_GRIP = 6  # pixels from a measuring cursor within which the mouse grabs it

_MOST_REDUCTIONS = 4
"""Most reductions of a font; widths are rounded to pixels, so that one may not suffice."""

_CLICK_DISTANCE = 4  # most pixels between press and release of a click


class StoryRow(PaintedWidget):
    """One of the rows, with its name at the left.

    What depends on the results and the range is cached in a pixmap; the crosshair is drawn over it.
    """

    def __init__(self, name: str, axis: ColumnAxis, crosshair: Crosshair) -> None:
        super().__init__()
        self.name = name
        self.axis, self.crosshair = axis, crosshair
        self._pixmap: QPixmap | None = None
        self._is_pixmap_valid = False
        self._drawn_inputs: tuple[object, ...] = ()
        self._sentences: list[QRectF] = []  # the places of sentences, which no line crosses
        self._press_position: QPointF | None = None
        self._last_position: QPointF | None = None
        self._grabbed_cursor: int | None = None
        self.setAccessibleName(name)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        axis.changed.connect(self.redraw)
        call_at(self, self.redraw, QEvent.Type.PaletteChange, QEvent.Type.FontChange)
        crosshair.pointed_at.connect(self.update)
        crosshair.chosen.connect(self.update)
        crosshair.cursors.changed.connect(self.update)

    def redraw_if_changed(self, *inputs: object) -> bool:
        """Redraw the row if what it draws has changed, and return whether it has.

        Results of a picture are mostly equal to those of the profile or the draft before it.
        """
        is_changed = not are_equal(inputs, self._drawn_inputs)
        if is_changed:
            self._drawn_inputs = inputs
            self.redraw()
        return is_changed

    def redraw(self) -> None:
        self._is_pixmap_valid = False
        self.update()

    def plot_area(self) -> QRectF:
        width = self.axis.plot_width(self.width())
        return QRectF(self.axis.gutter, 0.0, width, float(self.height()))

    def x_of(self, column: float) -> float:
        return self.axis.find_pixel(column, self.width())

    def xs_of(self, columns: FloatArray) -> FloatArray:
        scale = self.axis.plot_width(self.width()) / self.axis.span
        return np.asarray(self.axis.gutter + (columns - self.axis.first) * scale)

    def column_at(self, x: float) -> float:
        return self.axis.find_column(x, self.width())

    def draw(self, painter: QPainter, area: QRectF) -> None:
        """Draw what depends on the results, clipped to an area."""
        raise NotImplementedError

    def write_sentence(
        self, painter: QPainter, rect: QRectF, text: str, flags: Qt.AlignmentFlag = LEFT
    ) -> None:
        """Write a sentence into the row, where the crosshair's lines leave it out."""
        painter.setPen(self.colour(QPalette.ColorRole.Text))
        painter.drawText(rect, flags, text)
        self._sentences.append(painter.boundingRect(rect, flags, text))

    def draw_gutter(self, painter: QPainter, area: QRectF) -> None:
        """Draw what stands in the gutter, beside the row's name."""

    def draw_markers(self, painter: QPainter, area: QRectF) -> None:
        """Draw the marks of the chosen column."""

    def draw_value_mark(self, painter: QPainter, column: int, area: QRectF) -> None:
        """Draw the mark of the column whose values are shown."""

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        self._is_pixmap_valid = False

    def paint_with(self, painter: QPainter) -> None:
        ratio = self.devicePixelRatioF()
        if (
            self._pixmap is None
            or not self._is_pixmap_valid
            or self._pixmap.devicePixelRatioF() != ratio
        ):
            self._pixmap, self._is_pixmap_valid = self._draw_pixmap(ratio), True
        painter.drawPixmap(QPoint(0, 0), self._pixmap)
        area = self.plot_area()
        beside_sentences = QRegion(area.toRect())
        for place in self._sentences:
            beside_sentences -= QRegion(place.toAlignedRect().adjusted(-4, 0, 4, 0))
        painter.setClipRegion(beside_sentences)
        if self.crosshair.column is not None:
            self._draw_line(painter, self.crosshair.column, area, Qt.PenStyle.SolidLine)
        if self.crosshair.mouse_column is not None:
            self._draw_line(painter, self.crosshair.mouse_column, area, Qt.PenStyle.DashLine)
        painter.setClipRect(area)
        self.draw_markers(painter, area)
        self._draw_cursors(painter, area)
        if self.crosshair.shown_column is not None:
            self.draw_value_mark(painter, self.crosshair.shown_column, area)
        painter.setClipping(False)
        if self.hasFocus():
            painter.setPen(QPen(self.colour(QPalette.ColorRole.Highlight), 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(area.adjusted(1, 1, -1, -1))

    def _draw_pixmap(self, ratio: float) -> QPixmap:
        size, pixmap = self.size() * ratio, self._pixmap
        if pixmap is None or pixmap.size() != size:  # reused memory needs no allocation
            pixmap = QPixmap(size)
        pixmap.setDevicePixelRatio(ratio)
        pixmap.fill(self.colour(QPalette.ColorRole.Window))
        painter = QPainter(pixmap)
        painter.setFont(self.font())
        area = self.plot_area()
        painter.fillRect(area, self.colour(QPalette.ColorRole.Base))
        painter.save()
        painter.setClipRect(area)
        self._sentences = []
        self.draw(painter, area)
        painter.restore()
        painter.setFont(self._find_gutter_font())
        self._draw_name(painter)
        self.draw_gutter(painter, area)
        painter.end()
        return pixmap

    def _find_gutter_font(self) -> QFont:
        """Return the row's font, reduced if its name would touch its levels."""
        font, available_width = QFont(self.font()), self.axis.gutter - GAPS
        for _ in range(_MOST_REDUCTIONS):
            needed = measure_name(self.name, font)
            if needed <= available_width or font.pointSizeF() <= 0.0:
                break
            font.setPointSizeF(font.pointSizeF() * available_width / needed)
        return font

    def _draw_name(self, painter: QPainter) -> None:
        regular = painter.font()
        font = QFont(regular)
        font.setBold(True)
        painter.setFont(font)
        painter.setPen(self.colour(QPalette.ColorRole.WindowText))
        rect = QRectF(4, 3, self.axis.gutter - 8, self.height())
        flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop
        painter.drawText(rect, flags, self.name)
        painter.setFont(regular)

    def _draw_line(
        self, painter: QPainter, column: float, area: QRectF, style: Qt.PenStyle
    ) -> None:
        x = round(self.x_of(column)) + 0.5
        if not area.left() <= x <= area.right():
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        pen = QPen(self.colour(QPalette.ColorRole.Text), 1, style)
        painter.setPen(pen)
        painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)

    def _draw_cursors(self, painter: QPainter, area: QRectF) -> None:
        colour = self.colour(QPalette.ColorRole.Highlight)
        metrics = painter.fontMetrics()
        for name, column in zip(CURSOR_NAMES, self.crosshair.cursors.columns, strict=False):
            x = self.x_of(column)
            painter.setPen(QPen(colour, 2))
            painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()))
            box = QRectF(x, area.top(), metrics.horizontalAdvance(name) + 6, metrics.height())
            painter.fillRect(box, colour)
            painter.setPen(self.colour(QPalette.ColorRole.HighlightedText))
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, name)

    def _find_cursor(self, x: float) -> int | None:
        grip = _GRIP * self.axis.span / self.axis.plot_width(self.width())  # in columns
        return self.crosshair.cursors.find_nearest(self.column_at(x), grip)

    def colour(self, role: QPalette.ColorRole) -> QColor:
        return self.palette().color(role)

    # The mouse and the keys.

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 - Qt's name
        """Zoom at the mouse; with Shift or a sideways wheel, pan."""
        delta = event.angleDelta()
        sideways = delta.x() if delta.x() else delta.y()
        if delta.x() or event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            self.axis.pan(-sideways / _NOTCH * self.axis.span / 10)
        else:
            column = self.column_at(event.position().x())
            self.axis.zoom(_ZOOM_PER_NOTCH ** (delta.y() / _NOTCH), column)
        event.accept()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        if event.button() == Qt.MouseButton.LeftButton:
            self._grabbed_cursor = self._find_cursor(event.position().x())
            self._press_position = self._last_position = event.position()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        position = event.position()
        if self._grabbed_cursor is not None:
            column = self.column_at(position.x())
            self.crosshair.cursors.move(self._grabbed_cursor, column, self.crosshair.columns)
        elif self._last_position is not None:
            self.drag_to(position)
            self._last_position = position
        inside = self.plot_area().contains(position)
        self.crosshair.point_at(self.column_at(position.x()) if inside else None)

    def drag_to(self, position: QPointF) -> None:
        if self._last_position is not None and self.is_drag(position):
            columns = self.column_at(self._last_position.x()) - self.column_at(position.x())
            self.axis.pan(columns)
            self.setCursor(Qt.CursorShape.ClosedHandCursor)

    def is_drag(self, position: QPointF) -> bool:
        return (
            self._press_position is not None
            and (position - self._press_position).manhattanLength() > _CLICK_DISTANCE
        )

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        if event.button() != Qt.MouseButton.LeftButton or self._press_position is None:
            return
        position = event.position()
        is_click = self._grabbed_cursor is None and not self.is_drag(position)
        if is_click and self.plot_area().contains(position):
            self.click(position)
        self._press_position = self._last_position = self._grabbed_cursor = None
        self.unsetCursor()

    def click(self, position: QPointF) -> None:
        self.crosshair.choose(self.column_at(position.x()))

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        if event.button() == Qt.MouseButton.LeftButton:
            self.axis.fit()

    def leaveEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        super().leaveEvent(event)
        self.crosshair.point_at(None)

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 - Qt's name
        """Choose the next column by the arrows, zoom by plus and minus, fit by Home."""
        key = Qt.Key(event.key())
        column = self.crosshair.column
        if key in KEY_STEPS and column is not None:
            self.crosshair.choose(column + KEY_STEPS[key])
            chosen = float(self.crosshair.column or 0)
            self.axis.reveal(chosen, chosen)
        elif key in _ZOOMS:
            fixed = column if column is not None else (self.axis.first + self.axis.last) / 2
            self.axis.zoom(_ZOOMS[key], float(fixed))
        elif key == Qt.Key.Key_Home:
            self.axis.fit()
        else:
            super().keyPressEvent(event)
