"""Sent above received bits and text, with errors marked by shape and colour."""

from collections.abc import Iterable, Sequence
from html import escape

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPalette, QPen
from PySide6.QtWidgets import QLabel, QSizePolicy

from occ_gui.simulation.verdict import describe_received, find_wrong_bits
from occ_gui.widgets.guarded_paint import PaintedWidget
from occ_model import colours
from occ_model.scene.payload import PayloadPiece, compare_payload

_CELL_SIZE = 24
_GAP = 3
_LABEL_WIDTH = 66

_LEAST_CELL_WIDTH = 9.0  # pixels of a cell below which a digit does not fit
_BAR_WIDTH = 3  # pixels of a bar and the gap beside it
_MARK_OVERHANG = 2  # pixels by which a bar with a wrong bit exceeds its row at either end
_MOST_DIGITS = 64  # most bits that the tool tip writes out
_FADED_OPACITY = 0.35  # opacity of bits of an earlier scene

_RIGHT = QColor(colours.RIGHT)
_WRONG = QColor(colours.WRONG)


class BitStrip(PaintedWidget):
    """Two rows of cells, the sent bits over the received ones.

    A one is a filled square, a zero an outline; a wrong bit is orange and crossed out; a bit that
    was not received is a dashed outline. Where there is no room for digits, each bar stands for one
    or more bits: it is as high as their fraction of ones, but higher than the row and orange where
    one of them is wrong.
    """

    def __init__(self) -> None:
        super().__init__()
        self.sent: tuple[int, ...] = ()
        self._received: tuple[int, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName("Sent and received bits")

    def show_bits(self, sent: Sequence[int], received: Sequence[int]) -> None:
        """Show bits in the order sent; bits that were not received are missing at the end."""
        bits = tuple(map(int, sent)), tuple(map(int, received))[: len(sent)]
        if bits == (self.sent, self._received):
            return
        self.sent, self._received = bits
        self._describe()
        self.update()

    def show_outdated(self, outdated: bool) -> None:
        self.setEnabled(not outdated)
        self._describe()

    def _describe(self) -> None:
        wrong = self.find_wrong_bits()
        if len(self.sent) > _MOST_DIGITS:
            text = f"sent {len(self.sent)} bits, received {len(self._received)}, {len(wrong)} wrong"
        else:
            sent, received = ("".join(map(str, bits)) for bits in (self.sent, self._received))
            text = describe_received(sent, received, len(wrong))
        if not self.isEnabled():
            text = f"earlier scene: {text}"
        self.setAccessibleDescription(text)
        self.setToolTip(text)

    def find_wrong_bits(self) -> list[int]:
        return find_wrong_bits(self.sent, self._received)

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        return QSize(_LABEL_WIDTH + 10 * (_CELL_SIZE + _GAP), 2 * _CELL_SIZE + 3 * _GAP)

    def minimumSizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Allow narrower cells, in rows of full height."""
        return QSize(_LABEL_WIDTH + 10 * 12, self.sizeHint().height())

    def paint_with(self, painter: QPainter) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if not self.isEnabled():  # the bits are of an earlier scene
            painter.setOpacity(_FADED_OPACITY)
        rows = (("sent", self.sent), ("received", self._received))
        count = max(1, len(self.sent))
        width = min(float(_CELL_SIZE), (self.width() - _LABEL_WIDTH) / count - _GAP)
        wrong = set(self.find_wrong_bits())
        for row, (label, bits) in enumerate(rows):
            top = _GAP + row * (_CELL_SIZE + _GAP)
            painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
            painter.drawText(
                QRectF(0, top, _LABEL_WIDTH, _CELL_SIZE), Qt.AlignmentFlag.AlignVCenter, label
            )
            if width < _LEAST_CELL_WIDTH:
                self._draw_bars(painter, top, bits, wrong if row == 1 else set())
                continue
            for place in range(len(self.sent)):
                cell = QRectF(_LABEL_WIDTH + place * (width + _GAP), top, width, _CELL_SIZE)
                if place >= len(bits):
                    self._draw_missing(painter, cell)
                else:
                    self._draw_bit(painter, cell, bits[place], row == 1 and place in wrong)

    def _draw_bars(
        self, painter: QPainter, top: float, bits: Sequence[int], wrong: set[int]
    ) -> None:
        span = self.width() - _LABEL_WIDTH - _GAP
        count = len(self.sent)
        bars = max(1, min(count, span // _BAR_WIDTH))
        for bar in range(bars):
            first, last = bar * count // bars, (bar + 1) * count // bars
            cell = QRectF(_LABEL_WIDTH + bar * span / bars, top, span / bars - 1.0, _CELL_SIZE)
            bits_in_bar = bits[first:last]
            if not bits_in_bar:
                painter.fillRect(cell.adjusted(0, _CELL_SIZE - 1, 0, 0), self.palette().mid())
            elif wrong.isdisjoint(range(first, last)):
                height = max(1.0, _CELL_SIZE * sum(bits_in_bar) / len(bits_in_bar))
                painter.fillRect(cell.adjusted(0, _CELL_SIZE - height, 0, 0), _RIGHT)
            else:
                painter.fillRect(cell.adjusted(0, -_MARK_OVERHANG, 0, _MARK_OVERHANG), _WRONG)

    def _draw_missing(self, painter: QPainter, cell: QRectF) -> None:
        painter.setPen(QPen(self.palette().color(QPalette.ColorRole.Mid), 1, Qt.PenStyle.DashLine))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(cell.adjusted(1, 1, -1, -1))

    def _draw_bit(self, painter: QPainter, cell: QRectF, bit: int, wrong: bool) -> None:
        colour = _WRONG if wrong else _RIGHT
        inner = cell.adjusted(1, 1, -1, -1)
        painter.setPen(QPen(colour, 2))
        painter.setBrush(colour if bit else Qt.BrushStyle.NoBrush)
        painter.drawRect(inner)
        text = QColor("white") if bit else self.palette().color(QPalette.ColorRole.WindowText)
        if wrong:
            painter.setPen(QPen(text, 1.5))
            for corner, opposite in (
                (inner.topLeft(), inner.bottomRight()),
                (inner.topRight(), inner.bottomLeft()),
            ):
                painter.drawLine(QPointF(corner), QPointF(opposite))
        painter.setPen(text)
        painter.drawText(cell, Qt.AlignmentFlag.AlignCenter, str(bit))


_MOST_LETTERS = 120  # most letters shown as text; the strip shows all bits
_MISSING = "·"  # in place of a letter that was not received


class PayloadText(QLabel):
    """Two lines: the payload sent, and what was received of it."""

    def __init__(self) -> None:
        super().__init__()
        self.setWordWrap(True)
        self.setTextFormat(Qt.TextFormat.RichText)
        self.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.setAccessibleName("Sent and received payload")

    def show_payload(self, payload: str, received: Sequence[int]) -> None:
        pieces = compare_payload(payload, received)
        self.setVisible(bool(pieces))
        if not pieces:
            return
        sent = _shorten("".join(piece.sent for piece in pieces))
        wrong = sum(not piece.is_right for piece in pieces)
        self.setText(f"sent <b>{escape(sent)}</b><br>received <b>{_mark_errors(pieces)}</b>")
        received_text = _shorten("".join(piece.received or _MISSING for piece in pieces))
        self.setAccessibleDescription(describe_received(sent, received_text, wrong))


def _shorten(text: str) -> str:
    return text if len(text) <= _MOST_LETTERS else f"{text[: _MOST_LETTERS - 1]}…"


def _mark_errors(pieces: Iterable[PayloadPiece]) -> str:
    """Write the received payload, with wrong letters crossed out and coloured."""
    markup, letters = "", 0
    for piece in pieces:
        letters += len(piece.sent)
        if letters > _MOST_LETTERS:
            return f"{markup}…"
        text = escape(piece.received or _MISSING)
        markup += text if piece.is_right else f'<s style="color:{colours.WRONG}">{text}</s>'
    return markup
