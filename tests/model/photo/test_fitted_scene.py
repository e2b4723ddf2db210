"""A fit in SI units: its values, and their uncertainties as they follow from the fit's."""

import itertools
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from simulated_photos import photo_of

import occ_model as occ
from occ_model.files.writing import write_image
from occ_model.photo.fit.least_squares import StripeFit
from occ_model.photo.fit.timing import Timing
from occ_model.photo.fitted_scene import (
    doubts_by_error,
    doubts_by_note,
    exposure_time,
    limit_step_error,
    readout_and_frequency,
    round_estimates,
    uncertainties_of,
)
from occ_model.photo.photo_scene import with_allowed, with_chips, with_levels
from occ_model.results.match import ESTIMATES
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import sent_chips

COLUMNS, FIRST = 901, 40
TIMING = Timing(0.0123, 0.77, 5.4, 2.2)
PARTS = np.array(
    [[1e-6, 0, 0, 0], [2e-4, 1e-3, 0, 0], [3e-4, -5e-4, 2e-3, 0], [1e-3, 0, 2e-3, 0.02]]
)
COVARIANCE = PARTS @ PARTS.T


def fit_of(timing: Timing = TIMING, covariance: np.ndarray = COVARIANCE) -> StripeFit:
    line = np.zeros(COLUMNS)
    return StripeFit(timing, covariance, line, line, line, 0.9, 1.0, True)


def values(timing: Timing, scene: Scene, estimate: str) -> dict[str, float]:
    """Return what a timing means: of the first column of the picture, and not of the region."""
    fit = fit_of(timing)
    readout, frequency = readout_and_frequency(fit, scene, estimate)
    begin = timing.start(COLUMNS) - timing.step * FIRST
    name, value = (
        ("readout_time", readout) if estimate == "readout_time"
        else ("switching_frequency", frequency)
    )  # fmt: skip
    return {
        name: value,
        "exposure_time": exposure_time(fit, scene, estimate),
        "start_time": begin / frequency,
        "gamma": timing.gamma,
    }


@pytest.mark.parametrize("estimate", ESTIMATES)
def test_uncertainties_follow_from_the_fits_covariance(estimate: str) -> None:
    """To first order: the slopes of the values over the timing, by differences."""
    scene = occ.Scene().replace(switching_frequency=2e3, readout_time=9e-6)
    here = values(TIMING, scene, estimate)
    frequency = readout_and_frequency(fit_of(), scene, estimate)[1]
    found = scene.replace(switching_frequency=frequency, start_time=here["start_time"])
    slopes = []
    for field in ("step", "exposure", "middle", "gamma"):
        change = 1e-6 * getattr(TIMING, field)
        moved = values(replace(TIMING, **{field: getattr(TIMING, field) + change}), scene, estimate)
        slopes.append({name: (moved[name] - here[name]) / change for name in here})
    stated = uncertainties_of(fit_of(), estimate, found, FIRST)
    assert set(stated) == set(here)
    for name, deviation in stated.items():
        slope = np.array([one[name] for one in slopes])
        assert deviation == pytest.approx(math.sqrt(slope @ COVARIANCE @ slope), rel=1e-4), name


def test_a_readout_time_that_is_hardly_known_is_doubtful_or_refused() -> None:
    assert doubts_by_error("readout_time", 1.0, 0.03) == []
    (why,) = doubts_by_error("readout_time", 1.0, 0.0301)
    assert why.startswith("The readout time is known only to 3.01 %; at most 3.00 %")
    assert doubts_by_error("switching_frequency", 1.0, 0.1)
    with pytest.raises(
        occ.MatchError, match=r"switching frequency is known only to 11.0 %; at most 10.0 %"
    ):
        doubts_by_error("switching_frequency", 1.0, 0.11)


def test_edges_at_the_right_chips_bound_the_error_of_the_step() -> None:
    """Where a fit has no slope over the step, its covariance is that of nothing."""
    wild = COVARIANCE.copy()
    wild[0, 0] = 49.0
    bound = math.sqrt(limit_step_error(fit_of(covariance=wild), 2).covariance[0, 0])
    assert bound == pytest.approx(0.5 / COLUMNS)
    np.testing.assert_array_equal(limit_step_error(fit_of(), 1).covariance, COVARIANCE)


def test_no_value_is_rounded_to_a_wild_error() -> None:
    scene = occ.Scene().replace(exposure_time=15.04e-6)
    assert round_estimates(scene, {"exposure_time": 1340e-6}).camera.exposure_time == 15e-6
    assert round_estimates(scene, {"exposure_time": 2e-6}).camera.exposure_time == 15e-6


@pytest.mark.parametrize("turn", [0, 5])
def test_chips_of_a_packet_become_its_code_and_others_a_pattern(turn: int) -> None:
    scene = occ.Scene().replace(code=345)
    packet = sent_chips(scene.transmitter)
    found, turned = with_chips(occ.Scene(), np.roll(packet, turn))
    assert (found.transmitter.code, found.transmitter.pattern, turned) == (345, "", turn)
    other, turned = with_chips(scene, packet[:-1])
    assert other.transmitter.pattern == "".join(map(str, packet[:-1].tolist()))
    assert turned == 0


def test_the_light_of_a_scene_gives_the_photos_levels() -> None:
    scene = occ.Scene().replace(enhancement="none", vignetting_exponent=0.0)
    lit = with_levels(scene, 60.0, 150.0)
    filled = lit.replace(rows=60, panel_width=5.0, panel_height=5.0)
    profile = occ.render(filled, tolerance=math.inf).profile
    assert profile.max() == pytest.approx(150.0)
    assert profile.min() == pytest.approx(60.0)


def test_values_out_of_range_are_left_as_they_are() -> None:
    scene = occ.Scene()
    changed = with_allowed(scene, iso=1e12, gamma=2.0)
    assert changed.camera.iso == scene.camera.iso
    assert changed.camera.gamma == 2.0


def test_a_noted_exposure_is_apart_by_the_deviations_by_which_it_is_judged() -> None:
    photo = replace(photo_of(np.zeros((1, 1), np.uint8)), exposure_time=100e-6)  # noted to 1.2 %
    assert doubts_by_note(photo, 103.5e-6, 0.1e-6) == []
    (why,) = doubts_by_note(photo, 112e-6, 0.1e-6)
    assert why.endswith("are 10.0 standard deviations apart.")


def test_the_exposure_of_a_receivers_equalized_picture_is_doubtful(tmp_path: Path) -> None:
    scene = occ.load_preset("phone-136us").replace(rows=200, columns=1600)
    frame = occ.render(scene)
    photos = {}
    for ending, picture_kind in itertools.product(("png", "jpg", "tif"), ("camera", "receiver")):
        path = tmp_path / f"{picture_kind}.{ending}"
        write_image(path, frame.picture(picture_kind), frame.picture_title(picture_kind))
        photo = photos[path.name] = occ.load_photo(path, "columns")
        assert photo.enhancement == (None if picture_kind == "camera" else "equalization")
    verdicts = []
    for name in ("camera.png", "receiver.png"):
        match = occ.match_photo(photos[name], scene, sent="scene")
        verdicts.append((match.verdict, match.exposure_verdict))
        assert match.readout_time == pytest.approx(scene.camera.readout_time, rel=1e-3)
    assert verdicts == [("sure", "sure"), ("sure", "doubtful")]
