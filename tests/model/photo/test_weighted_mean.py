"""One value from several estimates: its error, whether they agree, and which are outliers."""

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from occ_model.photo.many.table import combine

_SIGMAS = st.lists(st.floats(1e-3, 1e3), min_size=1, max_size=20)


def test_no_estimates_have_no_mean() -> None:
    assert combine([], []) is None


def test_one_estimate_is_the_answer_with_its_error() -> None:
    found = combine([3.0], [0.5])
    assert (found.value, found.uncertainty, found.scale, found.agrees) == (3.0, 0.5, 1.0, True)


def test_mean_has_the_weights_of_inverse_variances() -> None:
    found = combine([1.0, 4.0], [1.0, 2.0])
    assert found.value == pytest.approx((1.0 + 4.0 / 4.0) / 1.25)
    chi_square = 0.6**2 + (2.4 / 2.0) ** 2
    assert found.chi_square == pytest.approx(chi_square)
    assert found.scale == pytest.approx(math.sqrt(chi_square))
    assert found.uncertainty == pytest.approx(math.sqrt(chi_square / 1.25))


@given(_SIGMAS, st.floats(0.1, 10.0), st.integers(0, 1000))
def test_a_change_of_unit_changes_nothing_else(sigmas: list[float], unit: float, seed: int) -> None:
    values = np.random.default_rng(seed).normal(5.0, sigmas)
    one, other = combine(values, sigmas), combine(values * unit, np.array(sigmas) * unit)
    assert other.value == pytest.approx(one.value * unit, rel=1e-9, abs=1e-9)
    assert other.uncertainty == pytest.approx(one.uncertainty * unit, rel=1e-6)
    assert other.outliers == one.outliers


def test_stated_error_of_right_estimates_holds() -> None:
    random = np.random.default_rng(2)
    within = 0
    for _ in range(700):
        sigma = np.exp(random.uniform(-2.0, 2.0, 12))
        found = combine(random.normal(7.0, sigma), sigma)
        within += abs(found.value - 7.0) <= found.uncertainty
    # It is on the safe side: the scatter does not prove that no error is shared.
    assert 0.68 < within / 700 < 0.9


def test_stated_error_holds_for_estimates_that_share_their_error() -> None:
    random = np.random.default_rng(6)
    within = 0
    for _ in range(700):
        shared, own = random.normal(0.0, 0.8), random.normal(0.0, 0.6, 12)
        found = combine(7.0 + shared + own, [1.0] * 12)
        within += abs(found.value - 7.0) <= found.uncertainty
    assert 0.63 < within / 700 < 0.78


def test_equal_estimates_are_together_as_sure_as_one() -> None:
    found = combine([5.0] * 9, [0.3] * 9)
    assert found.uncertainty == pytest.approx(0.3)


def test_right_estimates_seldom_disagree_or_are_outliers() -> None:
    random = np.random.default_rng(3)
    disagree = outliers = 0
    for _ in range(700):
        sigma = np.exp(random.uniform(-2.0, 2.0, 30))
        found = combine(random.normal(0.0, sigma), sigma)
        disagree += not found.agrees
        outliers += bool(found.outliers)
    assert disagree / 700 < 0.015
    assert outliers / 700 < 0.015


@pytest.mark.parametrize("sigma", [1e-4, 1e-2, 1.0])
def test_a_wrong_estimate_does_not_pull_however_sure(sigma: float) -> None:
    values = [*np.random.default_rng(4).normal(7.0, 0.1, 9), 30.0]
    found, without = combine(values, [0.1] * 9 + [sigma]), combine(values[:-1], [0.1] * 9)
    assert found.outliers == (9,)
    assert (found.value, found.uncertainty, found.count) == (without.value, without.uncertainty, 9)


def test_errors_that_are_all_too_small_widen_the_means() -> None:
    values = np.random.default_rng(5).normal(7.0, 1.0, 40)
    found = combine(values, [0.1] * 40)
    assert (found.outliers, found.agrees) == ((), False)
    assert found.scale == pytest.approx(10.0, rel=0.2)
    assert found.uncertainty == pytest.approx(1.0 / math.sqrt(40), rel=0.2)


def test_two_that_differ_are_both_kept_and_said_to_differ() -> None:
    found = combine([1.0, 9.0], [0.1, 0.1])
    assert (found.outliers, found.count, found.agrees) == ((), 2, False)
    assert found.uncertainty == pytest.approx(4.0)
