"""The equalizer undoes the exposure where possible, and says where it cannot."""

from typing import Any

import numpy as np
import pytest

import occ_model as occ
from occ_model.arrays import FloatArray
from occ_model.receiver.equalizer import box, response, undo_exposure
from occ_model.scene.scene import Scene

BEYOND = (14e3, 16e3, 20e3, 26e3)
"""Frequencies at 136 us at which the threshold decoder reads nothing."""


def codes_read(decoder: str, **changes: Any) -> int:
    """Count the codes read, of eight pictures of few rows."""
    random, right = np.random.default_rng(5), 0
    for code in random.integers(0, 1024, 8).tolist():
        scene = occ.load_preset("phone-136us").replace(rows=16, code=code, **changes)
        duration = 24.0 * scene.transmitter.switching_period
        scene = scene.replace(start_time=float(random.uniform(0.0, duration)))
        right += occ.decode(occ.render(scene).signal, scene, decoder).code == code
    return right


@pytest.mark.parametrize("columns", [1.0, 2.0, 2.5, 7.0, 8.5, 17.0, 62.5])
def test_the_box_is_the_exposures_fraction_of_each_column(columns: float) -> None:
    taps = box(columns)
    assert len(taps) % 2 == 1
    assert taps.sum() == pytest.approx(1.0)
    np.testing.assert_allclose(taps, taps[::-1])
    # Its middle columns are covered completely.
    assert taps.max() == pytest.approx(1.0 / columns)
    assert np.count_nonzero(taps > 0.0) == pytest.approx(columns, abs=2.0)


@pytest.mark.parametrize("columns", [7, 17, 63])
def test_the_response_of_an_exposure_is_that_of_a_mean_over_columns(columns: int) -> None:
    # The closed form of a sum of equal steps is Dirichlet's kernel.
    frequency = np.arange(1, 2049) / 4096
    kernel = np.sin(np.pi * frequency * columns) / (columns * np.sin(np.pi * frequency))
    np.testing.assert_allclose(response(columns, 4096)[1:], kernel, atol=1e-12)


def chips_in_columns(count: int, chip: int) -> FloatArray:
    random = np.random.default_rng(2)
    return np.repeat(random.integers(0, 2, count), chip).astype(np.float64)


def expose(light: FloatArray, columns: float) -> FloatArray:
    return np.convolve(light, box(columns), "same")


def error(light: FloatArray, found: FloatArray) -> float:
    """Return the root mean square error, away from the ends."""
    return float(np.sqrt(np.mean((light - found)[200:-200] ** 2)))


@pytest.mark.parametrize("exposure", [9.0, 40.0])
def test_an_exposure_without_noise_is_undone(exposure: float) -> None:
    light = chips_in_columns(200, 12)
    seen = expose(light, exposure)
    assert error(light, undo_exposure(seen, exposure, 12.0)) < 0.5 * error(light, seen)


def test_mmse_errs_less_than_zero_forcing_in_noise() -> None:
    light = chips_in_columns(300, 12)
    for noise in (0.003, 0.01, 0.05):
        random = np.random.default_rng(1)
        seen = expose(light, 17.0) + noise * random.standard_normal(len(light))
        mmse = error(light, undo_exposure(seen, 17.0, 12.0, "mmse"))
        forced = error(light, undo_exposure(seen, 17.0, 12.0, "zero-forcing"))
        assert mmse < forced
        # An output without stripes would have an error of a half; the least-error filter has less.
        assert mmse < 0.5


def test_more_noise_never_makes_the_filter_amplify_more() -> None:
    light = chips_in_columns(300, 12)
    seen = expose(light, 17.0)
    swings = []
    for noise in (0.0, 0.01, 0.1, 1.0):
        random = np.random.default_rng(1)
        found = undo_exposure(seen + noise * random.standard_normal(len(seen)), 17.0, 12.0)
        swings.append(float(np.std(found - seen)) if noise == 0.0 else float(np.std(found)))
    assert swings[1] > swings[2] > swings[3]


def test_codes_are_read_beyond_the_threshold_decoders_end() -> None:
    for frequency in BEYOND:
        settings: dict[str, Any] = {"switching_frequency": frequency, "enhancement": "none"}
        assert codes_read("threshold", **settings) == 0
        assert codes_read("equalizer", **settings) >= 7


@pytest.mark.parametrize("averaging", ["pixel-value", "light"])
def test_the_tone_curve_is_undone_first(averaging: str) -> None:
    settings: dict[str, Any] = {
        "switching_frequency": 18e3,
        "enhancement": "none",
        "averaging": averaging,
    }
    assert codes_read("equalizer", **settings) >= 7


def test_any_payload_is_read_without_a_list_of_codes() -> None:
    scene = occ.load_preset("phone-136us").replace(
        rows=60, payload="text:HELLO", line_code="4b6b", framing="raw", distance=0.5,
        enhancement="none", switching_frequency=16e3,
    )  # fmt: skip
    signal = occ.render(scene).signal
    assert occ.decode(signal, scene).payload != "HELLO"
    assert occ.decode(signal, scene, "equalizer").payload == "HELLO"


def test_a_failure_of_an_enhanced_picture_says_why_it_cannot_be_undone() -> None:
    scene = Scene().replace(rows=60, exposure_time=136e-6, switching_frequency=60e3)
    result = occ.decode(occ.render(scene).signal, scene, "equalizer")
    assert "enhanced by equalization" in result.failure
    plain = scene.replace(enhancement="none")
    other = occ.decode(occ.render(plain).signal, plain, "equalizer").failure
    assert "enhanced" not in (other or "")


def test_an_exposure_of_most_of_the_picture_is_refused() -> None:
    scene = Scene().replace(exposure_time=20e-3, readout_time=8e-6)
    failure = occ.decode(np.resize([0.0, 200.0], 3456), scene, "equalizer").failure
    assert "2.5e+03 of the 3456 columns" in failure


def test_the_equalizer_is_a_parameter_of_the_receiver() -> None:
    scene = Scene().replace(
        rows=60, exposure_time=136e-6, switching_frequency=20e3, enhancement="none"
    )
    signal = occ.render(scene).signal
    mmse = occ.decode(signal, scene, "equalizer").equalized
    forced = occ.decode(signal, scene.replace(equalizer="zero-forcing"), "equalizer").equalized
    assert mmse is not None
    assert forced is not None
    assert np.std(forced) > np.std(mmse)
