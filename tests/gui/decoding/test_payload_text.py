"""A payload, sent and received: wrong letters are crossed out."""

import pytest
from gui.kinds import add_widget
from pytestqt.qtbot import QtBot

from occ_gui.decoding.bit_strip import PayloadText
from occ_model.scene.payload import bits_of_payload


@pytest.fixture
def text(qtbot: QtBot) -> PayloadText:
    return add_widget(qtbot, PayloadText())


def flipped(payload: str, *places: int) -> list[int]:
    bits = list(bits_of_payload(payload))
    for place in places:
        bits[place] ^= 1
    return bits


def test_a_text_received_rightly_is_written_twice_and_a_letter_that_was_not_is_a_dot(
    text: PayloadText,
) -> None:
    text.show_payload("text:HELLO", flipped("text:HELLO"))
    assert text.accessibleDescription() == "sent HELLO, received HELLO, 0 wrong"
    assert "<s" not in text.text()
    text.show_payload("hex:0aff", flipped("hex:0aff")[:8])
    assert text.accessibleDescription() == "sent 0aff, received 0a·, 1 wrong"


def test_a_letter_with_a_wrong_bit_is_crossed_out(text: PayloadText) -> None:
    text.show_payload("text:HELLO", flipped("text:HELLO", 24))
    assert text.accessibleDescription() == "sent HELLO, received HEL?O, 1 wrong"
    received = text.text().split("received")[1]
    assert received.count("<s ") == 1
    assert ">?</s>O" in received


def test_a_text_is_never_read_as_markup_and_a_long_one_cut(text: PayloadText) -> None:
    text.show_payload("text:<b>&", flipped("text:<b>&", 3))
    assert "&lt;b&gt;&amp;" in text.text()
    payload = "text:" + "x" * 512
    text.show_payload(payload, flipped(payload, 4000))
    assert len(text.text()) < 400
    assert text.accessibleDescription().endswith("1 wrong")


@pytest.mark.parametrize("payload", ["", "bits:0101"])
def test_bits_and_codes_stand_in_the_strip_alone(text: PayloadText, payload: str) -> None:
    text.show_payload("text:A", flipped("text:A"))
    text.show_payload(payload, [0, 1])
    assert text.isHidden()
