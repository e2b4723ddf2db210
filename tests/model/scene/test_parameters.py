"""The table of parameters, and their sliders."""

import re
from typing import Any

import pytest
from each_case import each_case
from hypothesis import given, strategies as st

from occ_model.errors import ParameterError
from occ_model.scene.parameter_kinds import Count, Parameter, Quantity
from occ_model.scene.parameters import PARAMETERS, parameter_named
from occ_model.scene.parameters.light import MAX_BITS

every_parameter = each_case(PARAMETERS.values())
QUANTITIES = [p for p in PARAMETERS.values() if isinstance(p, Quantity)]
every_quantity = each_case(QUANTITIES)
positions = st.floats(0.0, 1.0)


@every_parameter
def test_a_default_is_accepted_and_survives_being_written_and_read(parameter: Any) -> None:
    assert parameter.check(parameter.default) == parameter.default
    text = parameter.format(parameter.default)
    assert parameter.parse(text) == parameter.default


@every_quantity
def test_a_slider_lies_within_the_range_and_holds_the_default(quantity: Quantity) -> None:
    low, high = quantity.slider
    assert quantity.low <= low < high <= quantity.high
    assert low <= quantity.default <= high


@every_quantity
def test_a_slider_over_two_decades_or_more_is_logarithmic(quantity: Quantity) -> None:
    low, high = quantity.slider
    if low > 0 and high / low >= 100 * (1 - 1e-12):
        assert quantity.scale == "log"
    if low <= 0:
        assert quantity.scale == "linear"


@every_quantity
def test_the_ends_of_the_slider_are_the_ends_of_its_range(quantity: Quantity) -> None:
    assert (quantity.at(0.0), quantity.at(1.0)) == quantity.slider
    assert (quantity.fraction(quantity.slider[0]), quantity.fraction(quantity.slider[1])) == (0, 1)


@given(quantity=st.sampled_from(QUANTITIES), lower=positions, upper=positions)
def test_a_slider_further_up_never_gives_a_smaller_value(
    quantity: Quantity, lower: float, upper: float
) -> None:
    lower, upper = sorted((lower, upper))
    assert quantity.at(lower) <= quantity.at(upper)
    if upper - lower > 0.01:
        assert quantity.at(lower) < quantity.at(upper)


@given(quantity=st.sampled_from(QUANTITIES), position=positions)
def test_slider_position_and_value_are_inverse_to_four_digits(
    quantity: Quantity, position: float
) -> None:
    value = quantity.slider[0] + (quantity.slider[1] - quantity.slider[0]) * position
    assert quantity.at(quantity.fraction(value)) == pytest.approx(value, rel=6e-4, abs=1e-12)


@given(quantity=st.sampled_from(QUANTITIES), position=positions)
def test_a_slider_s_value_is_the_one_that_its_text_means(
    quantity: Quantity, position: float
) -> None:
    value = quantity.at(position)
    assert quantity.parse(quantity.format(value)) == value


@given(quantity=st.sampled_from(QUANTITIES), beyond=st.floats(0.0, 1e20))
def test_a_value_outside_the_slider_s_range_stands_at_its_end(
    quantity: Quantity, beyond: float
) -> None:
    assert quantity.fraction(quantity.slider[0] - beyond) == 0
    assert quantity.fraction(quantity.slider[1] + beyond) == 1


@every_quantity
def test_the_middle_of_a_slider_is_the_mean_on_its_scale(quantity: Quantity) -> None:
    low, high = quantity.slider
    middle = (low * high) ** 0.5 if quantity.scale == "log" else (low + high) / 2
    assert quantity.at(0.5) == pytest.approx(middle, rel=6e-4, abs=1e-12)


def test_a_code_may_have_all_the_bits_that_are_allowed() -> None:
    bits, code = PARAMETERS["bits"], PARAMETERS["code"]
    assert isinstance(bits, Count)
    assert isinstance(code, Count)
    assert bits.high == MAX_BITS
    assert (code.low, code.high) == (0, 2**bits.high - 1)


def test_every_parameter_is_declared_under_its_own_name() -> None:
    assert [p.name for p in PARAMETERS.values()] == list(PARAMETERS)


def test_no_two_parameters_share_a_label_or_a_symbol() -> None:
    labels = [p.label for p in PARAMETERS.values()]
    symbols = [p.symbol for p in PARAMETERS.values() if p.symbol]
    assert len(set(labels)) == len(labels)
    assert len(set(symbols)) == len(symbols)


@every_parameter
def test_a_meaning_is_one_sentence_on_one_line(parameter: Parameter) -> None:
    assert re.fullmatch(r"[A-Z][^\n]*[^.\s]\.", parameter.meaning)
    assert parameter.label.strip() == parameter.label != ""


def test_a_misspelt_name_is_answered_with_the_nearest() -> None:
    for name in PARAMETERS:
        with pytest.raises(ParameterError) as refused:
            parameter_named(f"{name}s")
        assert str(refused.value) == f"There is no parameter '{name}s'; did you mean {name}?"


@pytest.mark.parametrize("name", ["", "zzzz", "0", "?"])
def test_an_unknown_name_like_no_other_is_answered_with_all_names(name: str) -> None:
    with pytest.raises(ParameterError) as refused:
        parameter_named(name)
    assert str(refused.value) == (
        f"There is no parameter {name!r}; known are {', '.join(PARAMETERS)}."
    )


def test_a_parameter_is_found_only_among_the_names_asked_for() -> None:
    assert parameter_named("iso", ("iso", "gamma")) is PARAMETERS["iso"]
    with pytest.raises(ParameterError, match=r"^There is no parameter 'iso'; known are gamma\.$"):
        parameter_named("iso", ("gamma",))


@every_quantity
def test_limits_are_written_in_full_unless_that_is_unreadable(quantity: Quantity) -> None:
    limits = quantity.allowed.removeprefix("from ").split(" to ")
    for text, value in zip(limits, (quantity.low, quantity.high), strict=False):
        assert quantity.unit.parse(text) == pytest.approx(value, rel=1e-12)
        assert ("e+" in text) == (abs(value) >= 1e12)
