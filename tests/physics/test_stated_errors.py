"""Stated errors hold for photographs from a world that is wider than the model."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypotheses import hypothesis
from photo_world.bounds import bound_of_light, bound_of_picture
from photo_world.photograph import World, photograph, random_world
from photo_world.tone_curves import power
from photo_world.trials import Trial, told, trial
from simulated_photos import photo_of

import occ_model as occ
from occ_model.photo.evidence.doubts import exposure_doubts
from occ_model.photo.fit.timing import Timing
from occ_model.photo.fitted_scene import doubts_by_note
from occ_model.photo.stripes.evenly_lit import Cells


def small_world(seed: int, **changes: Any) -> World:
    """Draw a photograph that can be matched quickly, a rectangle with long chips."""
    world = random_world(seed)
    lamp = replace(
        world.lamp, shape="rectangular", middle_row=50.0, middle_column=400.0, half_height=40.0,
        half_width=370.0, halo=0.02, halo_size=4.0,
    )  # fmt: skip
    small = replace(
        world, rows=100, columns=800, lamp=lamp, chips="1110010110", readout_time=10e-6,
        switching_frequency=5e3, exposure_time=130e-6, saturated=0.0, peak=0.5, quality=90,
    )  # fmt: skip
    return replace(small, **changes)


def match_of(world: World) -> occ.Match:
    return occ.match_photo(photo_of(photograph(world)), told(world), sent="scene")


@pytest.fixture(scope="module")
def sample() -> list[Trial]:
    """Match a few photographs, every other one of which is saturated."""
    return [
        trial(small_world(seed, saturated=0.25 * (seed % 2), chips="10" if seed < 1 else "1110010"))
        for seed in range(2)
    ]


def test_sure_results_are_within_four_stated_deviations(sample: list[Trial]) -> None:
    sure = [one for one in sample if one.is_sure]
    assert len(sure) >= 1
    for one in sure:
        assert abs(one.readout_error) < 4.0 * one.readout_deviation
        if not one.exposure_doubts:
            assert abs(one.exposure_error) < 4.0 * one.exposure_deviation


def test_no_stated_deviation_is_below_the_bound(sample: list[Trial]) -> None:
    for one in sample:
        if not one.failure:
            assert one.exposure_deviation > one.picture_bounds[1] > one.light_bounds[1]
            assert one.readout_deviation > one.light_bounds[0]


def test_the_bound_shrinks_with_the_root_of_the_light() -> None:
    """With shot noise alone, four times the electrons give half the deviation."""
    world = small_world(1, read_noise=0.0, full_well=500.0)
    few, many = bound_of_light(world), bound_of_light(replace(world, full_well=2000.0))
    assert few[0] == pytest.approx(2.0 * many[0], rel=1e-6)
    assert few[1] == pytest.approx(2.0 * many[1], rel=1e-6)


def test_the_bound_is_that_of_the_light_if_the_camera_adds_nothing() -> None:
    """With few electrons, rounding and JPEG are negligible beside shot noise."""
    world = small_world(1, full_well=30.0, read_noise=0.0, blur=0.0, quality=100, peak=0.9)
    world = replace(world, ambient=0.1, lamp=replace(world.lamp, halo=0.0), curve=power(1.0))
    by_picture = bound_of_picture(world, camera_known=True)
    np.testing.assert_allclose(by_picture, bound_of_light(world), rtol=0.05)


def test_unknown_properties_of_the_camera_can_only_widen_the_bound() -> None:
    world = small_world(2, blur=0.8)
    known, unknown = bound_of_picture(world, camera_known=True), bound_of_picture(world)
    coarse = bound_of_picture(replace(world, quality=50))
    assert all(wide > narrow for wide, narrow in zip(unknown, known, strict=True))
    assert all(wide > narrow for wide, narrow in zip(coarse, unknown, strict=True))


def test_an_exposure_far_from_the_noted_one_is_doubted() -> None:
    world = small_world(3, curve=power(2.22))
    right = replace(photo_of(photograph(world)), exposure_time=world.exposure_time)
    wrong = replace(right, exposure_time=1.6 * world.exposure_time)
    match = occ.match_photo(wrong, told(world), sent="scene")
    assert any("noted" in why for why in match.exposure_reasons)
    assert (match.verdict, match.exposure_verdict) == ("sure", "doubtful")
    error = match.uncertainties["exposure_time"]
    assert doubts_by_note(right, match.exposure_time, error) == []


def test_an_exposure_that_may_be_none_at_all_is_doubted() -> None:
    """An exposure of one column, hidden by a long-tailed blur; two deviations include 0."""
    world = small_world(3, exposure_time=10e-6, blur=1.4, blur_shape="exponential")
    match = match_of(replace(world, curve=power(2.22)))
    assert match.uncertainties["exposure_time"] > 0.5 * match.exposure_time
    assert match.verdict == "sure"
    assert any(why.startswith("The exposure time is known only") for why in match.exposure_reasons)


@pytest.mark.whole
@pytest.mark.parametrize(
    ("seed", "deviations", "readout", "exposure"),
    [
        # Grey levels near black are blurred: corrected only once, off by 4.9 deviations.
        (1120222, 2.0, np.inf, 0.05),
        # Beside a soft rim, an exposure of twice the right number of chips looked likelier.
        (93030, 2.0, np.inf, 0.2),
        # Only the dark chips are not white: the brightness follows from the white part alone.
        (1020109, 3.0, 3e-4, 0.4),
    ],
)
def test_errors_hold_where_they_once_did_not(
    seed: int, deviations: float, readout: float, exposure: float
) -> None:
    one = trial(random_world(seed))
    assert one.is_sure_of("exposure")
    assert abs(one.readout_error) < deviations * one.readout_deviation < readout
    assert abs(one.exposure_error) < 2.0 * one.exposure_deviation < exposure


@pytest.mark.whole
@pytest.mark.parametrize("seed", [730509, 1020061])
def test_the_exposure_of_a_lamp_of_few_columns_a_period_is_doubted(seed: int) -> None:
    """Of 4.9 and 5.7 columns of a period; both errors hold."""
    one = trial(random_world(seed))
    assert one.is_sure
    assert abs(one.readout_error) < 2.0 * one.readout_deviation
    assert abs(one.exposure_error) < 2.0 * one.exposure_deviation
    (doubt,) = one.exposure_doubts
    assert "blur and compression hide" in doubt


@pytest.mark.whole
def test_an_exposure_is_not_listed_as_an_alternative_to_itself() -> None:
    """Two searches that end at 0.108 chips found one exposure, not two (seed 1120060)."""
    world = random_world(1120060)
    match = match_of(world)
    assert match.other_exposures == ()
    assert not any("Other exposure times" in why for why in match.exposure_reasons)


@pytest.mark.whole
def test_edges_hidden_by_white_are_doubted() -> None:
    """With a short exposure of a lamp far brighter than white, ramps end within a column or two."""
    world = small_world(3, exposure_time=40e-6, saturated=0.58, ambient=0.0005)
    lamp = replace(world.lamp, darkening=0.0, halo=0.0, rim=1.0)
    match = match_of(replace(world, lamp=lamp))
    assert any("Saturation hides" in why for why in match.exposure_reasons)


def test_the_exposure_is_doubted_where_more_than_two_fifths_are_white() -> None:
    world = small_world(3, saturated=0.45)
    match = match_of(world)
    assert match.verdict == "sure"
    assert match.scene.model.enhancement == "none"  # cameras are not assumed to equalize
    assert any("at most 40.0 % are allowed" in why for why in match.exposure_reasons)
    given = hypothesis(np.array([1, 0], np.uint8), Timing(0.1, 0.5, 0.0, 2.2), 400, was_read=False)
    assert exposure_doubts(given, replace(match.stripes, saturated=0.4)) == []
    assert exposure_doubts(given, replace(match.stripes, saturated=0.401)) != []


def test_columns_kept_for_the_fit_hold_no_clipped_pixel() -> None:
    world = small_world(7, saturated=0.45)
    image = photograph(replace(world, lamp=replace(world.lamp, darkening=0.0), vignetting=0.0))
    cells = Cells.of(photo_of(image), occ.Region(18, 82, 40, 760))
    profiles = cells.profiles(80)
    assert profiles
    assert all(profile.values[profile.kept].max() < 250.0 for profile in profiles)
    assert not all(profile.kept.all() for profile in profiles)
