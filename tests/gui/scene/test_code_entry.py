"""The code is shown as a number and as bits, and entered in either form."""

import pytest
from gui.stores import store_of
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from occ_gui.scene.code_entry import CodeEntry
from occ_model.scene.scene import Scene


class Bench:
    """An entry on a store, and what it told."""

    def __init__(self, qtbot: QtBot) -> None:
        self.entry = CodeEntry()
        self.store = store_of(Scene().replace(code=718, bits=10))
        self.told: list[tuple[str, int, int]] = []
        self.refused: list[str] = []
        self.entry.edited.connect(self._take)
        self.entry.refused.connect(self.refused.append)
        self.store.changed.connect(self.entry.show_scene)
        self.entry.show_scene(self.store.scene)
        self._qtbot = qtbot
        qtbot.addWidget(self.entry)
        self.entry.show()

    def _take(self, name: str, code: int, gesture: int) -> None:
        self.told.append((name, code, gesture))
        self.store.change(gesture, **{name: code})

    @property
    def codes(self) -> list[int]:
        return [code for _, code, _ in self.told]

    def shown(self) -> tuple[int, str]:
        return self.entry.number.value(), self.entry.bits.text()

    def enter_bits(self, text: str) -> None:
        self.entry.bits.selectAll()
        self._qtbot.keyClick(self.entry.bits, Qt.Key.Key_Delete)
        self.entry.bits.insert(text)  # as an input method does: not all letters are on keys
        self._qtbot.keyClick(self.entry.bits, Qt.Key.Key_Return)

    def enter_number(self, text: str) -> None:
        self.entry.number.selectAll()
        self._qtbot.keyClicks(self.entry.number, text)
        self._qtbot.keyClick(self.entry.number, Qt.Key.Key_Return)


@pytest.fixture
def bench(qtbot: QtBot) -> Bench:
    return Bench(qtbot)


def test_quick_steps_of_the_number_are_one_step_to_undo(bench: Bench, qtbot: QtBot) -> None:
    for _ in range(3):
        qtbot.keyClick(bench.entry.number, Qt.Key.Key_Up)
    assert bench.codes == [719, 720, 721]
    bench.store.undo_stack.undo()
    assert bench.shown() == (718, "1011001110")


def test_bits_and_number_follow_each_other(bench: Bench) -> None:
    assert bench.shown() == (718, "1011001110")
    bench.enter_number("3")
    assert bench.shown() == (3, "0000000011")
    assert bench.codes == [3]
    bench.enter_bits("11111 00000")
    assert bench.shown() == (0b1111100000, "1111100000")
    assert bench.codes == [3, 0b1111100000]


def test_every_entry_is_a_gesture_of_its_own(bench: Bench) -> None:
    bench.enter_bits("0000000001")
    bench.enter_number("2")
    bench.enter_number("3")
    assert len({gesture for _, _, gesture in bench.told}) == 3


@pytest.mark.parametrize("text", ["101", "1011001112"])
def test_digits_that_are_no_bits_stay_with_the_reason_until_typed_anew(
    bench: Bench, text: str
) -> None:
    bench.enter_bits(text)
    (sentence,) = bench.refused
    assert repr(text) in sentence
    assert "allowed: 10 characters 0 and 1" in sentence
    assert f"text:{text}" in sentence
    bench.store.change(iso=200.0)  # and with it, all refusals end
    bench.entry.end_refusal()
    assert bench.shown() == (718, text)
    notice = bench.entry.notices[1]
    assert notice.isVisible()
    bench.enter_bits("0000000001")
    assert bench.shown() == (1, "0000000001")
    assert not notice.isVisible()


def test_the_emptied_or_untouched_bits_come_back_without_a_word(bench: Bench, qtbot: QtBot) -> None:
    bench.enter_bits("")
    assert bench.shown() == (718, "1011001110")
    assert bench.codes == bench.refused == []
    qtbot.keyClick(bench.entry.bits, Qt.Key.Key_Return)
    assert bench.codes == []
    assert bench.refused == []
    bench.enter_bits("10110 01110")
    assert bench.codes == []
    assert bench.refused == []
    assert bench.shown() == (718, "1011001110")


def test_the_reason_clicked_away_takes_the_text_with_it(bench: Bench, qtbot: QtBot) -> None:
    bench.enter_bits("101")
    qtbot.mouseClick(bench.entry.notices[1], Qt.MouseButton.LeftButton)
    assert bench.shown() == (718, "1011001110")


def test_the_number_of_bits_sets_what_can_be_entered(bench: Bench) -> None:
    bench.store.change(code=5, bits=3)
    assert bench.shown() == (5, "101")
    assert bench.entry.number.maximum() == 7
    assert "from 0 to 7" in bench.entry.number.toolTip()
    bench.enter_bits("011")
    assert bench.shown() == (3, "011")
    bench.store.change(code=2**16 - 1, bits=16)
    assert bench.shown() == (65535, "1" * 16)
    assert bench.codes == [3]


@pytest.mark.parametrize(
    ("typed", "payload", "title"),
    [
        ("HELLO", "text:HELLO", "Sent as text: 40 bits"),
        ("😀", "text:😀", "Sent as text: 32 bits"),
        ("hex:0f", "hex:0f", "Sent as bytes: 8 bits"),
        ("bits:011", "bits:011", "Sent as bits: 3 bits"),
    ],
)
def test_what_is_typed_as_a_payload_is_sent_and_alone_is_shown(
    bench: Bench, typed: str, payload: str, title: str
) -> None:
    bench.enter_bits(typed)
    assert bench.store.scene.transmitter.payload == payload
    assert bench.entry.bits.text() == typed
    assert bench.entry.title.text() == title
    assert bench.entry.number.isHidden()
    assert bench.refused == []


def test_the_emptied_field_sends_the_code_again_and_bits_end_a_payload(bench: Bench) -> None:
    bench.enter_bits("hex:0F")
    assert bench.shown()[1] == "hex:0f"
    bench.enter_bits("")
    assert bench.store.scene.transmitter.payload == ""
    assert bench.shown() == (718, "1011001110")
    assert bench.entry.number.isVisible()
    assert bench.entry.title.text() == "Code, as a number and as bits"
    bench.enter_bits("text:HI")
    bench.enter_bits("0000000001")
    assert bench.store.scene.transmitter.payload == ""
    assert bench.store.scene.transmitter.code == 1
    assert bench.shown() == (1, "0000000001")
    bench.store.change(-1, payload="bits:01")
    assert bench.shown() == (1, "bits:01")
    bench.store.undo_stack.undo()
    assert bench.shown() == (1, "0000000001")


@pytest.mark.parametrize(("typed", "bits"), [("text:", "0"), ("x" * 513, "4,104")])
def test_a_payload_that_is_none_is_refused_and_the_code_is_sent(
    bench: Bench, typed: str, bits: str
) -> None:
    bench.enter_bits(typed)
    assert bench.store.scene.transmitter.payload == ""
    assert bench.shown() == (718, typed)
    assert len(bench.refused) == 1
    assert f"Payload cannot have {bits} bits" in bench.refused[0]
