"""Payloads as texts, bytes and bits."""

import pytest
from each_case import each_case
from hypothesis import given, strategies as st
from scene_values import PAYLOADS

import occ_model as occ
from occ_model.scene.from_text import change_scene
from occ_model.scene.parameters import payload_parameter
from occ_model.scene.payload import (
    MAX_PAYLOAD_BITS,
    bits_of_payload,
    canonical_payload,
    compare_payload,
    form_of,
    payload_of_bits,
)
from occ_model.transmitter.scheme import bits_of


@given(payload=PAYLOADS.filter(bool))
def test_a_canonical_payload_stays_as_it_is(payload: str) -> None:
    assert canonical_payload(payload) == payload
    assert occ.Scene().replace(payload=payload).transmitter.payload == payload


@given(payload=PAYLOADS.filter(bool))
def test_the_bits_of_a_payload_are_written_as_the_payload_was(payload: str) -> None:
    form, _, content = payload.partition(":")
    written = payload_of_bits(bits_of_payload(payload), form)
    if form != "text":
        assert written == content
    else:
        pairs = zip(written, content, strict=True)
        assert all(one == other or one == "?" for one, other in pairs)


def test_a_text_is_sent_as_utf_8_most_significant_bit_first() -> None:
    assert bits_of_payload("text:A") == (0, 1, 0, 0, 0, 0, 0, 1)
    assert len(bits_of_payload("text:é")) == 16
    assert bits_of_payload("hex:41") == bits_of_payload("text:A")


def test_spaces_and_capitals_do_not_count_in_digits() -> None:
    assert canonical_payload("hex: 4A 4b") == "hex:4a4b"
    assert canonical_payload("bits: 01 10") == "bits:0110"
    assert canonical_payload("text: a ") == "text: a "


@each_case(
    [
        ("HELLO", "text:HELLO"),
        ("😀", "text:😀"),
        ("HI", "text:HI"),
        ("0x", "text:0x"),
        ("718", "text:718"),
        (" a: b ", "text: a: b "),
        ("https://x", "text:https://x"),
        ("0xyz", "text:0xyz"),
        ("0x48 65", "hex:4865"),
        ("0B01", "bits:01"),
        ("Hex:4A", "hex:4a"),
        ("text:0x48", "text:0x48"),
        ("  ", ""),
    ]
)
def test_a_payload_as_people_type_it_is_understood_and_shown_as_typed(
    typed: str, payload: str
) -> None:
    declared = payload_parameter()
    assert declared.parse(typed) == payload
    scene = change_scene(occ.Scene(), [f"payload={typed}"])
    assert scene == occ.Scene().replace(payload=typed)
    assert scene.transmitter.payload == payload
    assert declared.parse(declared.format(payload)) == payload


@given(payload=PAYLOADS)
def test_a_payload_formatted_for_typing_is_the_same_payload(payload: str) -> None:
    declared = payload_parameter()
    assert declared.parse(declared.format(payload)) == payload


def test_wrong_bits_show_as_other_letters_or_question_marks() -> None:
    bits = list(bits_of_payload("text:HELLO"))
    bits[24] ^= 1  # the second L is no ASCII any more
    assert payload_of_bits(bits, "text") == "HEL?O"
    assert payload_of_bits(bits[:-3], "text") == "HEL?"


def test_the_longest_payload_has_4096_bits() -> None:
    longest = "bits:" + "1" * MAX_PAYLOAD_BITS
    assert len(occ.Scene().replace(payload=longest).transmitter.payload_bits) == 4096
    assert occ.Scene().replace(payload="text:" + "x" * 512).transmitter.payload_length == 4096


@pytest.mark.parametrize(("code", "bits"), [(0, 2), (718, 10), (65535, 16)])
def test_without_a_payload_the_code_is_sent(code: int, bits: int) -> None:
    transmitter = occ.Scene().replace(code=code, bits=bits).transmitter
    assert transmitter.payload_bits == bits_of(code, bits)
    assert transmitter.payload_length == bits


def test_form_of_names_the_form() -> None:
    assert [form_of(text) for text in ("text:a", "hex:00", "bits:1")] == ["text", "hex", "bits"]


@given(payload=PAYLOADS.filter(lambda text: text.startswith(("text:", "hex:"))))
def test_a_payload_received_correctly_has_no_wrong_piece(payload: str) -> None:
    pieces = compare_payload(payload, bits_of_payload(payload))
    assert all(piece.is_right and piece.sent == piece.received for piece in pieces)
    assert "".join(piece.sent for piece in pieces) == payload_of_bits(
        bits_of_payload(payload), form_of(payload)
    )


@given(payload=PAYLOADS.filter(lambda text: text.startswith("text:")), data=st.data())
def test_one_wrong_bit_makes_one_wrong_letter(payload: str, data: st.DataObject) -> None:
    bits = list(bits_of_payload(payload))
    bits[data.draw(st.integers(0, len(bits) - 1))] ^= 1
    assert sum(not piece.is_right for piece in compare_payload(payload, bits)) == 1


def test_bits_have_no_letters_to_compare() -> None:
    assert compare_payload("bits:0101", [0, 1, 0, 1]) == ()
    assert compare_payload("", [0, 1]) == ()
