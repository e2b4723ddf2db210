"""Steps over scaled parameters end at the least sum of squares, and no earlier."""

import math

import numpy as np
import pytest

from occ_model.photo.fit.damped_least_squares import minimized
from occ_model.photo.fit.scaled_parameters import ScaledParameters

A = np.random.default_rng(1).normal(size=(30, 3))
B = np.random.default_rng(2).normal(size=30) + A @ [3.0, -2.0, 1.0]


def test_a_linear_problem_has_its_closed_form() -> None:
    found, residual = minimized(lambda x: A @ x - B, lambda _: A, np.zeros(3), 12)
    assert found == pytest.approx(np.linalg.lstsq(A, B, rcond=None)[0], abs=1e-3)
    assert residual == pytest.approx(A @ found - B)


@pytest.mark.parametrize("fraction", [0.0, 1e-9])
def test_a_curved_valley_is_followed_to_its_end(fraction: float) -> None:
    """Rosenbrock's function, scaled so that the last steps gain a noise's variance."""

    def valley(x: np.ndarray) -> np.ndarray:
        return np.array([100.0 * (x[1] - x[0] ** 2), 10.0 * (1.0 - x[0])])

    def slopes(x: np.ndarray) -> np.ndarray:
        return np.array([[-200.0 * x[0], 100.0], [-10.0, 0.0]])

    found, residual = minimized(valley, slopes, np.array([-1.2, 1.0]), 100, fraction)
    assert found == pytest.approx([1.0, 1.0], abs=0.05)
    assert residual @ residual < 0.1


def test_a_step_that_overshoots_is_damped() -> None:
    """Where the slope is nearly flat the undamped step of an arc tangent leads away for ever."""
    found, residual = minimized(
        lambda x: 10.0 * np.arctan(x),
        lambda x: 10.0 / (1.0 + x[:, None] ** 2),
        np.array([3.0]),
        50,
    )
    assert abs(found[0]) < 0.02
    assert abs(residual[0]) < math.sqrt(0.05)


def test_a_fit_that_is_hopeless_ends_after_a_step() -> None:
    calls = [0]

    def arc(x: np.ndarray) -> np.ndarray:
        calls[0] += 1
        return A @ (np.arctan(x) - [0.6, -0.9, 0.3]) + 0.1 * B

    def slopes(x: np.ndarray) -> np.ndarray:
        return A / (1.0 + x**2)

    whole, residual = minimized(arc, slopes, np.zeros(3), 50)
    steps, calls[0] = calls[0], 0
    least = float(residual @ residual)
    begun, left = minimized(arc, slopes, np.zeros(3), 50, hopeless=0.9 * least)
    assert calls[0] == 2 < steps
    assert least < left @ left < arc(np.zeros(3)) @ arc(np.zeros(3))
    followed, _ = minimized(arc, slopes, np.zeros(3), 50, hopeless=1e9)
    assert followed.tolist() == whole.tolist() != begun.tolist()


FIRST = np.array([0.09, 0.6, 2.7, 0.1, 0.05, 0.2, -0.2, 0.9, 0.03])
SCALE = np.array([0.001, 0.02, 0.02, 0.12, 0.04, 0.25, 0.35, 0.5, 0.02])
GAMMA = (-0.5, 0.5)
ALL = np.arange(9)


def test_equal_changes_of_the_exposure_are_equal_ratios() -> None:
    scaled = ScaledParameters(FIRST, np.array([1]), SCALE, 0.09, GAMMA)
    ratios = [scaled.values(np.array([change]))[1] / 0.6 for change in (-3.0, 1.0, 3.0)]
    assert ratios[0] * ratios[2] == pytest.approx(1.0)
    assert ratios[2] == pytest.approx(ratios[1] ** 3)


@pytest.mark.parametrize("blur", [-2.5, -0.1, 0.4])
@pytest.mark.parametrize("seed", range(3))
def test_the_slopes_are_limits_of_differences(seed: int, blur: float) -> None:
    scaled = ScaledParameters(FIRST, ALL, SCALE, 0.09, GAMMA)
    here = np.random.default_rng(seed).normal(size=9)
    here[7] = blur
    steps = 1e-6 * np.eye(9)
    differences = [scaled.values(here + step) - scaled.values(here - step) for step in steps]
    assert np.diag(scaled.slopes(here)) == pytest.approx(np.array(differences) / 2e-6, abs=1e-6)


def test_beyond_a_bound_nothing_changes() -> None:
    scaled = ScaledParameters(FIRST, ALL, SCALE, 0.09, GAMMA)
    for sign in (-1.0, 1.0):
        far = sign * np.array([1e3, 1e3, 0.0, 1e3, 1e3, 1e3, 1e3, 1e3, 1e3])
        values = scaled.values(far)
        assert values == pytest.approx(scaled.values(1.1 * far))
        bounded = np.flatnonzero(scaled.slopes(far) == 0.0)
        # The exposure's upper bound is that of its change.
        assert bounded.tolist() == [0, 1, 3, 4, 5, 6, 7, 8]


def test_a_first_guess_beyond_a_bound_is_at_it() -> None:
    scaled = ScaledParameters(FIRST + 100.0 * SCALE, ALL, SCALE, 0.09, GAMMA)
    assert scaled.values(np.zeros(9))[0] == pytest.approx(0.18)
    assert scaled.values(np.zeros(9))[3] == pytest.approx(0.5)
    # From an upper bound differences would only lead out.
    assert not scaled.slopes(np.zeros(9))[[0, 3]].any()
