"""Column means, region and results computed without pixels equal those of the picture."""

import math

import numpy as np
import pytest
from scene_values import presets_of_codes

import occ_model as occ
from occ_model.receiver.decode import QUICK_DECODERS
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study.observation import read_profile

SETTINGS = SimulationSettings(observable="signal")
BARE = SimulationSettings(tolerance=math.inf)
PRESETS = [name for name in presets_of_codes() if not name.endswith("-real")]


def small(preset: str, **changes: float) -> Scene:
    scene = occ.load_preset(preset)
    return scene.replace(rows=scene.camera.rows // 8, **changes)


def test_noise_that_is_cut_off_at_white_darkens_the_mean() -> None:
    scene = small("phone-136us", iso=800.0)
    reading = read_profile(scene, SETTINGS)
    bare = occ.column_profile(scene)
    brightest = bare == bare.max()
    shown = occ.render(scene, observable="signal").profile[brightest].mean()
    lost = bare.max() - shown
    assert lost > 0.1
    assert bare.max() - reading.profile[brightest].mean() == pytest.approx(lost, abs=0.1 * lost)


@pytest.mark.parametrize("preset", PRESETS)
def test_without_noise_everything_equals_the_picture_exactly(preset: str) -> None:
    scene = small(preset)
    reading = read_profile(scene, BARE)
    frame = occ.render(scene, tolerance=math.inf)
    assert np.array_equal(reading.profile, frame.profile)
    assert np.array_equal(reading.signal, frame.signal)
    assert np.array_equal(reading.corners, frame.corners)
    assert tuple(reading.results) == QUICK_DECODERS
    for decoder, result in reading.results.items():
        of_picture = occ.decode(frame.image, scene, decoder)
        assert (result.code, result.region) == (of_picture.code, of_picture.region)


@pytest.mark.parametrize(
    "changes", [{"roll": 0.2}, {"jpeg_quality": 80}, {"vignetting_exponent": 4.0}]
)
def test_if_rows_differ_the_profile_path_is_not_used(changes: dict[str, float]) -> None:
    assert read_profile(small("phone-68us", **changes), SETTINGS) is None


def test_a_panel_out_of_the_picture_is_not_read() -> None:
    reading = read_profile(small("phone-68us", offset_x=50.0), SETTINGS)
    assert [result.code for result in reading.results.values()] == [None] * len(QUICK_DECODERS)
    assert all(result.failure for result in reading.results.values())


@pytest.mark.parametrize("tolerance", [0.0, 1.0, 20.0])
def test_a_reading_simulates_all_effects_of_the_scene_like_a_study(tolerance: float) -> None:
    scene = small("phone-136us", switching_frequency=14.6e3)
    reading = read_profile(scene, SimulationSettings(tolerance, observable="profile"))
    assert reading.plan.included == occ.plan(scene, 0.0).included
    assert occ.plan(scene, 20.0, "profile").included != reading.plan.included


def test_a_picture_too_large_to_be_rendered_is_not_read_by_its_profile() -> None:
    """The program states nothing about a picture that it refuses to show."""
    scene = occ.load_preset("phone-136us").replace(rows=100_000, columns=20_000)
    with pytest.raises(occ.ProjectionError, match="million pixels; allowed: up to"):
        read_profile(scene, SETTINGS)


def test_a_study_reads_a_dark_noisy_scene_as_its_pictures_are_read() -> None:
    # The brightest 5 % of pixels are everywhere, and so is the region.
    scene = occ.load_preset("phone-136us").replace(
        line_code="manchester", framing="preamble", payload="hex:5a5a5a5a5a5a5a5a",
        switching_frequency=15e3, enhancement="none", distance=1.0, rows=200, luminance=150.0,
        illuminance=290.0,
    )  # fmt: skip
    study, pictures = (
        occ.bit_error_rate(scene, "sequence", bits=2 * 64, path=path) for path in ("auto", "image")
    )
    assert study.pictures_right == pictures.pictures_right == 0
