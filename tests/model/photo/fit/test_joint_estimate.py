"""What is left out of the profiles, and what is added to a fit's covariance, in closed forms."""

import math
from dataclasses import replace

import numpy as np
import pytest
from lit_fractions import light_of

from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.camera_response import CameraResponse, PixelResponse
from occ_model.photo.fit.joint_estimate import (
    refine_fits,
    rounding_error,
    widen_covariance,
    within_rims,
)
from occ_model.photo.fit.joint_fit import JointFit
from occ_model.photo.fit.least_squares import StripeModel
from occ_model.photo.fit.timing import Timing
from occ_model.photo.stripes.evenly_lit import Cells
from occ_model.results.decoding import Region
from occ_model.results.match import Stripes

RANDOM = np.random.default_rng(3)
PARTS = RANDOM.normal(size=(9, 9))
FIT = JointFit(np.array([0.1, 0.8, 3.0, 0.1, 0.0, 0.0, 0.0, 1.2, 0.0]), PARTS @ PARTS.T, 20.0, 2.0)


@pytest.mark.parametrize("unusual", [0.5, math.sqrt(6.0), 3.0 * math.sqrt(6.0)])
def test_an_unusual_camera_widens_all_but_the_step(unusual: float) -> None:
    """By the ratio to what six unknowns are usually off."""
    ratio = max(1.0, unusual / math.sqrt(6.0))
    wide = widen_covariance(FIT, unusual).covariance
    assert wide[0, 0] == FIT.covariance[0, 0]
    assert wide[0, 1:] == pytest.approx(ratio * FIT.covariance[0, 1:])
    assert wide[1:, 1:] == pytest.approx(ratio**2 * FIT.covariance[1:, 1:])


def test_levels_that_are_rounded_change_an_exposure_as_their_distance() -> None:
    """Each by one twelfth of a grey level squared; of many roundings all but one cancel."""
    flat = np.zeros(5)
    assert rounding_error(flat + 10.0, flat + 40.0) == pytest.approx(math.sqrt(2.0 / 12.0) / 40.0)
    varied = np.linspace(10.0, 14.0, 5)
    expected = math.hypot(1.0 / 4.0, 1.0 / 4.0) / math.sqrt(12.0) / 40.0
    assert rounding_error(varied, flat + 40.0) == pytest.approx(expected)
    assert rounding_error(flat, flat + 1e-9) == pytest.approx(math.sqrt(2.0 / 12.0))


COLUMNS = 400
NOISE = np.random.default_rng(3).normal(size=COLUMNS) ** 2
AT_RIM = np.concatenate([np.linspace(900.0, 0.0, 20), np.zeros(COLUMNS - 20)])


def test_columns_at_both_ends_that_no_level_follows_are_left_out() -> None:
    assert within_rims(NOISE).all()
    assert within_rims(NOISE[:10]).all()
    misfit = NOISE + AT_RIM
    misfit[-30:] += np.linspace(0.0, 8000.0, 30)
    misfit[150:160] += 400.0
    misfit[200:240] = np.nan
    shown = np.flatnonzero(within_rims(misfit))
    assert 16 <= shown[0] <= 32
    assert 400 - 48 <= shown[-1] + 1 <= 400 - 16
    np.testing.assert_array_equal(np.diff(shown), 1)


@pytest.mark.parametrize(("exposure", "contradicts"), [(0.6, False), (1.9, True)])
def test_what_pixels_that_are_lit_alike_contradict_is_the_exposure_alone(
    exposure: float, contradicts: bool
) -> None:
    """The first fits then stay, with their step."""
    chips = np.array([1, 0, 0, 1, 1, 0, 1, 0], dtype=np.uint8)
    first = Timing(0.09, 0.6, 20.7, 1.0)
    profile, other = (
        40.0 + 150.0 * light_of(chips, replace(first, exposure=each), COLUMNS)
        for each in (first.exposure, exposure)
    )
    camera = CameraResponse("light", "none", PixelResponse())
    model = StripeModel(profile, chips, camera.response, first.step)
    explanation = Explanation(chips, (model.describe(first, np.eye(4) * 1e-8),), camera)
    cells = Cells(
        np.tile(other, (8, 1)).astype(np.float32), np.zeros((8, COLUMNS), np.float32), 9.0
    )
    stripes = Stripes(Region(0, 72, 0, COLUMNS), profile, profile, profile, None, None, 0.0)
    found = refine_fits(stripes, cells, explanation, first.gamma)
    (fit,) = found.fits
    assert fit.timing.exposure == pytest.approx(0.6, abs=0.02)
    assert (fit.timing == first) == contradicts
    assert any("lit equally give another" in why for why in found.exposure_doubts) == contradicts
    assert not any("lit equally" in why for why in found.doubts)
