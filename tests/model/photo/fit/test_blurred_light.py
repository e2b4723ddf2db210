"""The light of columns follows its exact integrals, and its blur has the stated moments."""

import math

import numpy as np
import pytest
from lit_fractions import blurred_light, light_of

from occ_model.photo.fit.seen_stripes import BlurShape, blur_kernel
from occ_model.photo.fit.timing import ChipLight, Timing

CODES = ("10", "0110", "1100", "10011010", "0111011")
TIMINGS = (Timing(0.13, 0.7, 3.3, 2.2), Timing(0.31, 5.4, 0.2, 2.2), Timing(0.05, 11.5, -7.6, 2.2))
COLUMNS = 150


def chips_of(code: str) -> np.ndarray:
    return np.array(list(code), dtype=np.uint8)


@pytest.mark.parametrize("code", CODES)
@pytest.mark.parametrize("timing", TIMINGS)
def test_the_light_of_chips_is_the_exact_exposure_integral(code: str, timing: Timing) -> None:
    chips = chips_of(code)
    lit = ChipLight(chips, COLUMNS).expose(timing).lit
    assert lit == pytest.approx(light_of(chips, timing, COLUMNS), abs=1e-9)


@pytest.mark.parametrize("longer", [-0.3, 0.25])
@pytest.mark.parametrize("code", CODES)
def test_each_time_on_is_longer_by_as_many_chips(code: str, longer: float) -> None:
    """An exposure of a whole period sees all of them, wherever it starts."""
    chips = chips_of(code)
    whole = Timing(0.17, float(len(chips)), 1.3, 2.2)
    lit = ChipLight(chips, COLUMNS).expose(whole, longer).lit
    pulses = np.count_nonzero(chips > np.roll(chips, 1))
    assert lit == pytest.approx((chips.sum() + pulses * longer) / len(chips), abs=1e-9)


def test_a_time_on_begins_earlier_and_ends_later_by_the_same() -> None:
    instant = Timing(0.01, 1e-6, 2.0, 2.2)
    lit = ChipLight(chips_of("0110"), 401).expose(instant, 0.3).lit
    on = instant.middle + 0.01 * (np.flatnonzero(lit > 0.5) - 200)
    assert (on.min(), on.max()) == pytest.approx((0.85, 3.15), abs=0.011)
    assert np.ptp(np.flatnonzero(lit > 0.5)) == len(on) - 1


@pytest.mark.parametrize("shape", ["normal", "box", "exponential"])
def test_blur_is_the_mean_over_neighbouring_columns_beyond_the_ends_too(shape: BlurShape) -> None:
    chips, timing = chips_of("10011010"), TIMINGS[0]
    wide = ChipLight(chips, COLUMNS + 16).expose(timing, 0.1).lit
    expected = np.convolve(wide, blur_kernel(1.3, shape), "valid")
    found = blurred_light(chips, COLUMNS, timing, 1.3, 0.1, shape)
    assert found == pytest.approx(expected, abs=1e-9)


def moment(kernel: np.ndarray, order: int) -> float:
    return float(kernel @ np.arange(-8.0, 9.0) ** order)


@pytest.mark.parametrize("shape", ["normal", "box", "exponential"])
@pytest.mark.parametrize("blur", [0.0, 0.4, 1.0, 1.7])
def test_blur_loses_no_light_and_shifts_none(shape: BlurShape, blur: float) -> None:
    kernel = blur_kernel(blur, shape)
    assert kernel.sum() == pytest.approx(1.0, abs=1e-12)
    assert kernel == pytest.approx(kernel[::-1], abs=1e-12)


@pytest.mark.parametrize("blur", [1.0, 1.4])
def test_normal_blur_has_its_deviation_and_no_excess_kurtosis(blur: float) -> None:
    kernel = blur_kernel(blur)
    assert moment(kernel, 2) == pytest.approx(blur**2, rel=1e-3)
    assert moment(kernel, 4) / moment(kernel, 2) ** 2 == pytest.approx(3.0, abs=0.01)


@pytest.mark.parametrize("blur", [0.1, 0.5, 1.0, 2.1])
def test_a_box_gives_each_column_the_fraction_that_it_covers(blur: float) -> None:
    half = math.sqrt(3.0) * blur
    rims = np.arange(-8.5, 9.0)
    below = np.clip((rims + half) / (2.0 * half), 0.0, 1.0)
    assert blur_kernel(blur, "box") == pytest.approx(np.diff(below), abs=1e-12)


@pytest.mark.parametrize("blur", [0.3, 0.6, 1.0])
def test_exponential_tails_decay_by_the_same_ratio_and_have_the_deviation(blur: float) -> None:
    kernel = blur_kernel(blur, "exponential")
    ratios = kernel[9:] / kernel[8:-1]
    assert ratios == pytest.approx(ratios[0], rel=1e-9)
    assert 0.0 < ratios[0] < 1.0
    assert moment(kernel, 2) == pytest.approx(blur**2, rel=5e-3)
