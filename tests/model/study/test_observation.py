"""Column means, region and results computed without pixels equal those of the picture."""

import math

import numpy as np
import pytest
from amount import amount
from numpy.typing import NDArray
from scene_values import presets_of_codes

import occ_model as occ
from occ_model.receiver.decode import QUICK_DECODERS
from occ_model.receiver.signal import locate
from occ_model.results.decoding import Region
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.study.drawn_region import BrightFractions, _more_than
from occ_model.study.observation import read_profile

SETTINGS = SimulationSettings(observable="signal")
BARE = SimulationSettings(tolerance=math.inf)
PRESETS = [name for name in presets_of_codes() if not name.endswith("-real")]


def small(preset: str, **changes: float) -> Scene:
    scene = occ.load_preset(preset)
    return scene.replace(rows=scene.camera.rows // 8, **changes)


@pytest.mark.parametrize("preset", PRESETS)
def test_the_profile_equals_the_pictures_except_for_noise(preset: str) -> None:
    scene = small(preset, iso=800.0)
    reading = read_profile(scene, SETTINGS)
    frame = occ.render(scene, observable="signal")
    region = reading.results["threshold"].region
    noise = float(region.crop(frame.camera_image).std(axis=0).max())
    assert noise > 1.0
    deviation = np.abs(reading.profile - frame.profile)
    assert deviation.max() < 6.0 * noise / math.sqrt(region.rows)


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


ROWS, COLUMNS = 400, 1100
SPAN = Region(60, 320, 303, 800)
TRIALS = amount(8, 25)


def locate_in_pixels(panel: float, around: float, random: np.random.Generator) -> Region:
    """Draw random pixels of two levels with these probabilities, and locate the panel in them."""
    image = (random.random((ROWS, COLUMNS)) < around).astype(np.uint8)
    seen = image[SPAN.first_row : SPAN.last_row, SPAN.first_column : SPAN.last_column]
    seen[:] = random.random(seen.shape) < panel
    found = locate(image, bright_fraction=0.05)
    return found.region


def edges(region: Region) -> NDArray[np.float64]:
    return np.array(
        [region.first_row, region.last_row, region.first_column, region.last_column], float
    )


@pytest.mark.parametrize(
    ("panel", "around"),
    [(1.0, 0.0), (0.5, 1e-4), (0.3, 0.003), (0.3, 0.01), (0.02, 0.02), (0.05, 0.0), (1e-3, 1e-6)],
)
def test_the_drawn_rectangle_has_the_distribution_of_the_one_found_in_pixels(
    panel: float, around: float
) -> None:
    fractions = BrightFractions(ROWS, SPAN, np.full(COLUMNS, panel), np.full(COLUMNS, around))
    drawn, found = (
        np.array([edges(make(np.random.default_rng([start, trial]))) for trial in range(TRIALS)])
        for start, make in (
            (1, fractions.draw_region),
            (2, lambda random: locate_in_pixels(panel, around, random)),
        )
    )
    error = np.sqrt((drawn.var(axis=0) + found.var(axis=0)) / TRIALS)
    # A cell of 3 pixels has more bright pixels at its end than chance alone would give.
    assert np.all(np.abs(drawn.mean(axis=0) - found.mean(axis=0)) <= 4.0 * error + 1.5)


@pytest.mark.parametrize("pixels", [1, 9, 400, 170_000])
def test_bright_pixels_in_a_cell_of_any_size_follow_the_binomial_law(pixels: int) -> None:
    fraction = np.array([0.0, 0.1, 0.3, 1.0])
    found = _more_than(0.2, fraction, pixels)
    drawn = np.random.default_rng(1).binomial(pixels, fraction, (20_000, 4)) > 0.2 * pixels
    assert found == pytest.approx(drawn.mean(axis=0), abs=0.015)


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
