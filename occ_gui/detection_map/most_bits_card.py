"""Card of the search for the code, frequency and number of bits that carry most."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout

from occ_gui.widgets.elided_label import ElidedLabel
from occ_gui.widgets.layouts import filled
from occ_gui.widgets.named import named, push_button
from occ_model.results.bit_errors import MostBits
from occ_model.scene.units import HERTZ

_DIGITS = 3


class MostBitsCard(QFrame):
    """One line: the best that was found, a button to search or cancel, and one to go there."""

    asked = Signal()
    cancelled = Signal()

    chosen = Signal(object)
    """The user goes to what was found, a :class:`~occ_model.results.MostBits`."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("card")
        self._best: MostBits | None = None
        self._failures: list[str] = []
        self._is_running = self._is_outdated = False
        self._state = ""
        self.text = named(ElidedLabel(), "What carries most bits a second")
        self.search = push_button(
            "Search",
            "Try line codes, frequencies and numbers of bits at the scene's exposure and "
            "distance, with each decoder: some seconds, a minute for the last decoder.",
            self.asked,
        )
        self.cancel = push_button("Cancel", "Stop the search.", self.cancelled)
        self.go = push_button(
            "Go",
            "Send this code, frequency and number of bits, and read it.",
            lambda: self.chosen.emit(self._best),
            name="Go to what carries most",
        )
        parts = ((self.text, 1), self.search, self.cancel, self.go)
        filled(QHBoxLayout(self), *parts, margins=(12, 4, 8, 4), spacing=8)
        self._show()

    def show_begun(self) -> None:
        self._best, self._failures, self._state = None, [], ""
        self._is_running, self._is_outdated = True, False
        self._show()

    def show_tried(self, decoder: str, pictures: int) -> None:
        self._state = f"searching with {decoder}, {pictures} pictures tried"
        self._show()

    def show_found(self, found: MostBits) -> None:
        if found.scene is None:
            self._failures.append(f"{found.decoder}: {found.failure}")
        elif self._best is None or found.bits_a_second > self._best.bits_a_second:
            self._best = found
        self._show()

    def show_ended(self, sentence: str) -> None:
        self._is_running, self._state = False, sentence
        self._show()

    def show_outdated(self, outdated: bool) -> None:
        self._is_outdated = outdated
        self._show()

    def _show(self) -> None:
        best = self._best
        self.search.setVisible(not self._is_running and (best is None or self._is_outdated))
        self.cancel.setVisible(self._is_running)
        self.go.setVisible(best is not None)
        self.go.setEnabled(not self._is_outdated)
        self.text.setEnabled(not self._is_outdated)
        self.text.set_full_text(self._with_state(self._sentence(best)))

    def _with_state(self, sentence: str) -> str:
        """Add to a sentence how far the search is, or why it has no result."""
        parts = (sentence, self._state, *(self._failures if self._best is None else ()))
        return "; ".join(part for part in parts if part)

    def _sentence(self, best: MostBits | None) -> str:
        if best is None or best.scene is None:
            return "Which code, frequency and bits carry most?"
        sent = best.scene.transmitter
        text = (
            f"{best.bits_a_second:,.0f} bits a second, {sent.payload_length} a picture in "
            f"{sent.line_code} at {HERTZ.format(sent.switching_frequency, _DIGITS)}, "
            f"read by {best.decoder}"
        )
        when = "Earlier scene" if self._is_outdated else "So far" if self._state else "Most"
        return f"{when}: {text}"
