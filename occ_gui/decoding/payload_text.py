"""A payload as text or hex digits: sent, and received with the wrong letters crossed out."""

from collections.abc import Iterable, Sequence
from html import escape

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from occ_gui.simulation.verdict import received_in_words
from occ_model import colours
from occ_model.scene.payload import Piece, compared

_MAX_SHOWN_LETTERS = 120  # letters that are shown; the bits of the others are in the strip of bits
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
        pieces = compared(payload, received)
        self.setVisible(bool(pieces))
        if not pieces:
            return
        sent = _shortened("".join(piece.sent for piece in pieces))
        wrong = sum(not piece.is_right for piece in pieces)
        self.setText(f"sent <b>{escape(sent)}</b><br>received <b>{_marked(pieces)}</b>")
        read = _shortened("".join(piece.received or _MISSING for piece in pieces))
        self.setAccessibleDescription(received_in_words(sent, read, wrong))


def _shortened(text: str) -> str:
    return text if len(text) <= _MAX_SHOWN_LETTERS else f"{text[: _MAX_SHOWN_LETTERS - 1]}…"


def _marked(pieces: Iterable[Piece]) -> str:
    """Write what was received, with wrong letters crossed out in the colour of what is wrong."""
    marked, letters = "", 0
    for piece in pieces:
        letters += len(piece.sent)
        if letters > _MAX_SHOWN_LETTERS:
            return f"{marked}…"
        text = escape(piece.received or _MISSING)
        marked += text if piece.is_right else f'<s style="color:{colours.WRONG}">{text}</s>'
    return marked
