"""Row of the light: the LED's waveform, and the exposure of the chosen column as a window on it."""

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QMouseEvent, QPainter, QPalette, QPen, QPolygonF

from occ_gui.simulation.snapshot import ColumnView
from occ_gui.story.bit_cells import HEADER, draw_field, have_room_for_bits
from occ_gui.story.column_axis import LEFT, RIGHT, ColumnAxis, Crosshair, line_height
from occ_gui.story.column_facts import PacketField, light_over_columns, packet_fields
from occ_gui.story.curve_lines import make_lines
from occ_gui.story.story_row import StoryRow
from occ_gui.widgets.chip_cell import draw_digits, have_room_for_digits
from occ_gui.widgets.state_look import is_dark
from occ_model.errors import inflect, one_line
from occ_model.results.teaching import LightCurve
from occ_model.scene.light_words import blinking_lamp, describe_light, has_chips
from occ_model.scene.payload import PayloadPiece, compare_payload
from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND

_GLOW = {False: QColor("#ffd95e"), True: QColor("#7d6208")}

_LEAST_HEIGHT = 40
_STRIP_HEIGHT, _LABEL_HEIGHT = 18, 15
"""Pixels of the strip of the bits sent, and of the window's label, at the usual text size."""

_LEAST_FOR_STRIP = 66  # pixels of height from which the strip is drawn
_LEAST_CHIP = 1.5  # fewest pixels of a chip that is drawn

_LEAST_FOR_DIGIT = 9  # pixels of width from which a bit is drawn

_MOST_LETTERS = 60  # letters of a payload in its description
_GRIP = 6  # pixels beside the window in which the mouse still grabs it


class LightRow(StoryRow):
    """Light against time; column ``i`` stands at the time at which its exposure begins.

    The window, as wide as the exposure is long, can be dragged to another column.
    """

    def __init__(self, axis: ColumnAxis, crosshair: Crosshair) -> None:
        super().__init__("Light", axis, crosshair)
        self.setMinimumHeight(_LEAST_HEIGHT)
        self.setToolTip(
            "The LED's light over time. The window is the exposure of the chosen column: drag "
            "it, click, or use the arrow keys."
        )
        self._scene: Scene | None = None
        self._has_edges = self._has_chips = False
        self._top = 1.0  # the brightest light, 1 being the panel fully lit
        self._sent_bits: tuple[int, ...] = ()
        self.letters: tuple[PayloadPiece, ...] = ()
        self._grab_offset: float | None = None

    def show_reading(self, reading: ColumnView) -> None:
        if reading.scene != self._scene:
            self.update()  # the exposure window may have changed
        self._scene, self._sent_bits = reading.scene, reading.sent
        self.letters = compare_payload(reading.scene.transmitter.payload, self._sent_bits)
        self._has_edges = reading.has_edges
        sent = reading.scene.transmitter
        self._has_chips = has_chips(sent)
        self._top = 1.0 + (sent.mains_depth if sent.light == "mains" else 0.0)
        # A new exposure time changes only the window.
        self.redraw_if_changed(
            self._scene.transmitter, self._scene.camera.readout_time,
            self._scene.model.start_time, self._has_edges, self._sent_bits,
        )  # fmt: skip

    def find_light(self, first: float, last: float, most: int) -> LightCurve | None:
        """Return the light between two columns; None for more chips than ``most``."""
        if self._scene is None:
            return None
        return light_over_columns(self._scene, first, last, most, self._has_edges)

    def exposure_window(self) -> tuple[float, float] | None:
        """Return the columns at which the chosen column's exposure begins and ends."""
        column, scene = self.crosshair.column, self._scene
        if column is None or scene is None:
            return None
        return float(column), column + scene.camera.exposure_time / scene.camera.readout_time

    def _find_light_area(self, area: QRectF) -> QRectF:
        strip = self._find_strip_height() if area.height() >= _LEAST_FOR_STRIP else 0
        return area.adjusted(0, self._find_label_height() + 1, 0, -strip - 5)

    def _find_strip_height(self) -> int:
        """Return the height of the strip of the bits sent, and of the letters above them."""
        return line_height(self.fontMetrics(), _STRIP_HEIGHT) * (2 if self.letters else 1)

    def _find_label_height(self) -> int:
        return line_height(self.fontMetrics(), _LABEL_HEIGHT, 0)

    def draw(self, painter: QPainter, area: QRectF) -> None:
        if self._scene is None:
            return
        light = self._find_light_area(area)
        most = round(area.width() / _LEAST_CHIP)
        curve = self.find_light(self.axis.first, self.axis.last, most)
        if curve is None:
            self._write_too_fast(painter, light)
            return
        edges = self.xs_of(curve.edges).tolist()
        cells = [
            (level, QRectF(left, light.top(), right - left, light.height()))
            for level, left, right in zip(curve.levels.tolist(), edges, edges[1:], strict=False)
        ]
        self._draw_glow(painter, light, curve, cells)
        xs = self.xs_of(curve.columns)
        ys = light.bottom() - curve.light * (light.height() / self._top)
        painter.setPen(QPen(self.colour(QPalette.ColorRole.Text), 1.5))
        # Upright and level lines are sharper without antialiasing.
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, self._has_edges)
        painter.drawLines(make_lines(xs, ys))
        if self._has_chips and have_room_for_digits(cells):
            draw_digits(painter, cells, light)
        if light.bottom() < area.bottom() - self._find_strip_height():
            self._draw_fields(painter, area, curve)

    def _draw_glow(
        self,
        painter: QPainter,
        light: QRectF,
        curve: LightCurve,
        cells: Sequence[tuple[float, QRectF]],
    ) -> None:
        """Fill the area below the light: a rectangle for each level, or one polygon with edges."""
        glow = _GLOW[is_dark(self.palette())]
        if not self._has_edges:
            for level, cell in cells:
                if level:
                    painter.fillRect(self._fill_up(cell, level), glow)
            return
        xs = self.xs_of(curve.columns).tolist()
        ys = (light.bottom() - curve.light * (light.height() / self._top)).tolist()
        polygon = list(map(QPointF, xs, ys))
        polygon += [QPointF(xs[-1], light.bottom()), QPointF(xs[0], light.bottom())]
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(glow)
        painter.drawPolygon(QPolygonF(polygon))

    def _fill_up(self, cell: QRectF, level: float) -> QRectF:
        """Return the part of a piece's cell that is below its light."""
        return cell.adjusted(0, (1.0 - level / self._top) * cell.height(), 0, 0)

    def _write_too_fast(self, painter: QPainter, light: QRectF) -> None:
        painter.fillRect(light, _GLOW[is_dark(self.palette())])
        text = "The LED switches faster than this view can show: zoom in."
        self.write_sentence(painter, light, text, Qt.AlignmentFlag.AlignCenter)

    def _draw_fields(self, painter: QPainter, area: QRectF, curve: LightCurve) -> None:
        """Draw header and bits of each packet in view under their chips."""
        if self._scene is None:
            return
        fields = packet_fields(self._scene)
        edges = self.xs_of(curve.edges)
        step = float(edges[1] - edges[0])
        chips_per_bit = fields[-1].last - fields[-1].first if fields else 0
        if chips_per_bit * step < _LEAST_FOR_DIGIT:
            self._write_sent(painter, area)
            return
        length = fields[-1].last
        # The x of each packet's first chip, from the packet that the left edge cuts.
        start = float(edges[0]) - int(curve.places[0]) * step
        while start < area.right():
            self._draw_packet(painter, area, fields, start, step)
            start += length * step

    def _draw_packet(
        self,
        painter: QPainter,
        area: QRectF,
        fields: Sequence[PacketField],
        start: float,
        step: float,
    ) -> None:
        header, *bits = fields
        strip_line = self._find_strip_height() / (2 if self.letters else 1)
        bits_top = area.bottom() - strip_line + 1
        width = (bits[0].last - bits[0].first) * step
        has_text = have_room_for_bits(painter.fontMetrics(), [width]) or None
        cells = [
            (HEADER, header, header, bits_top),
            *(
                ((str(self._sent_bits[bit]),), field, field, bits_top)
                for bit, field in enumerate(bits)
            ),
            *(
                ((piece.sent,), bits[piece.first], bits[piece.last - 1], bits_top - strip_line)
                for piece in self.letters
            ),
        ]
        for texts, first, last, top in cells:
            cell = QRectF(
                start + first.first * step, top, (last.last - first.first) * step, strip_line - 2
            )
            if cell.right() >= area.left() and cell.left() <= area.right():
                draw_field(painter, cell, texts, self.palette(), is_header=first is header,
                           has_text=has_text if top == bits_top else None, within=area)  # fmt: skip

    def _write_sent(self, painter: QPainter, area: QRectF) -> None:
        rect = area.adjusted(8, area.height() - self._find_strip_height(), 0, 0)
        self.write_sentence(painter, rect, self.describe_sent())

    def describe_sent(self) -> str:
        if self._scene is None:
            return ""
        sent = self._scene.transmitter
        if sent.light != "code" or sent.pattern:
            return describe_light(sent)
        subject = f"code {sent.code}"
        if sent.payload:
            subject = f"“{one_line(sent.payload.partition(':')[2], _MOST_LETTERS)}”"
        return f"{subject}, {inflect(len(self._sent_bits), 'bit')}"

    def draw_gutter(self, painter: QPainter, area: QRectF) -> None:
        if self._scene is None:
            return
        light = self._find_light_area(area)
        painter.setPen(self.colour(QPalette.ColorRole.WindowText))
        is_switched = self._has_chips or blinking_lamp(self._scene.transmitter) is not None
        ends = ("on", "off") if is_switched else (f"{100.0 * self._top:.0f} %", "0 %")
        for text, y in zip(ends, (light.top(), light.bottom()), strict=True):
            painter.drawText(QRectF(0, y - 8, area.left() - 6, 16), RIGHT, text)
        strip = self._find_strip_height()
        if light.bottom() < area.bottom() - strip:
            rect = QRectF(4, area.bottom() - strip, area.left() - 10, strip)
            painter.drawText(rect, LEFT, "sent")

    def draw_markers(self, painter: QPainter, area: QRectF) -> None:
        """Draw the window: shaded, hatched where the LED is on, with its length above."""
        window, scene = self.exposure_window(), self._scene
        if window is None or scene is None:
            return
        light = self._find_light_area(area)
        left, right = (self.x_of(column) for column in window)
        accent = self.colour(QPalette.ColorRole.Highlight)
        shade = QColor(accent)
        shade.setAlpha(70)
        rect = QRectF(left, area.top() + 1, max(right - left, 1.5), light.bottom() - area.top())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(rect, shade)
        self._hatch(painter, light, window)
        painter.setPen(QPen(accent, 2))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(rect)
        self._label_window(painter, rect, SECOND.format(scene.camera.exposure_time, 4))

    def _hatch(self, painter: QPainter, light: QRectF, window: tuple[float, float]) -> None:
        most = round(light.width() / _LEAST_CHIP)
        first = max(window[0], self.axis.first)
        last = min(window[1], self.axis.last)
        curve = self.find_light(first, last, most) if first < last else None
        if curve is None:
            return
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(
            QBrush(self.colour(QPalette.ColorRole.Highlight), Qt.BrushStyle.BDiagPattern)
        )
        for level, start, end in zip(
            curve.levels.tolist(), curve.edges.tolist(), curve.edges.tolist()[1:], strict=False
        ):
            left, right = self.x_of(max(start, first)), self.x_of(min(end, last))
            if level:
                cell = QRectF(left, light.top(), right - left, light.height())
                painter.drawRect(self._fill_up(cell, level))

    def _label_window(self, painter: QPainter, rect: QRectF, text: str) -> None:
        width = painter.fontMetrics().horizontalAdvance(text) + 8
        area = self.plot_area()
        label = QRectF(rect.center().x() - width / 2, area.top(), width, self._find_label_height())
        label.moveLeft(min(max(label.left(), area.left()), area.right() - width))
        if not area.left() - width < rect.center().x() < area.right() + width:
            return
        painter.fillRect(label, self.colour(QPalette.ColorRole.Highlight))
        painter.setPen(self.colour(QPalette.ColorRole.HighlightedText))
        painter.drawText(label, Qt.AlignmentFlag.AlignCenter, text)

    # Dragging the window.

    def _is_on_window(self, position: QPointF) -> bool:
        window = self.exposure_window()
        if window is None or not self.plot_area().contains(position):
            return False
        left, right = (self.x_of(column) for column in window)
        return left - _GRIP <= position.x() <= right + _GRIP

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        super().mousePressEvent(event)
        position, column = event.position(), self.crosshair.column
        if event.button() == Qt.MouseButton.LeftButton and self._is_on_window(position):
            self._grab_offset = None if column is None else self.column_at(position.x()) - column

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        super().mouseMoveEvent(event)
        if event.buttons() == Qt.MouseButton.NoButton:
            if self._is_on_window(event.position()):
                self.setCursor(Qt.CursorShape.SizeHorCursor)
            else:
                self.unsetCursor()

    def drag_to(self, position: QPointF) -> None:
        """Move the window to another column; pan if it was not grabbed."""
        if self._grab_offset is None:
            super().drag_to(position)
        elif self.is_drag(position):
            self.crosshair.choose(self.column_at(position.x()) - self._grab_offset)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        super().mouseReleaseEvent(event)
        self._grab_offset = None

    def click(self, position: QPointF) -> None:
        if self._grab_offset is None:
            super().click(position)
