"""How each kind of parameter checks, reads and writes its values."""

import math
from fractions import Fraction

import numpy as np
import pytest
from each_case import each_case
from hypothesis import given, strategies as st

from occ_model.errors import ParameterError
from occ_model.scene.parameter_kinds import (
    MAX_PATTERN_CHIPS,
    ChipPattern,
    Choice,
    Count,
    Parameter,
    Quantity,
)
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.units import SECOND

QUANTITIES = [p for p in PARAMETERS.values() if isinstance(p, Quantity)]
COUNTS = [p for p in PARAMETERS.values() if isinstance(p, Count)]
CHOICES = [p for p in PARAMETERS.values() if isinstance(p, Choice)]
PATTERN = ChipPattern("pattern", "Pattern", "", "Chips.", "")

every_quantity = each_case(QUANTITIES)
every_count = each_case(COUNTS)
every_choice = each_case(CHOICES)

NO_NUMBERS = [True, False, None, "1", b"1", 1j, [1.0], np.array([1.0]), np.True_, {"x": 1}]


@given(quantity=st.sampled_from(QUANTITIES), data=st.data())
def test_a_quantity_accepts_every_number_in_its_range_unchanged(
    quantity: Quantity, data: st.DataObject
) -> None:
    value = data.draw(st.floats(quantity.low, quantity.high))
    for number in (value, np.float64(value), Fraction(value)):
        checked = quantity.check(number)
        assert type(checked) is float
        assert checked == value


@every_quantity
def test_a_quantity_refuses_all_but_numbers(quantity: Quantity) -> None:
    for value in NO_NUMBERS:
        with pytest.raises(ParameterError) as refused:
            quantity.check(value)
        assert str(refused.value) == (
            f"{quantity.name} is {value!r}, which is not a number; allowed: {quantity.allowed}."
        )


def test_a_comma_of_two_meanings_is_refused_with_both() -> None:
    quantity = Quantity("t", "T", "t", "A time.", SECOND, 1e-9, 1.0, (1e-6, 1e-3), "log", 136e-6)
    with pytest.raises(ParameterError, match=r"'1,250 us', .* 1\.25 µs .* 1\.25 ms .*; allowed: "):
        quantity.parse("1,250 us")
    assert quantity.parse("0,136 ms") == quantity.parse("136 us")


every_declaration = each_case(PARAMETERS.values())


@every_declaration
def test_a_long_text_is_refused_in_a_short_line(declaration: Parameter) -> None:
    for piece in ("7", " x", "a\nb", "\0"):
        with pytest.raises(ParameterError) as refused:
            declaration.parse(piece * 10**5)
        assert len(str(refused.value)) < 400
        assert "\n" not in str(refused.value)


@every_declaration
def test_a_number_too_large_for_a_float_is_refused(declaration: Parameter) -> None:
    for large in (10**400, 10**5000):  # larger than a float holds, and than Python prints
        for number in (large, Fraction(large), Fraction(-large), Fraction(large, 3)):
            with pytest.raises(ParameterError, match=rf"^{declaration.name} is .*; allowed: "):
                declaration.check(number)


@given(count=st.sampled_from(COUNTS), data=st.data())
def test_a_count_accepts_whole_numbers_of_any_type_in_range(
    count: Count, data: st.DataObject
) -> None:
    value = data.draw(st.integers(count.low, count.high))
    for number in (value, float(value), np.int64(value), np.float64(value)):
        checked = count.check(number)
        assert type(checked) is int
        assert checked == value
    texts = (f"{value}", f" {value} ", f"{value:09}", hex(value), bin(value), count.format(value))
    for text in texts:
        assert count.parse(text) == value


@every_count
def test_a_count_refuses_all_but_whole_numbers_in_its_range(count: Count) -> None:
    for value in (1.5, math.nan, math.inf, -math.inf, count.low - 1, count.high + 1, *NO_NUMBERS):
        with pytest.raises(ParameterError) as refused:
            count.check(value)
        assert str(refused.value) == f"{count.name} is {value!r}; allowed: {count.allowed}."
    assert count.allowed == f"a whole number from {count.low} to {count.high}"


@every_choice
def test_a_choice_accepts_its_words_and_nothing_else(choice: Choice) -> None:
    assert [choice.parse(f" {word} ") for word in choice.choices] == list(choice.choices)
    for value in ("", "x", choice.choices[0].upper(), 0, None, choice.choices[:2]):
        with pytest.raises(ParameterError) as refused:
            choice.check(value)
        assert str(refused.value) == (
            f"{choice.name} is {value!r}; allowed: {', '.join(choice.choices)}."
        )


@given(pattern=st.text("01", max_size=64))
def test_a_pattern_is_read_with_or_without_spaces(pattern: str) -> None:
    assert PATTERN.check(pattern) == pattern
    assert PATTERN.parse(" ".join(pattern)) == pattern


@pytest.mark.parametrize("value", ["012", "1 0", "\u0661", 101, None, b"01", ["0", "1"]], ids=repr)
def test_a_pattern_refuses_all_but_zeros_and_ones(value: object) -> None:
    with pytest.raises(ParameterError, match=r"^pattern is .*; allowed: nothing, or up to 4096 "):
        PATTERN.check(value)


def test_a_pattern_is_as_long_as_allowed_and_no_longer() -> None:
    longest = "01" * (MAX_PATTERN_CHIPS // 2)
    assert PATTERN.check(longest) == longest
    with pytest.raises(ParameterError, match=f"^pattern has {MAX_PATTERN_CHIPS + 1} chips; "):
        PATTERN.check(longest + "0")
