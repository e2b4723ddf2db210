"""Wrong and missing bits and letters are recognized without colour."""

from collections.abc import Callable, Sequence

import numpy as np
import pytest
from gui.kinds import add_widget
from numpy.typing import NDArray
from pytestqt.qtbot import QtBot

from occ_gui.decoding.bit_strip import BitStrip, PayloadText
from occ_model.scene.payload import bits_of_payload

Picture = Callable[[Sequence[int], Sequence[int]], NDArray[np.uint8]]

LEAST_CONTRAST = 40  # grey levels by which pixels must differ to be distinguished in print


@pytest.fixture
def strip(qtbot: QtBot) -> BitStrip:
    strip = add_widget(qtbot, BitStrip())
    strip.resize(strip.sizeHint())
    return strip


@pytest.fixture
def picture(strip: BitStrip, grey_picture: Callable[[BitStrip], NDArray[np.uint8]]) -> Picture:
    """Draw bits, in grey, as a print in black and white shows them."""

    def draw(sent: Sequence[int], received: Sequence[int]) -> NDArray[np.uint8]:
        strip.show_bits(sent, received)
        return grey_picture(strip)

    return draw


def changed_pixels(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> int:
    return int((np.abs(one.astype(int) - other.astype(int)) > LEAST_CONTRAST).sum())


@pytest.mark.parametrize(
    ("sent", "received", "wrong"),
    [
        ([1, 0, 1], [1, 0, 1], []),
        ([1, 0, 1], [0, 0, 0], [0, 2]),
        ([1, 0, 1], [], []),
        ([1, 0, 1], [1, 1], [1]),
        ([1, 0], [1, 1, 0, 0], [1]),
        ([], [1], []),
    ],
)
def test_wrong_places_are_those_of_bits_received_other_than_sent(
    strip: BitStrip, sent: list[int], received: list[int], wrong: list[int]
) -> None:
    strip.show_bits(sent, received)
    assert strip.find_wrong_bits() == wrong


@pytest.mark.parametrize("bit", [0, 1])
def test_a_wrong_or_missing_bit_differs_from_a_right_one_in_grey_print(
    picture: Picture, bit: int
) -> None:
    right, wrong, missing = (picture([bit], received) for received in ([bit], [1 - bit], []))
    middle = right.shape[0] // 2
    above, below = slice(0, middle), slice(middle, None)
    assert changed_pixels(right[below], picture([1 - bit], [bit])[below]) >= 20
    assert changed_pixels(right, missing) >= 20
    assert np.array_equal(right[above], wrong[above])
    assert np.array_equal(right[above], missing[above])
    # A right bit looks like the one sent.
    cells = [right[top : top + 24, 66:95] for top in (3, 30)]
    assert np.array_equal(cells[0], cells[1])


def test_the_strip_is_described_in_words_in_which_many_bits_are_only_counted(
    strip: BitStrip, picture: Picture
) -> None:
    strip.show_bits([1, 0, 1], [1, 1, 1])
    assert strip.accessibleDescription() == "sent 101, received 111, 1 wrong"
    strip.show_bits([1, 0, 1], [])
    assert strip.accessibleDescription() == "sent 101, received nothing, 0 wrong"
    assert strip.toolTip() == strip.accessibleDescription()
    assert strip.accessibleName()
    strip.show_bits([0] * 400, [0] * 100 + [1])
    assert strip.toolTip() == "sent 400 bits, received 101, 1 wrong"
    strip.setFixedWidth(70)
    assert picture([1] * 64, [0] * 32).shape == (strip.height(), 70)


@pytest.mark.parametrize(("count", "wrong"), [(40, 39), (4096, 17)])
def test_one_wrong_bit_among_many_is_visible_in_grey_print(
    picture: Picture, count: int, wrong: int
) -> None:
    sent = (np.arange(count) % 3 % 2).tolist()
    received = list(sent)
    received[wrong] ^= 1
    assert changed_pixels(picture(sent, sent), picture(sent, received)) >= 4


def test_bits_missing_at_the_end_have_no_bars(picture: Picture) -> None:
    sent = [1] * 400
    assert changed_pixels(picture(sent, sent), picture(sent, sent[:200])) > 400


@pytest.fixture
def text(qtbot: QtBot) -> PayloadText:
    return add_widget(qtbot, PayloadText())


def flip_bits(payload: str, *places: int) -> list[int]:
    bits = list(bits_of_payload(payload))
    for place in places:
        bits[place] ^= 1
    return bits


def test_a_right_text_is_written_twice_and_a_missing_letter_is_a_dot(
    text: PayloadText,
) -> None:
    text.show_payload("text:HELLO", flip_bits("text:HELLO"))
    assert text.accessibleDescription() == "sent HELLO, received HELLO, 0 wrong"
    assert "<s" not in text.text()
    text.show_payload("hex:0aff", flip_bits("hex:0aff")[:8])
    assert text.accessibleDescription() == "sent 0aff, received 0a·, 1 wrong"


def test_a_letter_with_a_wrong_bit_is_crossed_out(text: PayloadText) -> None:
    text.show_payload("text:HELLO", flip_bits("text:HELLO", 24))
    assert text.accessibleDescription() == "sent HELLO, received HEL?O, 1 wrong"
    received = text.text().split("received")[1]
    assert received.count("<s ") == 1
    assert ">?</s>O" in received


def test_a_text_is_never_taken_as_markup_and_a_long_one_is_cut(text: PayloadText) -> None:
    text.show_payload("text:<b>&", flip_bits("text:<b>&", 3))
    assert "&lt;b&gt;&amp;" in text.text()
    payload = "text:" + "x" * 512
    text.show_payload(payload, flip_bits(payload, 4000))
    assert len(text.text()) < 400
    assert text.accessibleDescription().endswith("1 wrong")


@pytest.mark.parametrize("payload", ["", "bits:0101"])
def test_bits_and_codes_are_shown_only_in_the_strip(text: PayloadText, payload: str) -> None:
    text.show_payload("text:A", flip_bits("text:A"))
    text.show_payload(payload, [0, 1])
    assert text.isHidden()
