"""Levenberg's and Marquardt's steps end at the least sum of squares, and no earlier."""

import math

import numpy as np
import pytest

from occ_model.photo.fit.damped_least_squares import minimized

A = np.random.default_rng(1).normal(size=(30, 3))
B = np.random.default_rng(2).normal(size=30) + A @ [3.0, -2.0, 1.0]


def test_a_linear_problem_has_its_closed_form() -> None:
    found, residual, slopes = minimized(lambda x: A @ x - B, np.zeros(3), 12)
    assert found == pytest.approx(np.linalg.lstsq(A, B, rcond=None)[0], abs=1e-3)
    assert residual == pytest.approx(A @ found - B)
    assert slopes == pytest.approx(A, abs=1e-9)


@pytest.mark.parametrize("share", [0.0, 1e-9])
def test_a_curved_valley_is_followed_to_its_end(share: float) -> None:
    """Rosenbrock's function, scaled so that the last steps gain a noise's variance."""

    def valley(x: np.ndarray) -> np.ndarray:
        return np.array([100.0 * (x[1] - x[0] ** 2), 10.0 * (1.0 - x[0])])

    found, residual, slopes = minimized(valley, np.array([-1.2, 1.0]), 100, share)
    assert found == pytest.approx([1.0, 1.0], abs=0.05)
    assert residual @ residual < 0.1
    assert slopes[:, 1] == pytest.approx([100.0, 0.0])


def test_a_step_that_overshoots_is_damped() -> None:
    """Where the slope is nearly flat the undamped step of an arc tangent leads away for ever."""
    found, residual, _ = minimized(lambda x: 10.0 * np.arctan(x), np.array([3.0]), 50)
    assert abs(found[0]) < 0.02
    assert abs(residual[0]) < math.sqrt(0.05)


def test_it_never_ends_worse_than_it_began() -> None:
    start = np.array([0.3, -0.2])

    def rough(x: np.ndarray) -> np.ndarray:
        return np.array([np.sin(40.0 * x[0]), np.cos(35.0 * x[1]), x.sum()])

    _, residual, _ = minimized(rough, start, 8)
    assert residual @ residual <= rough(start) @ rough(start)


def test_it_takes_no_more_steps_than_allowed_and_none_that_gains_nothing() -> None:
    calls = [0]

    def counted(x: np.ndarray) -> np.ndarray:
        calls[0] += 1
        return A @ x - B

    best: np.ndarray = np.linalg.lstsq(A, B, rcond=None)[0]
    minimized(counted, best, 100)
    assert calls[0] <= 1 + 3 + 6 + 3
    calls[0] = 0
    found, _, _ = minimized(counted, np.zeros(3), 0)
    assert found.tolist() == [0.0, 0.0, 0.0]
    assert calls[0] == 1 + 3


def test_slopes_that_are_given_lead_to_the_same_without_differences() -> None:
    calls = [0]

    def arc(x: np.ndarray) -> np.ndarray:
        calls[0] += 1
        return A @ (np.arctan(x) - [0.6, -0.9, 0.3]) + 0.1 * B

    differences = minimized(arc, np.zeros(3), 50)
    with_differences, calls[0] = calls[0], 0
    given = minimized(arc, np.zeros(3), 50, slopes=lambda x: A / (1.0 + x**2))
    assert given[0] == pytest.approx(differences[0], abs=1e-2)
    assert given[2] == pytest.approx(A / (1.0 + given[0] ** 2))
    assert calls[0] < 0.5 * with_differences
