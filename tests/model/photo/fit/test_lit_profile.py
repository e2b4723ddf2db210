"""The levels of a profile are those of weighted least squares, whatever is clipped or blurred."""

import numpy as np
import pytest
from lit_fractions import blurred_light

from occ_model.photo.fit.lit_profile import LitProfile, deviation_of
from occ_model.photo.fit.seen_stripes import BLUR_REACH, Seen, blur_kernel, blur_rows
from occ_model.photo.fit.timing import ChipLight, Timing
from occ_model.photo.fit.tone_curve import ToneCurve
from occ_model.photo.stripes.envelope import smooth_shapes
from occ_model.photo.stripes.evenly_lit import EvenProfile

COLUMNS, FREEDOM = 240, 3
CHIPS = np.array([1, 0, 0, 1, 1, 0, 1, 0], dtype=np.uint8)
TIMING = Timing(0.09, 0.6, 2.7, 2.2)
TABLE = ToneCurve(2.2, 0.03, 0.1, -0.1).table()
LIT = blurred_light(CHIPS, COLUMNS, TIMING, 0.8, 0.02)
SHARP = ChipLight(CHIPS, COLUMNS, BLUR_REACH).expose(TIMING, 0.02).lit
SHAPES = smooth_shapes(COLUMNS, FREEDOM)
DARK = SHAPES @ [0.05, 0.01, -0.005]
SWING = SHAPES @ [0.5, 0.08, -0.04]
SEEN = Seen(LIT, TABLE, None, blur_kernel(0.8))
NOISE = np.random.default_rng(7).normal(size=COLUMNS)
ALL = np.ones(COLUMNS, dtype=bool)


def profile_of(values: np.ndarray, kept: np.ndarray = ALL) -> LitProfile:
    return LitProfile(EvenProfile(values, kept, 20.0), FREEDOM, 4)


def test_a_profile_of_the_model_leaves_no_residual() -> None:
    values = TABLE.value_of(DARK + SWING * LIT)
    residual = profile_of(values).residual(SEEN)
    assert residual == pytest.approx(np.zeros(COLUMNS), abs=0.01)


@pytest.mark.parametrize("every", [1, 3])
def test_levels_are_those_of_weighted_least_squares(every: int) -> None:
    """Of the light that the grey levels tell, weighted by the grey levels' slope."""
    values = TABLE.value_of(DARK + SWING * LIT) + 3.0 * NOISE
    kept = np.arange(COLUMNS) % every == 0
    data, weight = values[kept], TABLE.slope_at(values[kept])
    model = np.hstack([SHAPES, SHAPES * LIT[:, None]])[kept]
    levels = np.linalg.lstsq(
        model * weight[:, None], TABLE.light_of(data) * weight, rcond=None
    )[0]  # fmt: skip
    residual = profile_of(values, kept).residual(SEEN)
    assert residual == pytest.approx(data - TABLE.value_of(model @ levels), abs=1e-3)


def test_blurred_grey_levels_of_the_model_leave_next_to_no_residual() -> None:
    """Levels that are found as if light were blurred are off, and are corrected."""
    kernel = blur_kernel(1.5)
    dark, swing = (np.pad(levels, BLUR_REACH, mode="edge") for levels in (DARK, SWING))
    values = blur_rows(TABLE.value_of(dark + swing * SHARP), kernel)
    lit = blurred_light(CHIPS, COLUMNS, TIMING, 1.5, 0.02)
    part = profile_of(values)
    as_values = part.residual(Seen(lit, TABLE, SHARP, kernel))
    as_light = part.residual(Seen(lit, TABLE, None, kernel))
    assert np.std(as_light) > 1.0
    assert np.std(as_values) < 0.1 * np.std(as_light)


def test_dark_columns_beside_bright_ones_are_followed_where_grey_levels_are_blurred() -> None:
    """Blur hides their light, as the tone curve is steep near black: it takes several steps."""
    kernel = blur_kernel(1.5)
    dark, swing = np.full(COLUMNS + 2 * BLUR_REACH, 0.001), np.pad(SWING, BLUR_REACH, mode="edge")
    table = ToneCurve(2.2).table()
    values = blur_rows(table.value_of(dark + swing * SHARP), kernel)
    lit = blurred_light(CHIPS, COLUMNS, TIMING, 1.5, 0.02)
    residual = profile_of(values).residual(Seen(lit, table, SHARP, kernel))
    assert residual == pytest.approx(np.zeros(COLUMNS), abs=0.02)


def test_slow_shapes_are_orthonormal_and_hold_what_is_slow() -> None:
    part = profile_of(TABLE.value_of(DARK + SWING * LIT))
    noise = 1.0 + 0.5 * LIT
    basis = part.slow(noise)
    assert basis.shape == (4, COLUMNS)
    assert basis @ basis.T == pytest.approx(np.eye(4), abs=1e-9)
    slow = smooth_shapes(COLUMNS, 4) @ [1.0, -2.0, 0.5, 3.0] / noise
    assert basis.T @ (basis @ slow) == pytest.approx(slow, abs=1e-9)


def test_few_columns_give_up_few_shapes() -> None:
    few = np.arange(COLUMNS) < 24
    part = profile_of(TABLE.value_of(DARK + SWING * LIT), few)
    assert part.slow(np.ones(24)).shape == (3, 24)


def test_a_columns_slope_is_the_steepest_of_it_and_its_neighbours() -> None:
    values = np.where(np.arange(COLUMNS) < 100, 20.0, 120.0)
    part = profile_of(values)
    assert np.flatnonzero(part.slope).tolist() == [98, 99, 100, 101]
    assert part.slope.max() == 50.0


def test_noise_is_found_on_plateaus_and_on_edges() -> None:
    """Variance rises with the square of the slope; the fitted parameters are allowed for."""
    random = np.random.default_rng(11)
    slope = np.abs(random.normal(size=4_000)) * 30.0
    true = np.hypot(0.7, 0.1 * slope)
    found = deviation_of(true * random.normal(size=4_000), slope, 0.0)
    assert found == pytest.approx(true, rel=0.12)
    few = deviation_of(np.ones(40), np.zeros(40), 10.0)
    assert few == pytest.approx(np.sqrt(2.0), rel=1e-6)


def test_noise_is_never_less_than_can_be_known() -> None:
    exact = deviation_of(np.zeros(100), np.linspace(0.0, 50.0, 100), 3.0)
    assert (exact > 0.0).all()
    falling = deviation_of(np.linspace(2.0, 0.0, 100), np.linspace(0.0, 50.0, 100), 3.0)
    assert falling == pytest.approx(falling[0])
