"""A value with its standard deviation has the digits that mean something."""

import math

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
        (68e-6, None, "68 µs"),
        (68e-6, 0.0, "68 µs"),
        (68e-6, math.inf, "68 µs"),
    ],
)
def test_two_digits_of_the_deviation_are_shown(
    value: float, deviation: float | None, text: str
) -> None:
    assert SECOND.format_estimate(value, deviation) == text


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
