"""Line codes against the tables and rules of their standards."""

from itertools import product

import numpy as np
import pytest
from each_case import each_case
from hypothesis import given, strategies as st

from occ_model.transmitter.line_codes import _4b6b, _8b10b, fsk, manchester
from occ_model.transmitter.line_codes._8b10b import encode_byte
from occ_model.transmitter.line_codes.differential_manchester import decode, encode
from occ_model.transmitter.line_codes.fsk import HALF_PERIODS

COMMAS = ("0011111", "1100000")


def text(chips: np.ndarray) -> str:
    return "".join(map(str, chips.tolist()))


def test_manchester_sends_0_as_01_and_1_as_10() -> None:
    bits = np.array([0, 1, 1, 0], dtype=np.uint8)
    assert text(manchester.LINE_CODE.encode(bits, 0)) == "01101001"


def test_4b6b_words_are_those_of_ieee_802_15_7() -> None:
    published = {
        0x0: "001110", 0x1: "001101", 0x2: "010011", 0x3: "010110", 0x4: "010101", 0x5: "100011",
        0x6: "100110", 0x7: "100101", 0x8: "011001", 0x9: "011010", 0xA: "011100", 0xB: "110001",
        0xC: "110010", 0xD: "101001", 0xE: "101010", 0xF: "101100",
    }  # fmt: skip
    bits = np.unpackbits(np.array([0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF], dtype=np.uint8))
    sent = text(_4b6b.LINE_CODE.encode(bits, 0))
    assert sent == "".join(published[number] for number in range(16))


def test_8b10b_words_begin_with_their_bits_but_for_nine() -> None:
    """Only 0, 31, 15, 24 and the values with one of the five bits set begin otherwise."""
    changed = []
    for low in range(32):
        bits = f"{low:05b}"[::-1]  # A, which is the lowest bit, first
        if encode_byte(low, -1)[0][:5] != bits:
            changed.append(low)
    assert changed == [0, 1, 2, 4, 8, 15, 16, 24, 31]


@each_case(
    [
        (0, 0, "1001110100", "0110001011"),  # D0.0
        (21, 5, "1010101010", "1010101010"),  # D21.5
        (28, 5, "0011101010", "0011101010"),  # D28.5
        (31, 7, "1010110001", "0101001110"),  # D31.7
        (17, 7, "1000110111", "1000110001"),  # D17.7: the alternate form
        (18, 7, "0100110111", "0100110001"),  # D18.7
        (20, 7, "0010110111", "0010110001"),  # D20.7
        (11, 7, "1101001110", "1101001000"),  # D11.7
        (13, 7, "1011001110", "1011001000"),  # D13.7
        (14, 7, "0111001110", "0111001000"),  # D14.7
        (7, 3, "1110001100", "0001110011"),  # D7.3: balanced, but with two forms
        (16, 2, "0110110101", "1001000101"),  # D16.2, an idle of 1000BASE-X
        (5, 6, "1010010110", "1010010110"),  # D5.6, the other idle
    ]
)
def test_8b10b_words_are_those_of_ieee_802_3(
    low: int, high: int, negative: str, positive: str
) -> None:
    byte = high << 5 | low
    assert encode_byte(byte, -1)[0] == negative
    assert encode_byte(byte, 1)[0] == positive


def test_no_data_contain_a_comma_or_a_run_of_six() -> None:
    words = {before: [encode_byte(byte, before) for byte in range(256)] for before in (-1, 1)}
    for word, between in words[-1] + words[1]:
        pairs = " ".join(word + following for following, _ in words[between])
        assert not any(chips in pairs for chips in (*COMMAS, "000000", "111111"))


@pytest.mark.parametrize("symbol", range(4))
def test_a_symbol_of_fsk_is_one_frequency(symbol: int) -> None:
    bits = np.array([symbol >> 1, symbol & 1] * 20, dtype=np.uint8)
    chips = fsk.LINE_CODE.encode(bits, 0).astype(float)
    power = np.abs(np.fft.rfft(chips - chips.mean())) ** 2
    strongest = int(power.argmax()) / len(chips)  # cycles a chip
    assert strongest == pytest.approx(1 / (2 * HALF_PERIODS[symbol]))


def test_one_wrong_chip_of_a_symbol_of_fsk_is_corrected_and_two_are_found() -> None:
    bits = np.array([0, 0, 0, 1, 1, 0, 1, 1], dtype=np.uint8)
    chips = fsk.LINE_CODE.encode(bits, 0)
    for place in range(len(chips)):
        one, two = chips.copy(), chips.copy()
        one[place] ^= 1
        two[[place, place ^ 1]] ^= 1
        read = fsk.LINE_CODE.decode(one, 0)
        assert (read.failure, read.bits.tolist()) == (None, bits.tolist())
        assert "are not a symbol of one frequency" in fsk.LINE_CODE.decode(two, 0).failure


def test_8b10b_is_read_from_any_word() -> None:
    bits = np.random.default_rng(1).integers(0, 2, 8 * 12).astype(np.uint8)
    code = _8b10b.LINE_CODE
    chips = code.encode(bits, 0)
    read = [code.decode(chips[10 * word :], 0) for word in range(12)]
    for word, decoded in enumerate(read):
        np.testing.assert_array_equal(decoded.bits, bits[8 * word :])
    # Some of these words have the other running disparity, which is reported.
    told = [decoded.failure for decoded in read]
    assert None in told
    assert any(said is not None and "is not an 8B10B word of its running" in said for said in told)


BITS = 10

every_level = pytest.mark.parametrize("level", [0, 1])
levels = st.integers(0, 1)
bit_strings = st.lists(st.integers(0, 1), max_size=40)


@every_level
def test_as_in_ieee_802_5_a_bit_changes_in_its_middle_and_a_zero_at_its_start(level: int) -> None:
    for bits in product((0, 1), repeat=BITS):
        chips = encode(bits, level).tolist()
        before = [level, *chips[1::2]]
        for bit, last, first, second in zip(bits, before, chips[::2], chips[1::2], strict=False):
            assert first != second
            assert (first != last) == (bit == 0)


@given(bits=bit_strings.filter(bool), level=levels, data=st.data())
def test_a_bit_that_loses_its_middle_transition_is_a_violation(
    bits: list[int], level: int, data: st.DataObject
) -> None:
    broken = data.draw(st.sets(st.integers(0, len(bits) - 1), min_size=1))
    chips = encode(bits, level)
    for bit in broken:
        chips[2 * bit + 1] = chips[2 * bit]
    assert decode(chips, level)[1] == sorted(broken)
