"""Damped steps end at the least sum of squares within bounds, and no earlier."""

import math

import numpy as np
import pytest

from occ_model.photo.fit.damped_least_squares import Bounds, minimize_squares

A = np.random.default_rng(1).normal(size=(30, 3))
B = np.random.default_rng(2).normal(size=30) + A @ [3.0, -2.0, 1.0]


def test_a_linear_problem_has_its_closed_form() -> None:
    found, residual = minimize_squares(lambda x: A @ x - B, lambda _: A, np.zeros(3), 12)
    assert found == pytest.approx(np.linalg.lstsq(A, B, rcond=None)[0], abs=1e-3)
    assert residual == pytest.approx(A @ found - B)


@pytest.mark.parametrize("fraction", [0.0, 1e-9])
def test_a_curved_valley_is_followed_to_its_end(fraction: float) -> None:
    """Rosenbrock's function, scaled so that the last steps gain a noise's variance."""

    def valley(x: np.ndarray) -> np.ndarray:
        return np.array([100.0 * (x[1] - x[0] ** 2), 10.0 * (1.0 - x[0])])

    def slopes(x: np.ndarray) -> np.ndarray:
        return np.array([[-200.0 * x[0], 100.0], [-10.0, 0.0]])

    found, residual = minimize_squares(
        valley, slopes, np.array([-1.2, 1.0]), 100, fraction=fraction
    )
    assert found == pytest.approx([1.0, 1.0], abs=0.05)
    assert residual @ residual < 0.1


def test_a_step_that_overshoots_is_damped() -> None:
    """Where the slope is nearly flat the undamped step of an arc tangent leads away for ever."""
    found, residual = minimize_squares(
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

    whole, residual = minimize_squares(arc, slopes, np.zeros(3), 50)
    steps, calls[0] = calls[0], 0
    least = float(residual @ residual)
    begun, left = minimize_squares(arc, slopes, np.zeros(3), 50, hopeless=0.9 * least)
    assert calls[0] == 2 < steps
    assert least < left @ left < arc(np.zeros(3)) @ arc(np.zeros(3))
    followed, _ = minimize_squares(arc, slopes, np.zeros(3), 50, hopeless=1e9)
    assert followed.tolist() == whole.tolist() != begun.tolist()


@pytest.mark.parametrize("most", [np.inf, 0.2])
def test_steps_end_within_bounds_and_are_no_longer_than_is_allowed(most: float) -> None:
    """Of two numbers one ends at its bound, which the least sum is beyond."""
    low, high, least = np.array([[-1.0, -4.0], [1.0, 4.0], [3.0, -2.5]])
    places = []

    def residual(x: np.ndarray) -> np.ndarray:
        places.append(x)
        return 3.0 * (x - least)

    found, _ = minimize_squares(
        residual, lambda _: 3.0 * np.eye(2), np.zeros(2), 50, bounds=Bounds(low, high, most)
    )
    assert found == pytest.approx([1.0, -2.5], abs=0.02)
    assert np.abs(np.diff(places, axis=0)).max() <= most + 1e-12
    assert ((low <= places) & (places <= high)).all()
