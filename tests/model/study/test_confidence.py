"""Laws of the interval round a rate, against published values and higher precision."""

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from occ_model.study.confidence import interval_of_pictures, wilson_interval


@pytest.mark.parametrize(
    ("successes", "trials", "low", "high"),
    [
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ],
)
def test_intervals_are_the_published_ones(
    successes: int, trials: int, low: float, high: float
) -> None:
    """R. G. Newcombe, Statistics in Medicine 17:857 (1998), table I, method 3."""
    assert wilson_interval(successes, trials) == pytest.approx((low, high), abs=5e-5)


@pytest.mark.parametrize("trials", [10, 50, 500])
def test_the_intervals_hold_as_many_rates_as_their_level_says(trials: int) -> None:
    """Coverage averaged over all rates, by the binomial distribution itself."""
    rates = (np.arange(2000) + 0.5) / 2000
    held = np.zeros_like(rates)
    for successes in range(trials + 1):
        low, high = wilson_interval(successes, trials, 0.95)
        ways = math.lgamma(trials + 1) - math.lgamma(successes + 1)
        ways -= math.lgamma(trials - successes + 1)
        log = ways + successes * np.log(rates) + (trials - successes) * np.log1p(-rates)
        held += np.where((low <= rates) & (rates <= high), np.exp(log), 0.0)
    assert held.mean() == pytest.approx(0.95, abs=0.005)
    assert held.min() > 0.8


def test_numbers_of_other_types_are_numbers() -> None:
    others: list[tuple[Any, Any, Any]] = [
        (np.int32(3), np.uint8(10), np.float64(0.9)),
        (3, 10, Fraction(9, 10)),
    ]
    expected = wilson_interval(3, 10, 0.9)
    assert [wilson_interval(*numbers) for numbers in others] == [expected, expected]


@pytest.mark.parametrize("fraction", [0.02, 0.1, 0.37, 0.5, 0.8, 0.9, 0.95, 0.98])
def test_the_interval_of_pictures_holds_where_bits_of_a_picture_fail_together(
    fraction: float,
) -> None:
    random = np.random.default_rng(3)
    held = wide = 0
    for _ in range(800):
        whole = int(random.binomial(20, fraction))
        low, high = interval_of_pictures(10 * whole, 200, 20)
        held += low <= 100.0 * fraction <= high
        near, far = (100.0 * end for end in wilson_interval(10 * whole, 200))
        wide += near <= 100.0 * fraction <= far
    assert 0.90 <= held / 800 <= 0.995
    # Counted by bits it would not hold: the test's own power.
    assert wide / 800 < 0.9
    assert interval_of_pictures(200, 200, 20)[0] == pytest.approx(83.89, abs=0.01)
