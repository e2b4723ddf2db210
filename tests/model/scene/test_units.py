"""Reading and writing quantities, and values with their standard deviations."""

import math
import re
from itertools import product

import pytest
from each_case import each_case
from hypothesis import assume, given, strategies as st

from occ_model.scene.units import HERTZ, LUX, METRE, NIT, NONE, RADIAN, SECOND, Unit

UNITS = (NONE, SECOND, HERTZ, METRE, RADIAN, LUX, NIT)

# Powers of ten, to write literals whose values Python itself determines.
POWERS = {"n": -9, "u": -6, "µ": -6, "\u03bc": -6, "m": -3, "c": -2, "k": 3, "M": 6, "G": 9}

exact_integers = st.integers(-(2**53), 2**53)
magnitudes = st.floats(1e-290, 1.7e308)


@given(unit=st.sampled_from(UNITS), size=magnitudes, sign=st.sampled_from((-1.0, 1.0)))
def test_a_value_written_with_17_digits_is_read_back(unit: Unit, size: float, sign: float) -> None:
    value = sign * size
    read = unit.parse(unit.format(value, 17))
    assert read == pytest.approx(value, rel=1e-15, abs=0.0)


@pytest.mark.parametrize("prefix", POWERS)
@given(
    number=exact_integers,
    unit=st.sampled_from((SECOND, HERTZ, METRE, LUX)),
    space=st.sampled_from(("", " ")),
)
def test_a_prefixed_whole_number_is_python_s_own_literal(
    prefix: str, number: int, unit: Unit, space: str
) -> None:
    read = unit.parse(f"{number}{space}{prefix}{unit.symbol}")
    assert read == float(f"{number}e{POWERS[prefix]}")


@given(above=exact_integers, below=exact_integers)
def test_a_fraction_is_python_s_own_quotient(above: int, below: int) -> None:
    assume(below != 0)
    assert SECOND.parse(f"{above}/{below} s") == above / below


@each_case(
    [
        (SECOND, "68us", 68e-6),
        (SECOND, "136 µs", 136e-6),
        (SECOND, "136 \u03bcs", 136e-6),
        (SECOND, "1/8000 s", 1 / 8000),
        (SECOND, "1/8000", 1 / 8000),
        (SECOND, " 1 / 8000 s ", 1 / 8000),
        (SECOND, "14.565us", 14.565e-6),
        (SECOND, "2 sec", 2.0),
        (SECOND, "1.5e-3", 1.5e-3),
        (HERTZ, "10kHz", 1e4),
        (HERTZ, "10k", 1e4),
        (HERTZ, "2.5 MHz", 2.5e6),
        (METRE, "5m", 5.0),
        (METRE, "5 mm", 5e-3),
        (METRE, "120cm", 1.2),
        (METRE, "-3 km", -3e3),
        (METRE, ".6", 0.6),
        (RADIAN, "0.5 rad", 0.5),
        (RADIAN, "500 mrad", 0.5),
        (RADIAN, "180°", math.pi),
        (RADIAN, "-180 deg", -math.pi),
        (NIT, "3600 cd/m2", 3600.0),
        (NIT, "3.6 kcd/m²", 3600.0),
        (NIT, "3600 nits", 3600.0),
        (NONE, "+12.5", 12.5),
    ]
)
def test_a_quantity_as_people_write_it_is_exactly_its_si_value(
    unit: Unit, text: str, value: float
) -> None:
    assert unit.parse(text) == value


@given(number=st.floats(-1e6, 1e6), plain=st.sampled_from((1e-6, 1e-3, 1e3)))
def test_only_a_number_without_a_unit_is_worth_the_plain_unit(number: float, plain: float) -> None:
    assert HERTZ.parse(f"{number!r}", plain) == pytest.approx(number * plain, rel=1e-15, abs=1e-320)
    assert HERTZ.parse(f"{number!r} Hz", plain) == number


# fmt: off
NONSENSE = (
    "", "  ", "1 2", "1 2 3", "1 V", "nan", "inf", "-inf", "infinity", "1/0", "1/0.0", "0/0", "/2",
    "1/", "1/2/3", "1,5,2", "1,", "1,.5", "1.5,2", "1,234.5", "1,000,000",
    "--1", "1e", "one", "0x10", "1_000", "1j", "s", "Hz", "°", "1V", "1kk",
)
# fmt: on


@each_case(NONSENSE)
def test_a_text_that_is_no_quantity_is_not_understood(text: str) -> None:
    for unit in UNITS:
        assert unit.parse(text) is None
        assert unit.parse(f"{text} {unit.symbol or '!'}") is None


@given(whole=st.integers(0, 10**9), decimals=st.from_regex(r"[0-9]{1,9}", fullmatch=True))
def test_a_comma_is_a_point_where_it_cannot_separate_thousands(whole: int, decimals: str) -> None:
    assume(len(decimals) != 3 or whole == 0 or whole > 999)
    for unit in UNITS:
        comma, point = f"{whole},{decimals} {unit.symbol}", f"{whole}.{decimals} {unit.symbol}"
        assert unit.parse(comma) == unit.parse(point) == float(f"{whole}.{decimals}")
        assert unit.parse(f",{decimals}") == float(f"0.{decimals}")


@given(first=st.integers(1, 999), last=st.integers(0, 999), sign=st.sampled_from(("", "-", "+")))
def test_a_comma_that_may_separate_thousands_has_two_meanings(
    first: int, last: int, sign: str
) -> None:
    text = f"{sign}{first},{last:03d}"
    decimal, thousands = float(text.replace(",", ".")), float(text.replace(",", ""))
    assert HERTZ.meanings(f"{text} Hz") == (decimal, thousands)
    assert HERTZ.parse(f"{text} Hz") is None
    assert SECOND.meanings(f"1/{text} s") == (1 / decimal, 1 / thousands)
    # Beside a decimal comma that cannot separate thousands.
    assert SECOND.meanings(f"0,5/{text} s") == (0.5 / decimal, 0.5 / thousands)


@pytest.mark.parametrize(
    "text",
    [f"1 k{' ' * 10**6}Hz", "1" * 10**6, " " * 10**6 + "1 Hz", f"1 {'k' * 10**6}"],
    ids=["spaces", "digits", "spaces before", "prefixes"],
)
def test_a_text_too_long_for_a_quantity_is_refused_at_once(text: str) -> None:
    for unit in UNITS:
        assert unit.parse(text) is None


@given(text=st.text(max_size=20), unit=st.sampled_from(UNITS))
def test_any_text_is_a_number_or_not_understood(text: str, unit: Unit) -> None:
    value = unit.parse(text)
    assert value is None or not math.isnan(value)
    assert value is None or any(character.isdecimal() for character in text)


@each_case(
    [
        (SECOND, 136e-6, "136 µs"),
        (SECOND, 1e-3, "1 ms"),
        (SECOND, 999e-6, "999 µs"),
        (SECOND, -0.25, "-250 ms"),
        (SECOND, 0.0, "0 s"),
        (SECOND, 120.0, "120 s"),
        (SECOND, 5e-11, "0.05 ns"),
        (HERTZ, 10e3, "10 kHz"),
        (HERTZ, 1e9, "1 GHz"),
        (HERTZ, 999.0, "999 Hz"),
        (HERTZ, 0.0, "0 Hz"),
        (METRE, 0.6, "0.6 m"),
        (METRE, 0.026, "26 mm"),
        (METRE, 2000.0, "2 km"),
        (METRE, math.nan, "nan m"),  # no prefix suits NaN
        (RADIAN, math.radians(30), "30°"),
        (RADIAN, 0.0, "0°"),
        (RADIAN, 1.5e308, "1.5e+308 rad"),  # in degrees it would be infinite
        (NIT, 3600.0, "3600 cd/m²"),
        (LUX, 290.0, "290 lx"),
        (NONE, 2.48, "2.48"),
    ]
)
def test_a_value_is_shown_in_the_unit_that_suits_its_size(
    unit: Unit, value: float, text: str
) -> None:
    assert unit.format(value) == text


@given(unit=st.sampled_from((SECOND, HERTZ)), exponent=st.floats(-9, 12))
def test_with_a_prefix_that_fits_the_number_is_from_1_to_1000(unit: Unit, exponent: float) -> None:
    value = 10.0**exponent
    assume(value < (1e3 if unit is SECOND else 1e12))
    assume(value >= (1e-9 if unit is SECOND else 1.0))
    symbol, factor = unit.display(value)
    assert symbol.endswith(unit.symbol)
    assert 1 - 1e-9 <= value / factor < 1000


@each_case(
    [
        (12.7933e-6, 0.0161e-6, "12.793 ± 0.016 µs"),
        (66.3425e-6, 24.9e-6, "66 ± 25 µs"),
        (141.173e-6, 3.81e-6, "141.2 ± 3.8 µs"),
        (8.90034e-6, 2e-9, "8.9003 ± 0.0020 µs"),
        (1.23e-6, 0.0996e-6, "1.23 ± 0.10 µs"),
        (5.4321e-3, 0.123e-6, "5.43210 ± 0.00012 ms"),
        (12e-9, 1234e-9, "0.0 ± 1.2 µs"),
        (68e-6, 68e-17, "68 µs ± 6.8e-07 ns"),
        (68e-6, 68e-19, "68 µs"),
        (0.0, 1e-300, "0 ns ± 1.0e-291 ns"),
        (68e-6, None, "68 µs"),
        (68e-6, 0.0, "68 µs"),
        (68e-6, math.inf, "68 µs"),
        (68e-6, math.nan, "68 µs"),
    ]
)
def test_two_digits_of_the_deviation_are_shown(
    value: float, deviation: float | None, text: str
) -> None:
    assert SECOND.format_estimate(value, deviation) == text


@each_case(product(range(-11, 13), (0.123, 0.9951, 9.96, 45.0)))
def test_an_error_has_two_digits_whatever_its_size(size: int, error: float) -> None:
    for unit in (SECOND, HERTZ, NONE):
        for value in (error * 10.0**size, 1.0):
            written = unit.format_estimate(value, error * 10.0**size)
            (digits,) = re.findall(r"± ([0-9.]+)", written)
            significant = digits.replace(".", "").lstrip("0")
            assert len(significant.rstrip("0")) <= 2 <= len(significant), written
            assert "." not in digits or len(significant) == 2


def test_hundreds_to_two_digits_have_no_exponent() -> None:
    assert SECOND.format(113e-6, 2) == "110 µs"
    assert NONE.format(-999.6, 3) == "-1000"
    assert NONE.format(2e6, 2) == "2e+06"


def test_a_pure_number_has_no_unit() -> None:
    assert NONE.format_estimate(2.2191, 0.03) == "2.219 ± 0.030"
    assert NONE.format_estimate(-0.001, 0.3) == "0.00 ± 0.30"  # no sign before zero


def test_a_rounded_estimate_is_the_number_written_and_moves_by_less_than_a_tenth() -> None:
    for value, deviation in ((8.00123e-6, 2.1e-9), (136.4567e-6, 4.4e-7), (6012.3, 99.0)):
        unit = SECOND if value < 1.0 else HERTZ
        rounded = unit.round_estimate(value, deviation)
        written = unit.format_estimate(value, deviation).split(" ± ", maxsplit=1)[0]
        assert float(unit.format(rounded).split(" ")[0]) == float(written)
        assert abs(rounded - value) <= 0.05 * deviation
    assert SECOND.round_estimate(1.23456789e-3, None) == 1.23456789e-3
