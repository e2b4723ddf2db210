"""Row of the code: the chips and bits received, under the columns that they were read from."""

from collections.abc import Sequence
from typing import TypeAlias

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QPainter, QPalette
from PySide6.QtWidgets import QSizePolicy

from occ_gui.simulation.snapshot import ColumnView
from occ_gui.simulation.verdict import describe_received, find_wrong_bits
from occ_gui.story.bit_cells import HEADER, draw_field, have_room_for_bits, have_room_for_marks
from occ_gui.story.column_axis import RIGHT, ColumnAxis, Crosshair, line_height
from occ_gui.story.column_facts import PacketField, received_edges, received_fields
from occ_gui.story.story_row import StoryRow
from occ_gui.widgets.chip_cell import draw_chips
from occ_gui.widgets.colours import SIMULATION
from occ_gui.widgets.state_look import State
from occ_model.arrays import FloatArray
from occ_model.results.decoding import DecodeResult
from occ_model.scene.payload import PayloadPiece, compare_payload, form_of

Span: TypeAlias = tuple[float, float]  # where a bit is drawn: its first and its last x

_CHIP_HEIGHT, _BIT_HEIGHT, _GAP = 20, 22, 3  # pixels, at the usual text size

_MISSING = "·"  # in place of a letter that was not received


class CodeRow(StoryRow):
    """Chips as cells above letters, header and bits, right ones ticked, wrong ones crossed out."""

    def __init__(self, axis: ColumnAxis, crosshair: Crosshair) -> None:
        super().__init__("Code", axis, crosshair)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self._result: DecodeResult | None = None
        self._sent_bits: tuple[int, ...] = ()
        self.edges: FloatArray | None = None
        self.fields: tuple[PacketField, ...] = ()
        self.letters: tuple[PayloadPiece, ...] = ()
        self._form = ""

    def show_reading(self, reading: ColumnView, result: DecodeResult) -> None:
        payload = reading.scene.transmitter.payload if reading.sent else ""
        fields = received_fields(result, reading.scene)
        if not self.redraw_if_changed(
            result.region, result.failure, result.code, result.chips, result.bits,
            result.chip_starts, result.headers, reading.sent, fields, payload,
        ):  # fmt: skip
            return
        self._result, self._sent_bits = result, reading.sent
        self.edges = received_edges(result)
        self.fields = fields
        self.letters = compare_payload(payload, result.bits.tolist()) if result.bits.size else ()
        self._form = form_of(payload)
        self.updateGeometry()
        self.setAccessibleDescription(self._describe())

    def _describe(self) -> str:
        if self._result is None:
            return ""
        bits = self._result.bits.tolist()
        wrong = len(find_wrong_bits(self._sent_bits, bits))
        return describe_received("".join(map(str, self._sent_bits)), "".join(map(str, bits)), wrong)

    def value_of(self, bit: int) -> int | None:
        if self._result is None or bit >= self._result.bits.size:
            return None
        return int(self._result.bits[bit])

    def state_of(self, bit: int) -> State:
        """Compare a received bit with the sent one; neutral if the decoder refused it."""
        if self._result is None or bit >= min(len(self._sent_bits), self._result.bits.size):
            return State.NEUTRAL
        if self._result.failure is not None and not self.fields:
            return State.NEUTRAL  # it may equal the sent bit by chance
        is_right = int(self._result.bits[bit]) == self._sent_bits[bit]
        return State.GOOD if is_right else State.BAD

    def find_chip_and_bit(self, column: float) -> tuple[int | None, int | None]:
        """Return the chip, and the index of the bit, read at a column."""
        edges, result = self.edges, self._result
        if edges is None or result is None or not edges[0] <= column < edges[-1]:
            return None, None
        index = int(edges.searchsorted(column, side="right")) - 1
        bits = (field.bit for field in self.fields if field.first <= index < field.last)
        return int(result.chips[index]), next(bits, None)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(160, self._find_line_bounds()[-1][1] + 2 * _GAP)

    def _find_line_bounds(self) -> tuple[tuple[int, int], tuple[int, int], tuple[int, int]]:
        """Return top and bottom of the chips, of the letters, if any, and of the bits."""
        metrics = self.fontMetrics()
        bit = line_height(metrics, _BIT_HEIGHT, 4)
        chips = _GAP + line_height(metrics, _CHIP_HEIGHT)
        letters = chips + (bit + _GAP if self.letters else 0)
        return (_GAP, chips), (chips + _GAP, letters), (letters + _GAP, letters + _GAP + bit)

    def draw(self, painter: QPainter, area: QRectF) -> None:
        result = self._result
        if result is None:
            return
        chips, letters, bits = (
            QRectF(area.left(), area.top() + top, area.width(), bottom - top)
            for top, bottom in self._find_line_bounds()
        )
        if self.edges is None:
            self._explain_no_chips(painter, chips, result)
            self._draw_letters(painter, letters, self._list_bits(painter, bits, result))
            return
        edges = self.xs_of(self.edges).tolist()
        cells = [
            (chip, QRectF(left + 0.5, chips.top() + 0.5, right - left - 1.0, chips.height() - 1.0))
            for chip, left, right in zip(result.chips.tolist(), edges, edges[1:], strict=False)
            if right > area.left() and left < area.right()
        ]
        draw_chips(painter, cells, SIMULATION, self.palette(), within=area)
        if self.fields:
            spans = self._draw_fields(painter, bits, result, edges)
        else:
            spans = self._list_bits(painter, bits, result)
        self._draw_letters(painter, letters, spans)

    def _draw_letters(self, painter: QPainter, rect: QRectF, spans: Sequence[Span]) -> None:
        for letter in self.letters:
            if letter.last > len(spans):  # its bits were not received
                return
            left, right = spans[letter.first][0], spans[letter.last - 1][1]
            cell = QRectF(left, rect.top(), right - left, rect.height())
            state = self.state_of(letter.first)
            if state is not State.NEUTRAL:
                state = State.GOOD if letter.is_right else State.BAD
            text = letter.received or _MISSING
            draw_field(painter, cell, (text,), self.palette(), state=state, within=rect)

    def _draw_fields(
        self, painter: QPainter, rect: QRectF, result: DecodeResult, edges: list[float]
    ) -> list[Span]:
        """Draw header and bits under their columns; return where the bits are."""
        spans = [(field.bit, edges[field.first], edges[field.last]) for field in self.fields]
        bits = [(bit, left, right) for bit, left, right in spans if bit is not None]
        self._draw_bits(painter, rect, result, bits)
        for bit, left, right in spans:
            if bit is None:
                cell = QRectF(left, rect.top(), right - left, rect.height())
                draw_field(painter, cell, HEADER, self.palette(), is_header=True, within=rect)
        return [(left, right) for _, left, right in bits]

    def _draw_bits(
        self,
        painter: QPainter,
        rect: QRectF,
        result: DecodeResult,
        bits: Sequence[tuple[int, float, float]],
    ) -> None:
        """Draw bits, each from one x to another; a row has all marks and digits or none."""
        metrics, widths = painter.fontMetrics(), [right - left for _, left, right in bits]
        is_marked = have_room_for_marks(metrics, widths)
        has_text = have_room_for_bits(metrics, widths)
        for bit, left, right in bits:
            cell = QRectF(left, rect.top(), right - left, rect.height())
            texts = (str(int(result.bits[bit])),)
            draw_field(painter, cell, texts, self.palette(), state=self.state_of(bit),
                       is_marked=is_marked, has_text=has_text)  # fmt: skip

    def _explain_no_chips(self, painter: QPainter, rect: QRectF, result: DecodeResult) -> None:
        """Write why there are no chips: none were read, or the decoder compares whole packets."""
        text = "No chips were read."
        if result.code is not None:
            text = "This decoder compares whole packets, and reads no single chips."
        self._write_text(painter, rect, text)

    def _write_text(self, painter: QPainter, rect: QRectF, text: str) -> None:
        self.write_sentence(painter, rect.adjusted(8, 0, 0, 0), text)

    def make_list_label(self) -> str:
        """Return the label before bits that have no columns of their own."""
        if self._result is not None and self._result.failure is not None:
            return "not accepted:"
        return "from all packets together:"

    def _list_bits(self, painter: QPainter, rect: QRectF, result: DecodeResult) -> list[Span]:
        """Draw bits that have no columns of their own side by side after a label."""
        if not result.bits.size:
            self._write_text(painter, rect, "No bits were read.")
            return []
        label = self.make_list_label()
        self._write_text(painter, rect, label)
        left = rect.left() + 16 + painter.fontMetrics().horizontalAdvance(label)
        count = max(len(self._sent_bits), result.bits.size)
        width = min(34.0, (rect.right() - left) / count)
        spans = [(left + bit * width, left + (bit + 1) * width) for bit in range(count)]
        bits = [(bit, *spans[bit]) for bit in range(result.bits.size)]
        self._draw_bits(painter, rect, result, bits)
        return spans

    def draw_gutter(self, painter: QPainter, area: QRectF) -> None:
        painter.setPen(self.colour(QPalette.ColorRole.WindowText))
        is_text = bool(self.letters) and self._form == "text"
        letters = "text" if is_text else "bytes"
        names = ("chips", letters if self.letters else "", "bits")
        for text, (top, bottom) in zip(names, self._find_line_bounds(), strict=True):
            painter.drawText(QRectF(0, top, area.left() - 6, bottom - top), RIGHT, text)
