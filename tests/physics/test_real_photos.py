"""Matching finds what is known about the two real photographs."""

import re
from pathlib import Path

import pytest
from documents import FOLDER, text_of

import occ_model as occ
from occ_model.results.match import PLAIN_STRIPES

pytestmark = pytest.mark.photos

NOTED = 79e-6  # the exposure time that the iPhone noted, in seconds

STRIPES = "01010" + "0010110001001000"
"""The pattern that VLCDetector's transmitter repeats."""


def assert_manual_states(match: occ.Match, row: str) -> None:
    """Compare the results with a row of the manual's table, to its last digits."""
    (found,) = [
        line.split(" | ")[-1]
        for line in text_of(FOLDER / "validation.md").splitlines()
        if line.startswith(f"| {row}")
    ]
    stated = re.findall(r"([\d.]+) µs ± ([\d.]+)", found.replace(" a line", ""))
    for name, numbers in zip(("readout_time", "exposure_time"), stated, strict=True):
        values = getattr(match, name), match.uncertainties[name]
        for text, value in zip(numbers, values, strict=True):
            last_digit = 10.0 ** -len(text.partition(".")[2])
            assert 1e6 * value == pytest.approx(float(text), abs=last_digit), (row, name)


@pytest.fixture(scope="module")
def led(photos: Path) -> occ.Photo:
    return occ.load_photo(photos / "led_1khz_frame.png")


@pytest.fixture(scope="module")
def square_wave(led: occ.Photo) -> occ.Match:
    scene = occ.load_preset("phone-68us").replace(pattern="10", switching_frequency=2e3)
    return occ.match_photo(led, scene)


@pytest.fixture(scope="module")
def stripes(photos: Path) -> occ.Match:
    return occ.match_photo(
        occ.load_photo(photos / "vlcdetector_stripes.png"), occ.load_preset("phone-68us")
    )


def test_lines_are_found_to_be_the_scan_axis(led: occ.Photo) -> None:
    assert led.turned
    assert led.samples.shape == (1920, 1080)


def test_the_readout_is_what_was_measured(square_wave: occ.Match) -> None:
    assert square_wave.readout_time == pytest.approx(14.565e-6, rel=0.003)


def test_the_exposure_is_near_what_the_camera_was_set_to(square_wave: occ.Match) -> None:
    """The error is that of the light's exposure; a setting may be off by a factor of 1.3."""
    assert 62.5e-6 / 1.3 < square_wave.exposure_time < 62.5e-6 * 1.3
    assert square_wave.uncertainties["exposure_time"] < 0.5 * square_wave.exposure_time


def test_the_manual_states_what_is_found(square_wave: occ.Match) -> None:
    assert_manual_states(square_wave, "an LED of 1 kHz (Gyroflow")


def test_the_square_wave_explains_the_photo(square_wave: occ.Match) -> None:
    assert square_wave.correlation >= 0.99
    stated = square_wave.uncertainties["duty"]
    assert square_wave.duty == pytest.approx(0.5, abs=2.0 * stated)


@pytest.mark.whole
def test_light_is_averaged_in_a_real_camera_not_pixel_values(
    square_wave: occ.Match, stripes: occ.Match
) -> None:
    assert square_wave.scene.model.averaging == stripes.scene.model.averaging == "light"


def test_the_frequency_comes_out_where_the_readout_is_known(led: occ.Photo) -> None:
    scene = occ.load_preset("phone-68us").replace(pattern="10", readout_time=14.565e-6)
    match = occ.match_photo(led, scene, estimate="switching_frequency")
    assert match.switching_frequency == pytest.approx(2e3, rel=0.003)


def test_the_square_wave_is_no_code_where_it_is_not_given(led: occ.Photo) -> None:
    scene = occ.load_preset("phone-68us").replace(switching_frequency=2e3)
    with pytest.raises(occ.MatchError) as refused:
        occ.match_photo(led, scene, sent="read")
    assert refused.value.reasons[0] == PLAIN_STRIPES


def test_all_chips_are_read_without_being_given(photos: Path) -> None:
    read = occ.read_chips(occ.load_photo(photos / "vlcdetector_stripes.png"))
    assert len(read.text) > 3 * len(STRIPES)
    assert read.text in 5 * STRIPES
    assert read.confidence > 0.99
    assert read.columns_per_chip == pytest.approx(13.9, rel=0.01)


@pytest.mark.whole
def test_the_chips_read_explain_the_profile_despite_saturation(stripes: occ.Match) -> None:
    assert stripes.pattern_was_read
    assert len(stripes.pattern) == len(STRIPES) == 21
    assert stripes.pattern in STRIPES + STRIPES
    columns = 1.0 / (stripes.readout_time * stripes.switching_frequency)
    assert columns == pytest.approx(13.9, rel=0.01)
    assert stripes.correlation >= 0.97
    assert stripes.stripes.saturated > 0.1


def test_the_fitted_scene_shows_the_photo(square_wave: occ.Match, led: occ.Photo) -> None:
    frame = occ.render(square_wave.scene, tolerance=float("inf"))
    assert frame.image.shape == led.samples.shape
    region = square_wave.region
    simulated = frame.profile[region.first_column : region.last_column]
    assert occ.compare(square_wave.stripes.flattened, simulated).correlation > 0.99


@pytest.mark.whole
def test_two_photos_of_one_camera_agree_and_name_what_hides_an_exposure(photos: Path) -> None:
    """The camera states 79.0 us for both; in one the stripes are white."""
    matches = []
    for name, chips_a_second in (("iphone_1khz.jpg", 2e3), ("iphone_2.5khz.jpg", 5e3)):
        photo = occ.load_photo(photos / name)
        scene = occ.load_preset("phone-68us").replace(
            pattern="10", switching_frequency=chips_a_second
        )
        match = occ.match_photo(photo, scene)
        assert photo.exposure_time == pytest.approx(NOTED, rel=0.01)
        stated = match.uncertainties["exposure_time"]
        is_near = abs(match.exposure_time - NOTED) < 2.0 * stated < 0.5 * NOTED
        assert is_near or match.exposure_verdict == "doubtful"
        matches.append(match)
    white, seen = matches
    assert white.readout_time == pytest.approx(seen.readout_time, rel=5e-4)
    assert any("known only to" in why for why in white.all_reasons)
    assert seen.verdict == seen.exposure_verdict == "sure"
    assert_manual_states(white, "an LED of 1 kHz by an iPhone")
    assert_manual_states(seen, "the same camera, not saturated")
