"""Pixels that are lit equally are fitted together, and explanations that are alike are averaged."""

import math

import numpy as np
import pytest
from photo_world.photograph import random_world
from photo_world.trials import trial

from occ_model.photo.fit.averaged_fits import averaged
from occ_model.photo.fit.joint_fit import JointFit
from occ_model.photo.stripes.evenly_lit import Cells

ROWS_A_BAND = 4.0
STRIPES = np.tile(np.repeat([0.1, 1.0], 12), 10).astype(np.float32)


def cells_of(brightness: np.ndarray) -> Cells:
    """Return bands of rows that see the same stripes, each as bright as is said; 255 is white."""
    means = np.minimum(brightness[:, None] * STRIPES, 255.0).astype(np.float32)
    return Cells(means, (means >= 255.0).astype(np.float32), ROWS_A_BAND)


def test_many_rows_are_fitted_before_few_whose_noise_is_not_averaged_out() -> None:
    """A lamp of which most rows are partly white, with a rim that fades within five bands."""
    rim = np.array([60.0, 100.0, 150.0, 190.0, 220.0])
    lamp = np.linspace(300.0, 500.0, 59)
    profiles = cells_of(np.concatenate([rim, lamp])).profiles(24)
    assert sum(profile.rows >= 25 * ROWS_A_BAND for profile in profiles) == 2
    # The rim's rows see all columns; what they tell is still less.
    assert max(profile.kept.sum() for profile in profiles) == len(STRIPES)


def fit_of(exposure: float, misfit: float, deviation: float = 0.01) -> JointFit:
    """Return a fit of an exposure in chips."""
    values, covariance = np.zeros(9), np.zeros((9, 9))
    values[1], covariance[1, 1] = exposure, deviation**2
    return JointFit(values, covariance, misfit)


@pytest.mark.parametrize("misfit", [200.0, 400.0])
def test_explanations_that_fit_nearly_alike_are_all_within_the_stated_error(misfit: float) -> None:
    """Misfits that differ by a twentieth do not tell which blur it is."""
    both = averaged([fit_of(0.5, misfit), fit_of(0.6, 1.05 * misfit)])
    assert both.exposure == 0.5
    assert 0.03 < both.deviation < 0.1


def test_an_explanation_that_fits_far_worse_says_nothing() -> None:
    best = averaged([fit_of(0.5, 300.0), fit_of(0.9, 1500.0)])
    assert best.deviation == pytest.approx(0.01, rel=0.01)


def test_explanations_of_pure_noise_are_weighted_by_their_likelihood() -> None:
    """Where the misfit is small, a difference of four is two standard deviations."""
    both = averaged([fit_of(0.5, 3.0, 0.0), fit_of(0.6, 7.0, 0.0)])
    share = np.exp(-2.0) / (1.0 + np.exp(-2.0))
    assert both.deviation == pytest.approx(0.1 * np.sqrt(share), rel=1e-6)


def test_a_fit_that_ended_at_a_bound_of_gamma_does_not_widen_the_others() -> None:
    """It has no slope there, and its covariance means nothing."""
    at_bound = fit_of(0.5, 320.0)
    at_bound.covariance[3, 3] = 1e8
    assert averaged([fit_of(0.5, 300.0), at_bound]).covariance[3, 3] == 0.0


@pytest.mark.whole
@pytest.mark.parametrize(("seed", "holds_both"), [(121020, True), (130011, False)])
def test_an_exposure_that_looks_like_a_box_of_blur_is_within_its_stated_error(
    seed: int, holds_both: bool
) -> None:
    """Exposed for a column behind a box of three or five: exchanged, they make the same edges.

    Of the second one the fit by the exchanged ones is worse, and only the right one is stated.
    """
    world = random_world(seed)
    found = trial(world)
    assert not found.failure
    assert abs(found.exposure) < 2.0 * found.exposure_deviation
    columns, box = world.exposure_time / world.readout_time, math.sqrt(12.0) * world.blur
    off_box = found.exposure - (box / columns - 1.0)
    assert (abs(off_box) < 2.0 * found.exposure_deviation) == holds_both
    # An edge's variance is that of the exposure, t^2/12, and the blur's, known to 2 % at best.
    assert found.exposure_deviation > 6.0 * 0.02 * world.blur**2 / columns**2


@pytest.mark.parametrize("seed", [93017, pytest.param(93030, marks=pytest.mark.whole)])
def test_what_pixels_that_are_lit_alike_contradict_is_the_exposure_alone(seed: int) -> None:
    """Twice as long as the right one, at the right readout time."""
    found = trial(random_world(seed))
    assert found.is_sure
    assert abs(found.readout) < 2.0 * found.readout_deviation
    assert any("lit equally give another exposure" in why for why in found.exposure_doubts)
    assert not found.is_sure_of("exposure")
