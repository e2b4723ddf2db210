"""Card of the highest bit rate above the map: its search, and the way to its result."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout

from occ_gui.widgets.building import (
    ElidedLabel,
    fill,
    name_widget,
    push_button,
)
from occ_model.errors import inflect
from occ_model.results.bit_errors import MostBits
from occ_model.scene.units import HERTZ

_DIGITS = 3


class MostBitsCard(QFrame):
    """A line with the best result, a button to search or cancel, and one to go to the result."""

    search_requested = Signal()
    cancelled = Signal()

    chosen = Signal(object)  # the user goes to the result, a :class:`~occ_model.results.MostBits`

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("card")
        self._best: MostBits | None = None
        self._failures: list[str] = []
        self._is_running = self._is_outdated = False
        self._state = ""
        self.text = name_widget(ElidedLabel(), "Highest bit rate")
        self.search = push_button(
            "Search",
            "Try line codes, frequencies and numbers of bits at the scene's exposure and "
            "distance, with each decoder. This takes some seconds, and a minute for the last "
            "decoder.",
            self.search_requested,
        )
        self.cancel = push_button("Cancel", "Stop the search.", self.cancelled)
        self.go = push_button(
            "Go",
            "Change the scene to this code, frequency and number of bits.",
            lambda: self.chosen.emit(self._best),
            name="Go to the highest bit rate",
        )
        parts = ((self.text, 1), self.search, self.cancel, self.go)
        fill(QHBoxLayout(self), *parts, margins=(12, 4, 8, 4), spacing=8)
        self._show()

    def show_begun(self) -> None:
        self._best, self._failures, self._state = None, [], ""
        self._is_running, self._is_outdated = True, False
        self._show()

    def show_progress(self, decoder: str, pictures: int | None) -> None:
        self._state = f"searching with {decoder}"
        if pictures is not None:
            self._state += f", {inflect(pictures, 'picture')} tried"
        self._show()

    def show_result(self, result: MostBits) -> None:
        if result.scene is None:
            self._failures.append(f"{result.decoder}: {result.failure} {result.faults}".strip())
        elif self._best is None or result.bits_a_second > self._best.bits_a_second:
            self._best = result
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
        self.text.set_full_text(self._append_state(self._describe(best)))

    def _append_state(self, sentence: str) -> str:
        """Append the progress of the search, or the reasons why it has no result."""
        parts = (sentence, self._state, *(self._failures if self._best is None else ()))
        return "; ".join(part for part in parts if part)

    def _describe(self, best: MostBits | None) -> str:
        if best is None or best.scene is None:
            return "Which code, frequency and number of bits give the highest bit rate?"
        transmitter = best.scene.transmitter
        text = (
            f"{best.bits_a_second:,.0f} bits a second: {transmitter.payload_length} bits in each "
            f"picture, line code {transmitter.line_code}, "
            f"{HERTZ.format(transmitter.switching_frequency, _DIGITS)}, "
            f"read by {best.decoder}"
        )
        prefix = (
            "Earlier scene"
            if self._is_outdated
            else "So far"
            if self._state
            else "Highest bit rate"
        )
        return f"{prefix}: {text}"
