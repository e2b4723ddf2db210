"""The covariance of a joint fit, and the mean over fits of several models."""

import math

import numpy as np
import pytest

from occ_model.photo.fit.joint_fit import (
    CORRELATED_COLUMNS,
    JointFit,
    average_fits,
    covariance_of,
    keep_distinct,
)

DATA, PRIOR = 6400, 2
BLOCK = np.arange(DATA) // 16
RANDOM = np.random.default_rng(5)
SLOPES = np.vstack([RANDOM.normal(size=(DATA, 3)) @ np.diag([3.0, 1.0, 2.0]), np.eye(3)[:PRIOR]])
NOISE = np.append(RANDOM.normal(size=DATA), np.zeros(PRIOR))
INVERSE = np.linalg.inv(SLOPES.T @ SLOPES)


def test_mere_noise_leaves_the_inverse_of_the_information() -> None:
    """That of the step is smaller, as all columns count for it and not one in four."""
    found = covariance_of(SLOPES, 0.1 * NOISE, BLOCK)
    assert found[1:, 1:] == pytest.approx(INVERSE[1:, 1:], rel=1e-6)
    assert found[0, 0] == pytest.approx(INVERSE[0, 0] / CORRELATED_COLUMNS, rel=1e-6)


def test_what_is_alike_in_a_block_counts_once() -> None:
    """Of equal scores the variance of the sum is as many times larger as a block has columns."""
    alike = np.repeat(RANDOM.normal(size=DATA // 16), 16)
    slopes = SLOPES.copy()
    slopes[:DATA, 2] = np.repeat(RANDOM.normal(size=DATA // 16), 16)
    found = covariance_of(slopes, np.append(alike, np.zeros(PRIOR)), BLOCK)
    single = np.linalg.inv(slopes.T @ slopes)
    assert found[2, 2] / single[2, 2] == pytest.approx(16.0, rel=0.2)
    assert found[1, 1] / single[1, 1] == pytest.approx(1.0, rel=0.2)
    correlation = found[1, 2] / np.sqrt(found[1, 1] * found[2, 2])
    assert correlation == pytest.approx(single[1, 2] / np.sqrt(single[1, 1] * single[2, 2]))


def test_few_blocks_tell_less() -> None:
    """Of n blocks the sum is times n/(n-1)."""
    block = np.arange(DATA) // (DATA // 2)
    residual = np.append(np.where(SLOPES[:DATA, 1] > 0.0, 1.0, -1.0), np.zeros(PRIOR))
    scores = np.stack([np.bincount(block, SLOPES[:DATA, k] * residual[:DATA]) for k in range(3)])
    prior = SLOPES[DATA:].T @ SLOPES[DATA:]
    sandwich = INVERSE @ (scores @ scores.T + prior) @ INVERSE
    found = covariance_of(SLOPES, residual, block)
    assert found[1, 1] == pytest.approx(2.0 * sandwich[1, 1], rel=1e-6)


def fit(exposure: float, misfit: float, prior: float = 0.0, deviation: float = 0.01) -> JointFit:
    values, covariance = np.zeros(9), np.zeros((9, 9))
    values[:2] = 0.1, exposure
    covariance[1, 1] = deviation**2
    return JointFit(values, covariance, misfit, prior)


def test_the_deviation_of_two_models_that_are_as_likely_includes_both() -> None:
    """Half of the weight is off by their difference, whose square counts by half."""
    mean = average_fits([fit(1.0, 10.0), fit(1.4, 10.0)])
    assert mean.deviation == pytest.approx(math.hypot(0.01, 0.4 / math.sqrt(2.0)), rel=1e-6)


def test_what_a_model_leaves_unexplained_makes_the_data_tell_less() -> None:
    """The same excess, of a misfit of 20 and of one of 2000, of which 5 % are 100."""
    few = average_fits([fit(1.0, 20.0), fit(1.4, 60.0)])
    many = average_fits([fit(1.0, 2000.0), fit(1.4, 2040.0)])
    weight = 1.0 / (1.0 + math.exp(0.5 * 40.0 / 100.0))
    assert few.deviation == pytest.approx(0.01, rel=1e-3)
    assert many.deviation == pytest.approx(math.hypot(0.01, 0.4 * math.sqrt(weight)), rel=1e-3)


def test_an_unusual_camera_is_no_more_likely_where_the_data_tell_little() -> None:
    """Effects outside the model change the misfit of the data, but not that of the priors."""
    unusual = average_fits([fit(1.0, 2000.0), fit(1.4, 2040.0, prior=40.0)])
    assert unusual.deviation == pytest.approx(0.01, rel=1e-3)


def test_a_fit_that_hardly_tells_the_step_is_no_fit() -> None:
    """If the blur is too large, there is no exposure left to fit, and no slope over the step."""
    told, untold = fit(1.0, 10.0), fit(1.1, 10.0)
    told.covariance[0, 0], untold.covariance[0, 0] = 1e-6, 49.0
    assert average_fits([told, untold]).covariance[0, 0] == pytest.approx(1e-6)


def test_starts_that_end_in_the_same_minimum_count_once() -> None:
    best, again, other = fit(1.0, 10.0), fit(1.004, 10.5), fit(1.4, 12.0)
    assert keep_distinct([other, again, best]) == [best, other]


def test_explanations_of_pure_noise_are_weighted_by_their_likelihood() -> None:
    """Where the misfit is small, a difference of four is two standard deviations."""
    both = average_fits([fit(0.5, 3.0, deviation=0.0), fit(0.6, 7.0, deviation=0.0)])
    fraction = math.exp(-2.0) / (1.0 + math.exp(-2.0))
    assert both.exposure == 0.5
    assert both.deviation == pytest.approx(0.1 * math.sqrt(fraction), rel=1e-6)


def test_a_fit_that_ended_at_a_bound_of_gamma_does_not_widen_the_others() -> None:
    """The misfit has no minimum at a bound, so that gamma's covariance means nothing."""
    at_bound = fit(0.5, 320.0)
    at_bound.covariance[3, 3] = 1e8
    assert average_fits([fit(0.5, 300.0), at_bound]).covariance[3, 3] == 0.0
