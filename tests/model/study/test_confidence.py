"""Laws of the interval round a rate, against published values and higher precision."""

import math
from fractions import Fraction
from statistics import NormalDist
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occ_model.study.confidence import interval_of_pictures, wilson_interval

LEVELS = st.floats(1e-6, 1 - 1e-12)


@st.composite
def counts(draw: st.DrawFn) -> tuple[int, int]:
    trials = draw(st.integers(1, 10**6) | st.integers(1, 2**53))
    return draw(st.integers(0, trials) | st.integers(0, min(trials, 5))), trials


def by_definition(successes: int, trials: int, level: float) -> tuple[mpmath.mpf, mpmath.mpf]:
    """Where (s - n p)^2 = z^2 n p (1 - p), solved with fifty digits."""
    with mpmath.workdps(50):
        z = mpmath.sqrt(2) * mpmath.erfinv(mpmath.mpf(level))
        s, n = mpmath.mpf(successes), mpmath.mpf(trials)
        a, b, c = n + z**2, -(2 * s + z**2), s**2 / n
        root = mpmath.sqrt(b**2 - 4 * a * c)
        return (-b - root) / (2 * a), (-b + root) / (2 * a)


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


@given(count=counts(), level=LEVELS)
def test_the_ends_solve_wilsons_equation(count: tuple[int, int], level: float) -> None:
    low, high = wilson_interval(*count, level)
    expected = by_definition(*count, level)
    assert low == pytest.approx(float(expected[0]), rel=1e-9, abs=0)
    assert high == pytest.approx(float(expected[1]), rel=1e-9, abs=0)


@given(count=counts(), level=LEVELS)
def test_failures_have_the_interval_of_successes_turned_round(
    count: tuple[int, int], level: float
) -> None:
    successes, trials = count
    low, high = wilson_interval(successes, trials, level)
    turned = wilson_interval(trials - successes, trials, level)
    assert (1 - high, 1 - low) == pytest.approx(turned, rel=0, abs=4e-16)


@given(count=counts(), level=LEVELS)
def test_the_interval_lies_round_the_rate_and_within_0_to_1(
    count: tuple[int, int], level: float
) -> None:
    successes, trials = count
    low, high = wilson_interval(successes, trials, level)
    rate = successes / trials
    assert 0.0 <= low <= rate * (1 + 1e-15)
    assert rate * (1 - 1e-15) <= high <= 1.0


@given(trials=st.integers(1, 2**53), level=LEVELS)
def test_no_success_and_no_failure_have_closed_forms(trials: int, level: float) -> None:
    square = NormalDist().inv_cdf((1 - level) / 2) ** 2
    none, every = wilson_interval(0, trials, level), wilson_interval(trials, trials, level)
    assert none[0] == 0.0
    assert every[1] == 1.0
    assert none[1] == pytest.approx(square / (trials + square), rel=1e-14, abs=0)
    assert every[0] == pytest.approx(trials / (trials + square), rel=1e-14, abs=0)


@given(count=counts(), levels=st.lists(LEVELS, min_size=2, max_size=2, unique=True))
def test_a_surer_interval_is_no_narrower(count: tuple[int, int], levels: list[float]) -> None:
    less, more = (wilson_interval(*count, level) for level in sorted(levels))
    assert more[0] <= less[0] * (1 + 1e-14)
    assert more[1] >= less[1] * (1 - 1e-14)


def test_a_rate_of_0_or_100_percent_is_always_covered() -> None:
    for trials in (1, 5, 50, 10**6):
        assert wilson_interval(0, trials)[0] == 0.0
        assert wilson_interval(trials, trials)[1] == 1.0


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


def test_a_level_next_to_1_keeps_its_digits() -> None:
    level = math.nextafter(1.0, 0.0)
    assert wilson_interval(7, 9, level) == pytest.approx(
        tuple(map(float, by_definition(7, 9, level))), rel=1e-9
    )


@pytest.mark.parametrize("share", [0.02, 0.1, 0.37, 0.5, 0.8, 0.9, 0.95, 0.98])
def test_the_interval_of_pictures_holds_where_bits_of_a_picture_fail_together(share: float) -> None:
    random = np.random.default_rng(3)
    held = wide = 0
    for _ in range(800):
        whole = int(random.binomial(20, share))
        low, high = interval_of_pictures(10 * whole, 200, 20)
        held += low <= 100.0 * share <= high
        near, far = (100.0 * end for end in wilson_interval(10 * whole, 200))
        wide += near <= 100.0 * share <= far
    assert 0.90 <= held / 800 <= 0.995
    # Counted by bits it would not hold: the test's own power.
    assert wide / 800 < 0.9
    assert interval_of_pictures(200, 200, 20)[0] == pytest.approx(83.89, abs=0.01)
