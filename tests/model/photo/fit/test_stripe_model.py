"""The model of one profile: levels by least squares, and what its fit states."""

import math
from dataclasses import replace

import numpy as np
import pytest
from lit_fractions import light_of

from occ_model.photo.fit.camera_response import PixelResponse
from occ_model.photo.fit.least_squares import StripeModel, level_freedom
from occ_model.photo.fit.timing import Timing
from occ_model.photo.stripes.envelope import smooth_shapes

CHIPS = np.array([1, 0, 0, 1, 1, 0, 1, 0], dtype=np.uint8)
COLUMNS = 300
TRUE = Timing(0.09, 0.6, 2.7, 1.0)
LIT = light_of(CHIPS, TRUE, COLUMNS)
SHAPES = smooth_shapes(COLUMNS, 4)
LOW, SWING = SHAPES @ [30.0, 4.0, -2.0, 1.0], SHAPES @ [120.0, -15.0, 8.0, 0.0]
PROFILE = LOW + SWING * LIT


class Power(PixelResponse):
    def __call__(self, lit: np.ndarray, gamma: float) -> np.ndarray:
        return lit**gamma

    def rates(self, lit: np.ndarray, gamma: float) -> tuple[np.ndarray, np.ndarray]:
        steady = np.maximum(lit, 1e-9)
        return gamma * steady ** (gamma - 1.0), np.log(steady) * steady**gamma


def model_of(profile: np.ndarray = PROFILE) -> StripeModel:
    return StripeModel(profile, CHIPS, Power(), TRUE.step)


def test_levels_are_those_of_least_squares() -> None:
    noisy = PROFILE + np.random.default_rng(2).normal(size=COLUMNS)
    parts = np.hstack([SHAPES, SHAPES * LIT[:, None]])
    weights = np.linalg.lstsq(parts, noisy, rcond=None)[0]
    low, swing, profile = model_of(noisy).levels(TRUE)
    assert low == pytest.approx(SHAPES @ weights[:4], abs=1e-4)
    assert swing == pytest.approx(SHAPES @ weights[4:], abs=1e-4)
    assert profile == pytest.approx(parts @ weights, abs=1e-4)


def test_columns_at_white_are_left_out_while_enough_are_not() -> None:
    high = PROFILE + 120.0
    low, swing, profile = model_of(np.minimum(high, 255.0)).levels(TRUE)
    assert (low, swing) == (pytest.approx(LOW + 120.0, abs=0.01), pytest.approx(SWING, abs=0.01))
    assert profile == pytest.approx(np.minimum(high, 255.0), abs=0.01)
    # Where nearly all are white they are all that there is.
    _, _, white = model_of(np.minimum(PROFILE + 225.0, 255.0)).levels(TRUE)
    assert white.max() == pytest.approx(255.0, abs=0.5)


def test_levels_have_a_parameter_for_each_six_chips_within_bounds() -> None:
    assert [level_freedom(chips) for chips in (0.0, 24.0, 29.9, 30.0, 1e6)] == [4, 4, 4, 5, 8]


def test_the_correlation_is_that_of_the_stripes_without_uneven_light() -> None:
    """Alike where nothing varies but the stripes: Pearson's coefficient."""
    flat = 40.0 + 100.0 * LIT + 12.0 * np.random.default_rng(4).normal(size=COLUMNS)
    fit = StripeModel(flat, CHIPS, Power(), 0.01).describe(TRUE, np.zeros((4, 4)))
    expected = np.corrcoef(flat, 40.0 + 100.0 * LIT)[0, 1]
    assert expected < fit.correlation < expected + 1e-3  # levels follow some of the noise
    assert fit.residual == pytest.approx(float(((flat - fit.profile) ** 2).sum()))


@pytest.mark.parametrize(("sign", "dark"), [(-1.0, 150.0), (1.0, -60.0)])
def test_lit_darker_than_dark_or_dark_darker_than_black_is_no_picture(
    sign: float, dark: float
) -> None:
    model = model_of(dark + sign * 100.0 * LIT)
    assert not model.describe(TRUE, np.zeros((4, 4))).is_possible


def test_the_dark_may_be_a_little_below_black_by_noise() -> None:
    possible = [
        model_of(dark + 100.0 * LIT).describe(TRUE, np.zeros((4, 4))).is_possible
        for dark in (-5.0, -15.0)
    ]
    assert possible == [True, False]


@pytest.mark.parametrize("exposure", [0.02, 0.6, 3.4])
def test_blur_may_have_lengthened_an_exposure(exposure: float) -> None:
    """By what keeps an edge's variance t^2/12 + b^2 to second order, and by its width at most."""
    true = replace(TRUE, exposure=exposure)
    profile = 20.0 + 150.0 * light_of(CHIPS, true, COLUMNS)
    fit = model_of(profile).fit(true)
    blur = 0.4 * TRUE.step
    expected = min(6.0 * blur**2 / exposure, math.sqrt(12.0) * blur)
    assert math.sqrt(fit.covariance[1, 1]) == pytest.approx(expected, rel=1e-4)


def test_a_fit_states_what_noise_does_to_it() -> None:
    """The covariance of least squares: of 30 fits the deviations are as stated, to a third."""
    random = np.random.default_rng(9)
    fits = [model_of(PROFILE + random.normal(size=COLUMNS)).fit(TRUE) for _ in range(30)]
    for name, place in (("step", 0), ("middle", 2)):
        found = np.array([getattr(fit.timing, name) for fit in fits])
        stated = np.sqrt(np.mean([fit.covariance[place, place] for fit in fits]))
        assert 0.65 < np.std(found) / stated < 1.5
        assert abs(found.mean() - getattr(TRUE, name)) < stated
    assert all(fit.covariance[3, 3] == 0.0 for fit in fits)


def test_white_columns_do_not_change_with_the_timing() -> None:
    model = model_of(np.minimum(PROFILE + 120.0, 255.0))
    white = PROFILE + 120.0 > 256.0
    slopes = model.slopes(TRUE)
    assert not slopes[white].any()
    assert np.abs(slopes[~white]).max() > 1.0


def test_stripes_that_vanish_are_taken_for_a_twentieth_of_the_highest_ones() -> None:
    """Whoever flattens divides by their height: it is never next to nothing."""
    shapes = smooth_shapes(COLUMNS, 2)
    fading = shapes @ [61.0, 60.0]
    fit = model_of(30.0 + fading * LIT).describe(TRUE, np.zeros((4, 4)))
    assert fit.swing.max() == pytest.approx(121.0, rel=0.02)
    assert fit.swing.min() == pytest.approx(0.05 * fit.swing.max())
