"""Page of advice: the limits of each decoder in sentences, with buttons that change the scene."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from occ_gui.detection_map.advice_sentences import (
    AdviceLine,
    describe_outdated,
    make_advice_lines,
    make_rough_sentence,
)
from occ_gui.detection_map.limit_cards import LimitCards
from occ_gui.widgets.answer import MoreButton
from occ_gui.widgets.building import (
    ElidedLabel,
    ScrollPane,
    fill,
    name_widget,
    paragraph,
    push_button,
)
from occ_model.results.bit_errors import FRAMES_A_SECOND
from occ_model.results.limits import Advice, WorkingRange

_LEAST_SIZE = QSize(200, 60)


class AdviceView(QWidget):
    search_requested = Signal()  # the user asks for advice about the present scene

    cancelled = Signal()
    map_requested = Signal()

    destination_chosen = Signal(str, float, str)
    """The user goes to a limit: a parameter, its value in SI units, and the decoder."""

    def __init__(self, decoders: Sequence[str] = ()) -> None:
        super().__init__()
        self.cards = LimitCards(decoders)
        """The highest frequency of each decoder, shown outside this page."""
        self.cards.destination_chosen.connect(self.destination_chosen)
        self._frames_a_second = FRAMES_A_SECOND
        self.lines: list[QWidget] = []
        self.rough: dict[str, QWidget] = {}
        """By decoder, the line that its advice replaces."""
        self.destinations: dict[QPushButton, tuple[str, QLabel, QLabel]] = {}
        """The parameter that each button changes, and the sentences beside it."""
        self._common_texts: list[str] = []
        self._more: dict[str, MoreButton] = {}
        """By decoder, the button that shows its details; by an empty name, the common details."""
        self._end_sentence = ""
        self.back = push_button("Back to the map", "Show the map again.", self.map_requested)
        self.search_again = push_button(
            "Search again", "Search for the limits of the current scene.", self.search_requested
        )
        self.cancel = push_button("Cancel", "Stop the search.", self.cancelled)
        self.progress = name_widget(
            QProgressBar(),
            "Progress of the search",
            "The limits of each decoder appear below as soon as they are found.",
        )
        self.state = name_widget(ElidedLabel(), "State of the search")
        self._lay_out()
        self._show_running(False)

    def _lay_out(self) -> None:
        row = QHBoxLayout()
        head = fill(
            row, self.back, self.search_again, self.cancel, (self.progress, 1), (self.state, 1)
        )
        self.content = QWidget()
        column = QVBoxLayout(self.content)
        self._column = fill(column, (None, 1), margins=(0, 0, 4, 0))
        scroll_pane = ScrollPane(self.content, _LEAST_SIZE)
        fill(QVBoxLayout(self), head, (scroll_pane, 1), margins=(4, 2, 4, 2))

    def _show_running(self, is_running: bool) -> None:
        self.progress.setVisible(is_running)
        self.cancel.setVisible(is_running)
        self.search_again.setVisible(not is_running)
        self.state.setVisible(not is_running)

    def use_frame_rate(self, frames_a_second: float) -> None:
        """Set the number of pictures a second from which later advice computes bits a second."""
        self._frames_a_second = frames_a_second

    def show_advice_begun(self, omitted_effects: tuple[str, ...]) -> None:
        """Remove the previous advice, and show that a search is running and what it leaves out."""
        for line in [*self.lines]:
            self._remove(line)
        self.lines, self.destinations, self._common_texts, self._more = [], {}, [], {}
        self.rough = {}
        self.progress.setValue(0)
        self._show_running(True)
        self.cards.show_begun()
        if omitted_effects:
            self._add(
                AdviceLine(f"This advice leaves out: {', '.join(omitted_effects)}.", is_title=True)
            )

    def show_advice_progress(self, fraction: float, pictures: Mapping[str, int | None]) -> None:
        """Show the fraction done, and how many pictures each decoder has tried; None: not begun."""
        self.progress.setValue(round(100 * fraction))
        self.cards.show_progress(pictures)

    def show_rough(self, decoder: str, frequencies: WorkingRange) -> None:
        """Show what one picture at each frequency says, until the advice of a decoder is found."""
        self.cards.show_rough(decoder, frequencies)
        if decoder not in self.rough:
            self._add(AdviceLine(make_rough_sentence(decoder, frequencies)))
            self.rough[decoder] = self.lines[-1]

    def show_advice(self, advice: Advice) -> None:
        self.cards.show_advice(advice)
        rough = self.rough.pop(advice.limits.decoder, None)
        if rough is not None:
            self._remove(rough)
        for line in make_advice_lines(advice, self._frames_a_second):
            if not line.is_common:
                self._add(line, advice.limits.decoder)
            elif line.text not in self._common_texts:
                if not self._common_texts:
                    self._add_common(AdviceLine("For every decoder", is_title=True))
                self._add_common(line)

    def show_advice_ended(self, sentence: str) -> None:
        self._end_sentence = sentence
        self.cards.show_ended(sentence)
        self.state.set_full_text(sentence)
        self._show_running(False)

    def show_advice_outdated(self, outdated: bool, valid_parameters: frozenset[str]) -> None:
        """Mark the advice as outdated; ``valid_parameters``: those whose limits still hold."""
        self.cards.show_outdated(outdated and "switching_frequency" not in valid_parameters)
        if not self.lines:
            return
        text = describe_outdated(valid_parameters)
        self.state.set_full_text(text if outdated else self._end_sentence)
        for line in self.lines:
            for label in line.findChildren(QLabel):
                label.setEnabled(not outdated)
        for button, (parameter, *labels) in self.destinations.items():
            for widget in (button, *labels):
                widget.setEnabled(not outdated or parameter in valid_parameters)

    def _remove(self, line: QWidget) -> None:
        self.lines.remove(line)
        self._column.removeWidget(line)
        line.deleteLater()

    def _add_common(self, line: AdviceLine) -> None:
        self._common_texts.append(line.text)
        self._insert(self._column.count() - 1, line)

    def _add(self, line: AdviceLine, decoder: str = "") -> None:
        self._insert(self._column.count() - 1 - len(self._common_texts), line, decoder)

    def _insert(self, place: int, line: AdviceLine, decoder: str = "") -> None:
        row, label, detail = QWidget(), _make_label(line.text), _make_label(line.detail)
        font = label.font()
        font.setBold(line.is_title)
        label.setFont(font)
        texts = fill(QVBoxLayout(), label, detail, margins=0, spacing=0)
        layout = fill(QHBoxLayout(row), (texts, 1), margins=0)
        if line.is_title:
            self._more[decoder] = MoreButton()
            layout.addWidget(self._more[decoder], 0, Qt.AlignmentFlag.AlignTop)
        for part, unfolds in ((row, line.is_detail), (detail, bool(line.detail))):
            if unfolds:
                self._more[decoder].toggled.connect(part.setVisible)
        detail.setVisible(False)
        row.setVisible(not line.is_detail)
        if line.destination is not None:
            button = self._make_button(*line.destination, decoder)
            self.destinations[button] = (line.destination[0], label, detail)
            layout.addWidget(button, 0, Qt.AlignmentFlag.AlignTop)
        self._column.insertWidget(place, row)
        self.lines.append(row)

    def _make_button(self, name: str, value: float, text: str, decoder: str) -> QPushButton:
        return push_button(
            f"Go to {text}",
            f"Change the scene to {text}, where it read every bit.",
            lambda: self.destination_chosen.emit(name, value, decoder),
        )


def _make_label(text: str) -> QLabel:
    label = paragraph(text, is_selectable=True)
    # Without a minimum height, which is computed for a narrow label and would be too large.
    label.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
    return label
