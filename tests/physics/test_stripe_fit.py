"""The fit inverts the exact exposure integral."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st
from lit_fractions import light_of
from simulated_photos import photo_of, random_scene, take

import occ_model as occ
from occ_model.camera.photometry import luminance_of
from occ_model.photo.fit.camera_response import camera_responses
from occ_model.photo.fit.initial_search import TimingSearch
from occ_model.photo.fit.least_squares import StripeModel
from occ_model.photo.fit.timing import ChipLight, Timing
from occ_model.transmitter.scheme import sent_chips

CHIPS = sent_chips(occ.Scene().transmitter)


def spread(index: int, low: float, high: float) -> float:
    """Return numbers that fill a range evenly, none a simple fraction of another."""
    return low + (high - low) * (index * (math.sqrt(5.0) - 1.0) / 2.0 % 1.0)


def sample_of(count: int, everyday: int) -> list[Any]:
    """Return numbers from 1; without --whole only the first few."""
    return [
        pytest.param(index, marks=pytest.mark.whole if index > everyday else ())
        for index in range(1, count + 1)
    ]


@pytest.mark.parametrize("index", sample_of(24, 4))
def test_an_exact_profile_gives_its_timing_back(index: int) -> None:
    step, exposure = spread(index, 0.03, 0.4), spread(7 * index, 0.2, 4.0)
    middle = spread(31 * index, 0.0, 24.0)
    true = Timing(step, exposure, middle, 2.22)
    profile = 40.0 + 150.0 * light_of(CHIPS, true, 2000)
    candidates = TimingSearch(profile, CHIPS).candidates(TimingSearch(profile, CHIPS).steps(), 2.22)
    model = StripeModel(profile, CHIPS, None, step)
    fit = min((model.fit(one.timing) for one in candidates[:6]), key=lambda found: found.residual)
    assert fit.timing.step == pytest.approx(step, rel=1e-6)
    assert fit.timing.exposure == pytest.approx(exposure, rel=1e-3)
    late = (fit.timing.middle - middle + 12.0) % 24.0 - 12.0
    assert late == pytest.approx(0.0, abs=1e-3)
    assert fit.correlation > 0.999999


def test_gamma_comes_back_where_it_is_asked_for() -> None:
    scene = occ.Scene().replace(averaging="light", gamma=2.6, illuminance=400.0)
    model_tone = camera_responses(scene, ("light",), 80.0, 220.0)[0].response
    true = Timing(0.08, 0.7, 5.3, 2.6)
    tone = model_tone(light_of(CHIPS, true, 2500), 2.6)
    model = StripeModel(80.0 + 140.0 * tone, CHIPS, model_tone, 0.08)
    fit = model.fit(Timing(0.08, 0.6, 5.35, 2.0), with_gamma=True)
    assert fit.timing.gamma == pytest.approx(2.6, rel=1e-3)
    assert fit.timing.exposure == pytest.approx(0.7, rel=1e-3)


@given(exposure=st.floats(0.05, 0.95), turns=st.integers(1, 3))
def test_exposures_that_add_up_to_whole_periods_look_alike(exposure: float, turns: int) -> None:
    """The moving average is a trapezoid whose ramps last the exposure modulo the period."""
    light = ChipLight(np.array([1, 0], dtype=np.uint8), 500)
    one = light.expose(Timing(0.07, exposure, 0.3, 2.22)).lit
    other = light.expose(Timing(0.07, 2.0 * turns - exposure, 0.3, 2.22)).lit
    swing = np.ptp(other) / np.ptp(one)
    turned = np.abs(np.corrcoef(one, other)[0, 1])
    assert turned == pytest.approx(1.0, abs=1e-9)
    assert swing == pytest.approx(exposure / (2.0 * turns - exposure), rel=0.05)


def test_dark_stripes_show_a_short_exposure_of_a_square_wave() -> None:
    """A long one has the LED's light in every column; that of a short pulse looks the same."""
    scene = occ.Scene().replace(
        pattern="10", switching_frequency=5e3, exposure_time=60e-6, readout_time=11e-6,
        columns=1000, rows=40, panel_width=5.0, panel_height=5.0, enhancement="none",
        luminance=1000.0, illuminance=100.0, averaging="light",
    )  # fmt: skip
    photo = photo_of(occ.render(scene, tolerance=math.inf).image)
    match = occ.match_photo(photo, scene.replace(readout_time=1e-6, exposure_time=1e-3))
    assert (match.verdict, match.exposure_verdict) == ("sure", "doubtful")
    assert abs(match.exposure_time - 60e-6) < 3.0 * match.uncertainties["exposure_time"] < 15e-6
    assert match.other_exposures == pytest.approx((200e-6,), rel=0.01)  # of a pulse of 60 us


@pytest.mark.parametrize("seed", [2, 5])
def test_a_code_of_few_chips_is_read_under_a_hot_spot(seed: int) -> None:
    """By levels of one polynomial these were refused: they follow no hot spot."""
    random, columns = np.random.default_rng([5, seed]), 600
    pattern = "11010011" if seed % 2 else "1101001110"
    chips = np.array([int(chip) for chip in pattern], dtype=np.uint8)
    step = random.uniform(1.6, 2.4) * len(chips) / columns
    timing = Timing(step, random.uniform(0.1, 0.9), random.uniform(0.0, 8.0), 1.0)
    place = np.linspace(-1.0, 1.0, columns)
    middle, size, height = (random.uniform(*ends) for ends in ((-0.4, 0.4), (0.25, 0.5), (1, 5)))
    hot = 1.0 + height * np.exp(-0.5 * ((place - middle) / size) ** 2)
    light = 0.002 + 0.9 * light_of(chips, timing, columns) * hot / hot.max()
    levels = 255.0 * light ** (1.0 / 2.2) + random.normal(0.0, 2.0, (60, columns))
    photo = photo_of(np.clip(np.rint(levels), 0.0, 255.0).astype(np.uint8))
    scene = occ.load_preset("phone-68us").replace(pattern=pattern, switching_frequency=1e4)
    match = occ.match_photo(photo, scene, sent="scene")
    assert match.verdict == "sure"
    off = match.readout_time - step / 1e4
    assert abs(off) < 3.0 * match.uncertainties["readout_time"]
    assert abs(off) < 1e-3 * match.readout_time


@pytest.mark.parametrize("seed", sample_of(6, 0))
def test_a_blinking_leds_exposure_comes_back_under_uneven_light(seed: int) -> None:
    scene = random_scene(seed).replace(pattern="10", vignetting_exponent=4.0)
    frequency = 1.0 / (spread(seed + 1, 8.0, 30.0) * scene.camera.readout_time)
    exposure = spread(7 * seed + 3, 0.1, 0.8) / frequency
    scene = scene.replace(switching_frequency=frequency, exposure_time=exposure)
    white = float(luminance_of(np.array([180.0]), scene.camera)[0])
    scene = scene.replace(luminance=white, illuminance=0.02 * white)
    match = occ.match_photo(take(scene, seed), scene.replace(readout_time=1e-6))
    assert match.readout_time == pytest.approx(scene.camera.readout_time, rel=1e-3)
    off = abs(match.exposure_time - exposure)
    assert off < max(0.05 * exposure, 3.0 * match.uncertainties["exposure_time"])
    assert np.all(match.stripes.high > match.stripes.low)


@pytest.mark.parametrize(
    "enhancement",
    [
        "equalization",
        *(pytest.param(name, marks=pytest.mark.whole) for name in ("stretch", "none")),
    ],
)
def test_the_windows_own_picture_is_explained(enhancement: str) -> None:
    """Also with equalized histograms, which keep only the order of the column values."""
    scene = occ.load_preset("phone-136us").replace(enhancement=enhancement, columns=1728)
    columns = occ.render(scene, tolerance=math.inf).signal
    picture = np.repeat(columns.astype(np.uint8)[None], 40, 0)
    match = occ.match_photo(photo_of(picture), scene.replace(readout_time=1e-6))
    assert match.readout_time == pytest.approx(8e-6, rel=0.002)
    assert match.exposure_time == pytest.approx(136e-6, rel=0.1)
