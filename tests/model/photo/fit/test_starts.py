"""From where a fit of the timing starts."""

import math

import numpy as np
import pytest
from lit_fractions import light_of
from simulated_photos import photo_of

import occ_model as occ
from occ_model.photo.fit.camera_response import camera_responses
from occ_model.photo.fit.initial_search import TimingSearch
from occ_model.photo.fit.timing import Timing

CHIPS = np.array([1, 0, 0, 1, 1, 0, 1, 0, 1, 1], dtype=np.uint8)


def test_the_correlation_of_a_start_is_that_of_its_own_profile() -> None:
    true = Timing(0.083, 1.3, 4.2, 2.2)
    profile = light_of(CHIPS, true, 600)
    search = TimingSearch(profile, CHIPS)
    found = search.candidates(search.steps(), 2.2)
    assert [one.correlation for one in found] == sorted(
        (one.correlation for one in found), reverse=True
    )
    best = found[0].timing
    assert best.step == pytest.approx(true.step, rel=2e-3)
    assert best.exposure == 1.3
    assert (best.middle - true.middle + 5.0) % 10.0 - 5.0 == pytest.approx(0.0, abs=0.1)
    for one in found[:6]:
        lit = light_of(CHIPS, one.timing, 600)
        assert one.correlation == pytest.approx(np.corrcoef(lit, profile)[0, 1], abs=0.05)


def test_steps_are_tried_from_a_whole_period_in_view_to_a_chip_a_column() -> None:
    steps = TimingSearch(np.zeros(600), CHIPS).steps()
    assert steps[0] == pytest.approx(0.75 * len(CHIPS) / 600)
    assert 0.94 < steps[-1] < 0.96
    # The last column moves by a third of a chip from step to step.
    assert np.diff(steps) * 600 == pytest.approx(1.0 / 3.0)


@pytest.mark.parametrize("averaging", ["light", "pixel-value"])
@pytest.mark.parametrize("gamma", [1.8, 2.6])
def test_a_cameras_response_follows_its_gamma_between_two_levels(
    averaging: str, gamma: float
) -> None:
    (camera,) = camera_responses(occ.Scene().replace(enhancement="none"), (averaging,), 60.0, 200.0)
    lit = np.linspace(0.0, 1.0, 21)
    dark = (60.0 / 200.0) ** gamma
    expected = lit
    if averaging == "light":
        values = (dark + lit * (1.0 - dark)) ** (1.0 / gamma)
        expected = (values - values[0]) / (values[-1] - values[0])
    assert camera.response(lit, gamma) == pytest.approx(expected, abs=1e-6)
    assert (camera.averaging, camera.enhancement) == (averaging, "none")


def test_levels_below_half_a_grey_level_are_black() -> None:
    black, faint = (
        camera_responses(occ.Scene().replace(enhancement="none"), ("light",), low, 200.0)[0]
        for low in (0.3, 3.0)
    )
    half = np.array([0.5])
    assert black.response(half, 2.2) == pytest.approx(0.5 ** (1.0 / 2.2), abs=1e-6)
    assert faint.response(half, 2.2) < black.response(half, 2.2)


@pytest.mark.parametrize("low", [0.0, 60.0])
@pytest.mark.parametrize("averaging", ["light", "pixel-value"])
def test_the_slopes_of_a_response_are_limits_of_differences(averaging: str, low: float) -> None:
    (camera,) = camera_responses(occ.Scene().replace(enhancement="none"), (averaging,), low, 200.0)
    lit, small = np.linspace(0.01, 1.0, 40), 1e-6
    by_timing = np.stack([np.ones(40), np.zeros(40), lit])
    by_lit, none, later, by_gamma = camera.response.slopes(lit, 2.2, by_timing)
    of_lit = camera.response(lit + small, 2.2) - camera.response(lit - small, 2.2)
    of_gamma = camera.response(lit, 2.2 + small) - camera.response(lit, 2.2 - small)
    assert by_lit == pytest.approx(of_lit / (2.0 * small), rel=1e-4)
    assert later == pytest.approx(lit * by_lit)
    assert not none.any()
    assert by_gamma == pytest.approx(of_gamma / (2.0 * small), abs=1e-6)


def test_ranks_rise_by_what_a_column_rises_above_those_of_equal_value() -> None:
    """Of two columns of each value one rises, and passes all values up to its own new one."""
    scene = occ.Scene().replace(enhancement="equalization")
    ranks = camera_responses(scene, ("pixel-value",), 60.0, 200.0)[1].response
    lit = np.repeat(np.linspace(0.0, 1.0, 2000) ** 2, 2)
    rises = np.stack([np.arange(4000.0) % 2.0, np.ones(4000), np.zeros(4000)])
    inside = (lit > 0.1) & (lit < 0.9)
    one, every, _, _ = ranks.slopes(lit, 2.2, rises)
    density = 0.5 / np.sqrt(lit[inside])
    signs = np.where(np.arange(4000) % 2, 0.5, -0.5)[inside]
    assert one[inside] == pytest.approx(signs * density, rel=0.05)
    assert every[inside] == pytest.approx(0.0, abs=1e-9)


def test_of_an_equalized_picture_a_column_shows_its_rank() -> None:
    scene = occ.Scene().replace(enhancement="equalization")
    cameras = camera_responses(scene, ("light",), 60.0, 200.0)
    assert [one.enhancement for one in cameras] == ["none", "equalization"]
    lit = np.array([0.0, 0.0, 0.2, 0.9, 0.9, 0.9, 1.0, 0.1])
    ranks = cameras[1].response(lit, 2.2)
    assert ranks.min() == 0.0
    assert ranks.max() == 1.0
    below = np.array([(lit <= one).sum() for one in lit])
    assert ranks == pytest.approx((below - below.min()) / (below.max() - below.min()))
    constant = cameras[1].response(np.full(4, 0.3), 2.2)
    assert np.ptp(constant) == 0.0
    assert math.isfinite(constant[0])


def test_of_an_equalized_picture_the_exposure_is_that_of_its_ranks() -> None:
    """Equalized stripes look much like those of 130 µs that are not equalized."""
    scene = occ.load_preset("phone-136us").replace(rows=600, switching_frequency=11e3)
    image = occ.render(scene, tolerance=math.inf).image
    match = occ.match_photo(photo_of(image), scene, sent="scene")
    assert match.scene.model.enhancement == "equalization"
    assert abs(match.exposure_time - 136e-6) < 2.0 * match.uncertainties["exposure_time"] < 2e-6
