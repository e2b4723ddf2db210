"""Cards above the map: the frequencies that each decoder reads, and the most bits a second."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, QTimer, Signal
from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QFrame, QGridLayout, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from occ_gui.detection_map.advice_sentences import make_answer, make_frequency_line
from occ_gui.widgets.answer import Answer
from occ_gui.widgets.building import (
    ElidedLabel,
    fill,
    heading_font,
    paragraph,
    push_button,
)
from occ_gui.widgets.event_filters import call_at
from occ_model.errors import inflect
from occ_model.results.limit_text import format_end, others_text, value_text
from occ_model.results.limits import Advice, RangeEnd, WorkingRange

_PARAMETER = "switching_frequency"

_IN_ANSWER = 2  # decoders in the sentence above the cards: those that the map shows

REST_MS = 800  # milliseconds without a change before the limits of a scene are searched for


class LimitCards(QWidget):
    """A card for each decoder; visible cards request the limits of each new scene."""

    search_requested = Signal()  # the limits of the present scene are needed

    destination_chosen = Signal(str, float, str)
    """The user goes to a limit: a parameter, its value in SI units, and the decoder."""

    def __init__(self, decoders: Sequence[str]) -> None:
        super().__init__()
        self.cards = {name: LimitCard(name) for name in decoders}
        self._found: dict[str, Advice] = {}
        self._reason = ""
        self.answer = Answer()
        self.head = fill(QHBoxLayout(), (self.answer, 1))
        row = fill(QHBoxLayout(), spacing=8)
        fill(QVBoxLayout(self), self.head, row, margins=(0, 4, 0, 4), spacing=4)
        for card in self.cards.values():
            row.addWidget(card, 1)
            card.chosen.connect(self.destination_chosen)
        self._is_complete = self._is_running = self._is_outdated = False
        self.rest_timer = QTimer(self, singleShot=True)
        self.rest_timer.setInterval(REST_MS)
        self.rest_timer.timeout.connect(self.search_requested)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 - Qt's name
        super().showEvent(event)
        self._schedule_search()

    def hideEvent(self, event: QHideEvent) -> None:  # noqa: N802 - Qt's name
        super().hideEvent(event)
        self.rest_timer.stop()

    @property
    def is_up_to_date(self) -> bool:
        """Whether the limits of the present scene have been found."""
        return self._is_complete and not self._is_outdated and not self._is_running

    def _schedule_search(self) -> None:
        if not self.is_up_to_date and not self._is_running and self.isVisible():
            self.rest_timer.start()

    def show_begun(self) -> None:
        self.rest_timer.stop()
        self._is_running, self._is_outdated = True, False
        self._found, self._reason = {}, ""
        for card in self.cards.values():
            card.show_searching()
        self._show_answer()

    def show_progress(self, pictures: Mapping[str, int | None]) -> None:
        """Show how many pictures each decoder has tried so far; None: its search has not begun."""
        for decoder, count in pictures.items():
            if decoder in self.cards:
                self.cards[decoder].show_progress(count)

    def show_rough(self, decoder: str, frequencies: WorkingRange) -> None:
        if decoder in self.cards:
            self.cards[decoder].show_rough(frequencies)
            self._show_answer()

    def show_advice(self, advice: Advice) -> None:
        card = self.cards.get(advice.limits.decoder)
        if card is not None:
            line, frequencies = make_frequency_line(advice), advice.limits.frequency
            tip = f"{advice.cause}\n{line.text} {line.detail}".strip()
            card.show_limit(frequencies.highest, tip)
            card.name.setToolTip(f"It reads where {advice.limits.rate:g} % of the bits are right.")
            card.show_range(frequencies, "" if frequencies.intervals else advice.cause)
            self._found[advice.limits.decoder] = advice
            self._show_answer()

    def _show_answer(self) -> None:
        named = list(self.cards)[:_IN_ANSWER]
        found = [self._found[name] for name in named if name in self._found]
        rest = [name for name in named if name not in self._found] if self._is_running else []
        sought = [self.cards[name].describe_sought() for name in rest]
        line, note = make_answer(found, sought)
        if self._is_outdated and line:
            line = f"Earlier scene: {line}"
        note = f"{note} {self._reason}".strip() if line else ""
        self.answer.show_answer(line or self._reason, note=note)
        self.answer.setEnabled(not self._is_outdated)

    def show_ended(self, reason: str = "") -> None:
        """Show that the search has ended; ``reason``: why it is incomplete, else empty."""
        self._is_running, self._is_complete, self._reason = False, not reason, reason
        for decoder in self.cards.keys() - self._found.keys():
            self.cards[decoder].show_unknown(reason)
        self._show_answer()

    def show_outdated(self, outdated: bool) -> None:
        self._is_outdated = outdated
        self._show_answer()
        for card in self.cards.values():
            card.set_outdated(outdated)
        self.rest_timer.stop()
        self._schedule_search()


class LimitCard(QFrame):
    chosen = Signal(str, float, str)  # the parameter, its value in SI units, and the decoder

    def __init__(self, decoder: str) -> None:
        super().__init__()
        self.setObjectName("card")
        self._decoder = decoder
        self._destination: float | None = None
        self._is_outdated = self._is_searching = False
        self._rough = ""
        self.name = paragraph()
        self.value = QLabel()
        self.range = ElidedLabel(separator="; ")
        self.range.setAccessibleName(f"Frequencies read, {decoder}")
        self._enlarge_value()
        call_at(self, self._enlarge_value, QEvent.Type.FontChange)
        self.value.setAccessibleName(f"Highest frequency, {decoder}")
        self.go = push_button("Go", do=self._choose, name=f"Go to the highest frequency, {decoder}")
        grid = QGridLayout(self)
        grid.setContentsMargins(12, 6, 8, 6)
        grid.setSpacing(2)
        grid.addWidget(self.name, 0, 0, 1, 2)
        grid.addWidget(self.value, 1, 0, 1, 2)
        grid.addWidget(self.range, 2, 0)
        grid.addWidget(self.go, 2, 1)  # beside the text that can be elided, in a narrow window
        grid.setColumnStretch(0, 1)
        self.show_unknown()
        self.set_outdated(False)

    def _enlarge_value(self) -> None:
        self.value.setFont(heading_font(self.font()))

    def _choose(self) -> None:
        if self._destination is not None:
            self.chosen.emit(_PARAMETER, self._destination, self._decoder)

    def _show(self, text: str, tip: str, destination: float | None, bound: str = "up to") -> None:
        self._destination = destination
        self.range.set_full_text("")
        self.name.setText(f"{self._decoder.capitalize()}: {bound}")
        self.value.setText(text)
        self.value.setToolTip(tip)
        self._update_button()

    def _update_button(self) -> None:
        """Enable the button for a limit of the present scene; explain why it is disabled."""
        self.go.setEnabled(self._destination is not None and not self._is_outdated)
        self.go.setToolTip(
            "Of an earlier scene; while this card is visible, a new search starts by itself."
            if self._is_outdated
            else self.value.toolTip()
        )

    def show_unknown(self, reason: str = "") -> None:
        self._is_searching = False
        self._show("?" if reason else "", reason or "Not searched for yet.", None)

    def show_searching(self) -> None:
        self._is_searching, self._rough = True, ""
        self._show("waiting", "Its search has not begun yet.", None)
        self.set_outdated(False)

    def show_progress(self, pictures: int | None) -> None:
        """Show how many pictures the running search has tried; None: it has not begun."""
        if self._is_searching and pictures is not None:
            tried = f"{inflect(pictures, 'picture')} tried" if pictures else ""
            tip = "Searching for the highest frequency that is read."
            self._show(self._rough or "searching", tip, None)
            self.range.set_full_text(tried)

    def describe_sought(self) -> str:
        """Name the decoder of a running search, and what is roughly known."""
        return f"{self._decoder} ({self._rough})" if self._rough else self._decoder

    def show_rough(self, frequencies: WorkingRange) -> None:
        """Show what one picture at each frequency says, until the search is complete."""
        if self._is_searching and frequencies.highest is not None:
            self._rough = f"roughly {format_end(_PARAMETER, frequencies.highest)}"
            self.show_progress(0)

    def show_limit(self, end: RangeEnd | None, tip: str) -> None:
        """Show the upper end of the range, or that nothing is read."""
        self._is_searching = False
        if end is None:
            self._show("none", tip, None)
            return
        bound = "at least" if end.fails is None else "up to"
        self._show(value_text(_PARAMETER, end), tip, end.value if end.is_sure else None, bound)

    def show_range(self, frequencies: WorkingRange, cause: str = "") -> None:
        """Show the frequencies read; ``cause``: why none is, where that is known."""
        texts = [text for text in (cause, "a plug-in failed" if frequencies.faults else "") if text]
        if frequencies.others:
            texts.insert(0, f"again {others_text(frequencies)}")
        if frequencies.lowest is not None:
            texts.insert(0, f"from {format_end(_PARAMETER, frequencies.lowest)}")
        if frequencies.highest is not None and frequencies.highest.fails is None:
            texts.insert(0, "not searched beyond")
        self.range.set_full_text("; ".join(texts))

    def set_outdated(self, outdated: bool) -> None:
        self._is_outdated = outdated
        self.range.setEnabled(not outdated)
        self.value.setEnabled(not outdated)
        self._update_button()
