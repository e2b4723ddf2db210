"""A value with its standard deviation has the digits that mean something."""

import math
import re

import pytest

from occ_model.scene.units import HERTZ, SECOND, Unit

PLAIN = Unit("")


@pytest.mark.parametrize(
    ("value", "deviation", "text"),
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
    ],
)
def test_two_digits_of_the_deviation_are_shown(
    value: float, deviation: float | None, text: str
) -> None:
    assert SECOND.format_estimate(value, deviation) == text


@pytest.mark.parametrize("size", range(-11, 13))
@pytest.mark.parametrize("error", [0.123, 0.9951, 9.96, 45.0])
def test_an_error_has_two_digits_whatever_its_size(size: int, error: float) -> None:
    for unit in (SECOND, HERTZ, PLAIN):
        for value in (error * 10.0**size, 1.0):
            written = unit.format_estimate(value, error * 10.0**size)
            (digits,) = re.findall(r"± ([0-9.]+)", written)
            significant = digits.replace(".", "").lstrip("0")
            assert len(significant.rstrip("0")) <= 2 <= len(significant), written
            assert "." not in digits or len(significant) == 2


def test_a_frequency_of_ten_digits_has_an_error_that_can_be_read() -> None:
    text = HERTZ.format_estimate(10000.0000001, 8e-6)
    assert text == "10.0000000001 kHz ± 8.0e-06 Hz"


def test_a_pure_number_has_no_unit() -> None:
    assert PLAIN.format_estimate(2.2191, 0.03) == "2.219 ± 0.030"
    assert PLAIN.format_estimate(-0.001, 0.3) == "0.00 ± 0.30"  # no sign before nothing


def test_a_rounded_estimate_is_what_is_written_of_it_and_moves_by_less_than_a_tenth() -> None:
    for value, deviation in ((8.00123e-6, 2.1e-9), (136.4567e-6, 4.4e-7), (6012.3, 99.0)):
        unit = SECOND if value < 1.0 else HERTZ
        rounded = unit.rounded_estimate(value, deviation)
        written = unit.format_estimate(value, deviation).split(" ± ", maxsplit=1)[0]
        assert float(unit.format(rounded).split(" ")[0]) == float(written)
        assert abs(rounded - value) <= 0.05 * deviation
    assert SECOND.rounded_estimate(1.23456789e-3, None) == 1.23456789e-3
