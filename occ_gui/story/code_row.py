"""Row of the code: the chips and bits received, under the columns that they were read from."""

from collections.abc import Sequence

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPalette
from PySide6.QtWidgets import QSizePolicy, QWidget

from occ_gui.decoding.verdict import wrong_places
from occ_gui.simulation.snapshot import Reading
from occ_gui.story.bit_cells import (
    draw_field,
    have_room_for_bits,
    have_room_for_marks,
    header_texts,
)
from occ_gui.story.column_axis import ColumnAxis, Crosshair
from occ_gui.story.column_facts import PacketField, received_edges, received_fields
from occ_gui.story.story_row import StoryRow
from occ_gui.story.text_room import line_height
from occ_gui.widgets.chip_cell import draw_chips
from occ_gui.widgets.plot import SIMULATION
from occ_gui.widgets.state_look import State
from occ_gui.widgets.unchanged import are_same
from occ_model.arrays import FloatArray
from occ_model.results import DecodeResult

_CHIPS, _BITS = 20, 22
_GAP = 3
"""Pixels of the cells, and between them, in text of the usual size."""


class CodeRow(StoryRow):
    """Chips as cells, and under them header and bits, the right ones ticked, the wrong crossed."""

    def __init__(
        self, axis: ColumnAxis, crosshair: Crosshair, parent: QWidget | None = None
    ) -> None:
        super().__init__(self.tr("Code"), axis, crosshair, parent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self._decoded: DecodeResult | None = None
        self._sent: tuple[int, ...] = ()
        self._drawn_from: tuple[object, ...] = ()
        self.edges: FloatArray | None = None
        self.fields: tuple[PacketField, ...] = ()

    def show_reading(self, reading: Reading, decoded: DecodeResult) -> None:
        """Show the chips and bits of one decoder's result."""
        looks = (*_looks(decoded), reading.sent, received_fields(decoded, reading.scene))
        if are_same(looks, self._drawn_from):
            return
        self._drawn_from = looks
        self._decoded, self._sent = decoded, reading.sent
        self.edges = received_edges(decoded)
        self.fields = received_fields(decoded, reading.scene)
        self.setAccessibleDescription(self._in_words())
        self.redraw()

    def _in_words(self) -> str:
        if self._decoded is None:
            return ""
        bits = self._decoded.bits.tolist()
        return self.tr("sent {sent}, received {received}, {wrong} wrong").format(
            sent="".join(map(str, self._sent)) or self.tr("no code"),
            received="".join(map(str, bits)) or self.tr("nothing"),
            wrong=len(wrong_places(self._sent, bits)),
        )

    def value_of(self, bit: int) -> int | None:
        """Return a bit that was received, None if it was not."""
        if self._decoded is None or bit >= self._decoded.bits.size:
            return None
        return int(self._decoded.bits[bit])

    def state_of(self, bit: int) -> State:
        """Return whether a bit that was received is the one sent; neutral if it was refused."""
        if self._decoded is None or bit >= min(len(self._sent), self._decoded.bits.size):
            return State.NEUTRAL
        if self._decoded.failure is not None and not self.fields:
            return State.NEUTRAL  # that a bit is the one sent says nothing: it may be by chance
        right = int(self._decoded.bits[bit]) == self._sent[bit]
        return State.GOOD if right else State.BAD

    def received_at(self, column: float) -> tuple[int | None, int | None]:
        """Return the chip, and the number of the bit, that were read at a column."""
        edges, decoded = self.edges, self._decoded
        if edges is None or decoded is None or not edges[0] <= column < edges[-1]:
            return None, None
        place = int(edges.searchsorted(column, side="right")) - 1
        bits = (f.bit for f in self.fields if f.first <= place < f.last)
        return int(decoded.chips[place]), next(bits, None)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the height of both lines."""
        return QSize(200, sum(self._heights()) + 4 * _GAP)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the height of both lines."""
        return QSize(160, sum(self._heights()) + 4 * _GAP)

    def _heights(self) -> tuple[int, int]:
        """Return the heights of the chips and of the bits."""
        metrics = self.fontMetrics()
        return line_height(metrics, _CHIPS), line_height(metrics, _BITS, 4)

    def draw(self, painter: QPainter, area: QRectF) -> None:
        """Draw the chips in view, and the packet that was read."""
        decoded = self._decoded
        if decoded is None:
            return
        of_chips, of_bits = self._heights()
        chips = QRectF(area.left(), area.top() + _GAP, area.width(), of_chips)
        bits = QRectF(area.left(), chips.bottom() + _GAP, area.width(), of_bits)
        if self.edges is None:
            self._say_instead(painter, chips, decoded)
            self._list_bits(painter, bits, decoded)
            return
        edges = self.xs_of(self.edges).tolist()
        cells = [
            (chip, QRectF(left + 0.5, chips.top() + 0.5, right - left - 1.0, chips.height() - 1.0))
            for chip, left, right in zip(decoded.chips.tolist(), edges, edges[1:], strict=False)
            if right > area.left() and left < area.right()
        ]
        draw_chips(painter, cells, SIMULATION, self.palette(), within=area)
        if self.fields:
            self._draw_fields(painter, bits, decoded, edges)
        else:
            self._list_bits(painter, bits, decoded)

    def _draw_fields(
        self, painter: QPainter, place: QRectF, decoded: DecodeResult, edges: list[float]
    ) -> None:
        """Draw header and bits under the columns that carry them."""
        spans = [(field.bit, edges[field.first], edges[field.last]) for field in self.fields]
        widths = [right - left for bit, left, right in spans if bit is not None]
        is_marked, is_told = _have_room(painter, widths)
        for bit, left, right in spans:
            cell = QRectF(left, place.top(), right - left, place.height())
            if bit is None:
                draw_field(
                    painter, cell, header_texts(), self.palette(), is_header=True, within=place
                )
            else:
                texts = (str(int(decoded.bits[bit])),)
                draw_field(painter, cell, texts, self.palette(), state=self.state_of(bit),
                           is_marked=is_marked, is_told=is_told)  # fmt: skip

    def _say_instead(self, painter: QPainter, place: QRectF, decoded: DecodeResult) -> None:
        """Say why there are no chips: none were read, or the decoder reads whole packets."""
        text = self.tr("No chips were read.")
        if decoded.code is not None:
            text = self.tr("This decoder compares whole packets, and reads no single chips.")
        self._write(painter, place, text)

    def _write(self, painter: QPainter, place: QRectF, text: str) -> None:
        painter.setPen(self.colour(QPalette.ColorRole.Text))
        inner = place.adjusted(8, 0, 0, 0)
        painter.drawText(inner, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, text)

    def list_label(self) -> str:
        """Return what is said before bits that are not under the columns that carry them."""
        if self._decoded is not None and self._decoded.failure is not None:
            return self.tr("not accepted:")
        return self.tr("from all packets together:")

    def _list_bits(self, painter: QPainter, place: QRectF, decoded: DecodeResult) -> None:
        """Draw bits that have no columns of their own side by side, and say so before them."""
        if not decoded.bits.size:
            self._write(painter, place, self.tr("No bits were read."))
            return
        label = self.list_label()
        self._write(painter, place, label)
        left = place.left() + 16 + painter.fontMetrics().horizontalAdvance(label)
        count = max(len(self._sent), decoded.bits.size)
        width = min(34.0, (place.right() - left) / count)
        is_marked, is_told = _have_room(painter, [width])
        for bit, value in enumerate(decoded.bits.tolist()):
            cell = QRectF(left + bit * width, place.top(), width, place.height())
            draw_field(painter, cell, (str(value),), self.palette(), state=self.state_of(bit),
                       is_marked=is_marked, is_told=is_told)  # fmt: skip

    def draw_beside(self, painter: QPainter, area: QRectF) -> None:
        """Name the lines."""
        painter.setPen(self.colour(QPalette.ColorRole.WindowText))
        flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        chips, bits = self._heights()
        for text, top, height in (
            (self.tr("chips"), _GAP, chips),
            (self.tr("bits"), chips + 2 * _GAP, bits),
        ):
            painter.drawText(QRectF(0, top, area.left() - 6, height), flags, text)


def _looks(decoded: DecodeResult) -> tuple[object, ...]:
    """Return what of a result is drawn here."""
    return (
        decoded.region, decoded.failure, decoded.code, decoded.chips, decoded.bits,
        decoded.chip_starts, decoded.headers,
    )  # fmt: skip


def _have_room(painter: QPainter, widths: Sequence[float]) -> tuple[bool, bool]:
    """Return whether the bits of a row have room for marks, and for their digits."""
    metrics = painter.fontMetrics()
    return have_room_for_marks(metrics, widths), have_room_for_bits(metrics, widths)
