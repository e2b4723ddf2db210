"""A value with its standard deviation has the digits that mean something."""

import math

import pytest

from occ_model.scene.units import SECOND, Unit

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
