"""The code is shown as a number and as bits, and entered in either form."""

import pytest
from gui.stores import store_of
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from occ_gui.scene.code_entry import CodeEntry
from occ_model.scene.scene import Scene


class CodeForm:
    """An entry that edits a store, with a record of its signals."""

    def __init__(self, qtbot: QtBot) -> None:
        self.entry = CodeEntry()
        self.store = store_of(Scene().replace(code=718, bits=10))
        self.edits: list[tuple[str, int, int]] = []
        self.refused: list[str] = []
        self.entry.edited.connect(self._edit)
        self.entry.refused.connect(self.refused.append)
        self.store.changed.connect(self.entry.show_scene)
        self.entry.show_scene(self.store.scene)
        self._qtbot = qtbot
        for widget in (self.entry, self.entry.title):  # another widget shows the title
            qtbot.addWidget(widget)
        self.entry.show()

    def _edit(self, name: str, code: int, gesture: int) -> None:
        self.edits.append((name, code, gesture))
        self.store.change(gesture, **{name: code})

    @property
    def codes(self) -> list[int]:
        return [code for _, code, _ in self.edits]

    def texts(self) -> tuple[int, str]:
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
def form(qtbot: QtBot) -> CodeForm:
    return CodeForm(qtbot)


def test_quick_steps_of_the_number_are_one_step_to_undo(form: CodeForm, qtbot: QtBot) -> None:
    for _ in range(3):
        qtbot.keyClick(form.entry.number, Qt.Key.Key_Up)
    assert form.codes == [719, 720, 721]
    form.store.undo_stack.undo()
    assert form.texts() == (718, "1011001110")


def test_bits_and_number_follow_each_other(form: CodeForm) -> None:
    assert form.texts() == (718, "1011001110")
    form.enter_number("3")
    assert form.texts() == (3, "0000000011")
    assert form.codes == [3]
    form.enter_bits("11111 00000")
    assert form.texts() == (0b1111100000, "1111100000")
    assert form.codes == [3, 0b1111100000]


def test_every_entry_is_a_gesture_of_its_own(form: CodeForm) -> None:
    form.enter_bits("0000000001")
    form.enter_number("2")
    form.enter_number("3")
    assert len({gesture for _, _, gesture in form.edits}) == 3


@pytest.mark.parametrize("text", ["101", "1011001112"])
def test_digits_that_are_not_bits_stay_with_the_reason_until_corrected(
    form: CodeForm, text: str
) -> None:
    form.enter_bits(text)
    (sentence,) = form.refused
    assert repr(text) in sentence
    assert "allowed: 10 characters 0 and 1" in sentence
    assert f"text:{text}" in sentence
    form.store.change(iso=200.0)  # this ends all other refusals
    form.entry.end_refusal()
    assert form.texts() == (718, text)
    notice = form.entry.notices[1]
    assert notice.isVisible()
    form.enter_bits("0000000001")
    assert form.texts() == (1, "0000000001")
    assert not notice.isVisible()


def test_cleared_or_unchanged_bits_return_silently(form: CodeForm, qtbot: QtBot) -> None:
    form.enter_bits("")
    assert form.texts() == (718, "1011001110")
    assert form.codes == form.refused == []
    qtbot.keyClick(form.entry.bits, Qt.Key.Key_Return)
    assert form.codes == []
    assert form.refused == []
    form.enter_bits("10110 01110")
    assert form.codes == []
    assert form.refused == []
    assert form.texts() == (718, "1011001110")


def test_a_click_on_the_reason_also_removes_the_text(form: CodeForm, qtbot: QtBot) -> None:
    form.enter_bits("101")
    qtbot.mouseClick(form.entry.notices[1], Qt.MouseButton.LeftButton)
    assert form.texts() == (718, "1011001110")


def test_the_number_of_bits_limits_what_can_be_entered(form: CodeForm) -> None:
    form.store.change(code=5, bits=3)
    assert form.texts() == (5, "101")
    assert form.entry.number.maximum() == 7
    assert "from 0 to 7" in form.entry.number.toolTip()
    form.enter_bits("011")
    assert form.texts() == (3, "011")
    form.store.change(pattern="10")  # sent in place of the code, and named by the title
    assert (form.entry.isVisible(), "lamp" in form.entry.title.text()) == (False, True)
    form.store.change(code=2**16 - 1, bits=16, pattern="")
    assert form.entry.isVisible()
    assert form.texts() == (65535, "1" * 16)
    assert form.codes == [3]


@pytest.mark.parametrize(
    ("typed", "payload", "title"),
    [
        ("HELLO", "text:HELLO", "Sent as text: 40 bits"),
        ("😀", "text:😀", "Sent as text: 32 bits"),
        ("hex:0f", "hex:0f", "Sent as bytes: 8 bits"),
        ("bits:011", "bits:011", "Sent as bits: 3 bits"),
    ],
)
def test_a_payload_that_is_typed_is_sent_and_alone_is_shown(
    form: CodeForm, typed: str, payload: str, title: str
) -> None:
    form.enter_bits(typed)
    assert form.store.scene.transmitter.payload == payload
    assert form.entry.bits.text() == typed
    assert form.entry.title.text() == title
    assert form.entry.number.isHidden()
    assert form.refused == []


def test_a_cleared_field_sends_the_code_again_and_bits_end_a_payload(
    form: CodeForm,
) -> None:
    form.enter_bits("hex:0F")
    assert form.texts()[1] == "hex:0f"
    form.enter_bits("")
    assert form.store.scene.transmitter.payload == ""
    assert form.texts() == (718, "1011001110")
    assert form.entry.number.isVisible()
    assert form.entry.title.text() == "Code, as a number and as bits"
    form.enter_bits("text:HI")
    form.enter_bits("0000000001")
    assert form.store.scene.transmitter.payload == ""
    assert form.store.scene.transmitter.code == 1
    assert form.texts() == (1, "0000000001")
    form.store.change(-1, payload="bits:01")
    assert form.texts() == (1, "bits:01")
    form.store.undo_stack.undo()
    assert form.texts() == (1, "0000000001")


@pytest.mark.parametrize(("typed", "bits"), [("text:", "0"), ("x" * 513, "4,104")])
def test_an_invalid_payload_is_refused_and_the_code_is_sent(
    form: CodeForm, typed: str, bits: str
) -> None:
    form.enter_bits(typed)
    assert form.store.scene.transmitter.payload == ""
    assert form.texts() == (718, typed)
    assert len(form.refused) == 1
    assert f"Payload cannot have {bits} bits" in form.refused[0]
