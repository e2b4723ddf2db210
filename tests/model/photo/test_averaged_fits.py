"""The mean over fits of several models weighs what is seen, and what is usual of a camera."""

import math

import numpy as np
import pytest

from occ_model.photo.fit.averaged_fits import averaged, distinct
from occ_model.photo.fit.joint_fit import JointFit


def fit(exposure: float, misfit: float, prior: float = 0.0, deviation: float = 0.01) -> JointFit:
    values, covariance = np.zeros(9), np.zeros((9, 9))
    values[:2] = 0.1, exposure
    covariance[1, 1] = deviation**2
    return JointFit(values, covariance, misfit, prior)


def test_two_models_that_are_as_likely_are_told_by_what_holds_both() -> None:
    """Half of the weight is off by their difference: its variance is half of its square."""
    mean = averaged([fit(1.0, 10.0), fit(1.4, 10.0)])
    assert mean.deviation == pytest.approx(math.hypot(0.01, 0.4 / math.sqrt(2.0)), rel=1e-6)


def test_what_a_model_leaves_unexplained_makes_the_data_tell_less() -> None:
    """The same excess, of a misfit of 20 and of one of 2000, of which 5 % are 100."""
    few = averaged([fit(1.0, 20.0), fit(1.4, 60.0)])
    many = averaged([fit(1.0, 2000.0), fit(1.4, 2040.0)])
    weight = 1.0 / (1.0 + math.exp(0.5 * 40.0 / 100.0))
    assert few.deviation == pytest.approx(0.01, rel=1e-3)
    assert many.deviation == pytest.approx(math.hypot(0.01, 0.4 * math.sqrt(weight)), rel=1e-3)


def test_an_unusual_camera_is_no_more_likely_where_the_data_tell_little() -> None:
    """What is usual is known before any photo: what the model lacks does not change it."""
    unusual = averaged([fit(1.0, 2000.0), fit(1.4, 2040.0, prior=40.0)])
    assert unusual.deviation == pytest.approx(0.01, rel=1e-3)


def test_a_fit_that_hardly_tells_the_step_is_no_fit() -> None:
    """A blur that is held too large leaves no exposure to fit, and a slope of nothing."""
    told, untold = fit(1.0, 10.0), fit(1.1, 10.0)
    told.covariance[0, 0], untold.covariance[0, 0] = 1e-6, 49.0
    assert averaged([told, untold]).covariance[0, 0] == pytest.approx(1e-6)


def test_starts_that_end_in_the_same_minimum_count_once() -> None:
    best, again, other = fit(1.0, 10.0), fit(1.004, 10.5), fit(1.4, 12.0)
    assert distinct([other, again, best]) == [best, other]


def test_explanations_of_pure_noise_are_weighted_by_their_likelihood() -> None:
    """Where the misfit is small, a difference of four is two standard deviations."""
    both = averaged([fit(0.5, 3.0, deviation=0.0), fit(0.6, 7.0, deviation=0.0)])
    share = math.exp(-2.0) / (1.0 + math.exp(-2.0))
    assert both.exposure == 0.5
    assert both.deviation == pytest.approx(0.1 * math.sqrt(share), rel=1e-6)


def test_a_fit_that_ended_at_a_bound_of_gamma_does_not_widen_the_others() -> None:
    """It has no slope there, and its covariance means nothing."""
    at_bound = fit(0.5, 320.0)
    at_bound.covariance[3, 3] = 1e8
    assert averaged([fit(0.5, 300.0), at_bound]).covariance[3, 3] == 0.0
