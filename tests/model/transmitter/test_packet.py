"""The packet, and the sequence when it is sent repeatedly."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

import occ_model as occ
from occ_model.scene.parameters.light import MAX_BITS
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import bits_of, code_of, packet_length, sent_chips

BITS = 10
CODES = range(2**BITS)


def send_code(code: int) -> list[int]:
    return occ.packet(Scene().replace(code=code)).tolist()


def canonical_rotation(chips: list[int]) -> bytes:
    """Return the smallest rotation of a period, which identifies the endless sequence."""
    twice = bytes(chips) * 2
    return min(twice[start : start + len(chips)] for start in range(len(chips)))


@given(bits=st.integers(1, MAX_BITS), data=st.data())
def test_a_code_is_its_bits_with_the_most_significant_first(bits: int, data: st.DataObject) -> None:
    code = data.draw(st.integers(0, 2**bits - 1))
    written = bits_of(code, bits)
    assert "".join(map(str, written)) == f"{code:0{bits}b}"
    assert code_of(written) == code
    assert code_of(np.array(written, dtype=np.uint8)) == code


@pytest.mark.parametrize("bits", [2, 3, BITS, MAX_BITS])
def test_a_packet_is_four_chips_and_two_a_bit(bits: int) -> None:
    scene = Scene().replace(bits=bits, code=2**bits - 1)
    assert len(occ.packet(scene)) == packet_length(bits) == 4 + 2 * bits


def test_the_packet_of_a_known_code() -> None:
    by_hand = "1110 01 01 10 01 01 01 10 01 10 10"
    assert "".join(map(str, send_code(0b1011001110))) == by_hand.replace(" ", "")


def test_no_two_codes_make_the_same_endless_sequence() -> None:
    assert len({canonical_rotation(send_code(code)) for code in CODES}) == len(CODES)


def test_three_ones_in_a_row_are_only_in_the_header() -> None:
    for code in CODES:
        chips = send_code(code)
        twice = chips * 2
        threes = {start for start in range(24) if twice[start : start + 3] == [1, 1, 1]}
        assert threes == ({0, 23} if chips[-1] else {0})


@given(pattern=st.text("01", min_size=1, max_size=60), code=st.sampled_from(CODES))
def test_a_raw_pattern_is_sent_as_it_is_whatever_the_code(pattern: str, code: int) -> None:
    chips = occ.packet(Scene().replace(pattern=pattern, code=code))
    assert chips.dtype == np.uint8
    assert "".join(map(str, chips)) == pattern


@pytest.mark.parametrize("pattern", ["", "0110"])
def test_the_chips_sent_are_read_only(pattern: str) -> None:
    scene = Scene().replace(pattern=pattern)
    for chips in (occ.packet(scene), sent_chips(scene.transmitter)):
        before = chips.tolist()
        with pytest.raises(ValueError, match="read-only"):
            chips[0] = 0
        assert occ.packet(scene).tolist() == before
