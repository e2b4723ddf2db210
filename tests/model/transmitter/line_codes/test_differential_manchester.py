"""Differential Manchester."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occ_model.transmitter.line_codes.differential_manchester import decode, encode

BITS = 10

every_level = pytest.mark.parametrize("level", [0, 1])
levels = st.integers(0, 1)
bit_strings = st.lists(st.integers(0, 1), max_size=40)


@every_level
def test_every_bit_changes_in_its_middle_and_a_zero_at_its_start(level: int) -> None:
    for bits in product((0, 1), repeat=BITS):
        chips = encode(bits, level).tolist()
        before = [level, *chips[1::2]]
        for bit, last, first, second in zip(bits, before, chips[::2], chips[1::2], strict=False):
            assert first != second
            assert (first != last) == (bit == 0)


@pytest.mark.parametrize(
    ("bits", "level", "chips"),
    [
        ([0, 0, 0], 0, [1, 0, 1, 0, 1, 0]),
        ([1, 1, 1], 0, [0, 1, 1, 0, 0, 1]),
        ([1, 0, 1, 1], 0, [0, 1, 0, 1, 1, 0, 0, 1]),
        ([0, 1], 1, [0, 1, 1, 0]),
        ([], 1, []),
    ],
)
def test_the_convention_is_that_of_ieee_802_5(
    bits: list[int], level: int, chips: list[int]
) -> None:
    assert encode(bits, level).tolist() == chips


@every_level
def test_many_codes_are_turned_into_chips_as_each_by_itself(level: int) -> None:
    many = list(product((0, 1), repeat=4))
    np.testing.assert_array_equal(encode(many, level), [encode(bits, level) for bits in many])


@given(bits=bit_strings, level=levels)
def test_the_other_level_before_turns_every_chip_round(bits: list[int], level: int) -> None:
    np.testing.assert_array_equal(encode(bits, level) ^ 1, encode(bits, 1 - level))


@given(bits=bit_strings.filter(bool), level=levels, data=st.data())
def test_a_bit_that_loses_its_middle_transition_is_a_violation(
    bits: list[int], level: int, data: st.DataObject
) -> None:
    broken = data.draw(st.sets(st.integers(0, len(bits) - 1), min_size=1))
    chips = encode(bits, level)
    for bit in broken:
        chips[2 * bit + 1] = chips[2 * bit]
    assert decode(chips, level)[1] == sorted(broken)
