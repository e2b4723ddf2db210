"""A photo's profile is compared column by column, whatever its levels and its place."""

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

import occ_model as occ
from occ_model.photo.comparison import RIM

SIMULATED = 100.0 + 60.0 * np.sin(np.arange(300) / 9.0)


@given(gain=st.floats(0.01, 5.0), lift=st.floats(-3.0, 3.0))
def test_levels_do_not_matter(gain: float, lift: float) -> None:
    found = occ.compare(lift + gain * SIMULATED, SIMULATED)
    assert found.correlation == pytest.approx(1.0)
    assert found.rmse == pytest.approx(0.0, abs=1e-6)
    assert np.allclose(found.photo, found.simulated)


@given(first=st.integers(-100, 250), scale=st.floats(0.3, 3.0))
def test_a_moved_and_scaled_photo_is_compared_where_it_lies(first: int, scale: float) -> None:
    columns = np.arange(500)
    flattened = np.sin((first + columns * scale) / 9.0)
    if first + RIM * scale > 295 or first + (499 - RIM) * scale < 5:
        return
    found = occ.compare(flattened, SIMULATED, first, scale)
    assert found.first_column == max(math.ceil(first + RIM * scale), 0)
    assert len(found.photo) == len(found.simulated)
    assert found.correlation > 0.995


def test_light_that_varies_slowly_does_not_matter() -> None:
    even, place = 100.0 + 60.0 * np.sin(np.arange(700) / 9.0), np.linspace(-1.0, 1.0, 700)
    dimmed = (1.0 + 0.4 * place) * even + 30.0 * place**2
    for photo, simulated in ((even, dimmed), (dimmed, even)):
        found = occ.compare(photo, simulated)
        assert found.correlation > 0.999
        assert found.rmse < 0.05 * simulated.std()


def test_the_blurred_rim_of_a_lamp_does_not_count() -> None:
    photo = SIMULATED.copy()
    photo[[0, 2, 4, -5, -3, -1]] = 0.0
    found = occ.compare(photo, SIMULATED)
    assert (found.correlation, found.rmse) == pytest.approx((1.0, 0.0), abs=1e-6)


def test_the_opposite_is_not_turned_round_to_fit() -> None:
    found = occ.compare(-SIMULATED, SIMULATED)
    assert found.correlation == pytest.approx(-1.0)
    assert found.rmse == pytest.approx(2.0 * float(found.simulated.std()), rel=0.02)


def test_a_photo_of_something_else_keeps_its_stripes() -> None:
    found = occ.compare(np.sin(np.arange(300) / 3.7), SIMULATED)
    assert abs(found.correlation) < 0.2
    assert found.photo.std() == pytest.approx(found.simulated.std(), rel=0.01)


def test_what_is_flat_correlates_with_nothing() -> None:
    assert occ.compare(np.ones(50), SIMULATED).correlation == 0.0
    assert occ.compare(SIMULATED, np.full(300, 7.0)).correlation == 0.0


@pytest.mark.parametrize(
    ("first", "scale", "why"),
    [
        (
            -400.0,
            1.0,
            "lies from column -394 to -107 of the simulated picture, which has 300 columns",
        ),
        (299.5, 1.0, "lies from column 305.5 to 592.5 of"),
        *((first, 1.0, "covers fewer than two; move") for first in (1e6, -1e308)),
        # On the panel, and smaller than a column of it.
        (50.0, 1e-3, "lies from column 50.01 to 50.29 of"),
        *((0.0, np.float64(scale), "to inf of the simulated") for scale in (1e306, 1e308)),
        *((first, scale, "allowed: ") for first, scale in ((np.nan, 1.0), (np.inf, 1.0))),
        *((0.0, scale, "allowed: ") for scale in (0.0, -1.0)),
    ],
)
def test_a_place_beside_the_picture_or_none_is_refused(
    first: float, scale: float, why: str
) -> None:
    with pytest.raises(occ.MatchError, match=why):
        occ.compare(np.ones(300), SIMULATED, first, scale)
