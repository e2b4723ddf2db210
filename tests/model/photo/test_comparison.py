"""A photo's profile is compared column by column, whatever its levels and its place."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import occ_model as occ

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
    if first + 499 * scale < 2:
        return
    found = occ.compare(flattened, SIMULATED, first, scale)
    assert found.first_column == max(first, 0)
    assert len(found.photo) == len(found.simulated)
    assert found.correlation > 0.995


def test_the_opposite_is_not_turned_round_to_fit() -> None:
    found = occ.compare(-SIMULATED, SIMULATED)
    assert found.correlation == pytest.approx(-1.0)
    assert np.allclose(found.photo, 2.0 * SIMULATED.mean() - SIMULATED)
    assert found.rmse == pytest.approx(2.0 * float(SIMULATED.std()))


def test_a_photo_of_something_else_keeps_its_stripes() -> None:
    found = occ.compare(np.sin(np.arange(300) / 3.7), SIMULATED)
    assert abs(found.correlation) < 0.2
    assert found.photo.std() == pytest.approx(SIMULATED.std())


def test_what_is_flat_correlates_with_nothing() -> None:
    assert occ.compare(np.ones(50), SIMULATED).correlation == 0.0
    assert occ.compare(SIMULATED, np.full(300, 7.0)).correlation == 0.0


@pytest.mark.parametrize("first", [-400.0, 299.5, 1e6])
def test_a_photo_beside_the_picture_is_refused(first: float) -> None:
    with pytest.raises(occ.MatchError, match="beside the simulated picture"):
        occ.compare(np.ones(300), SIMULATED, first)


@pytest.mark.parametrize(("first", "scale"), [(np.nan, 1.0), (np.inf, 1.0), (0.0, 0.0), (0.0, -1)])
def test_a_place_that_is_none_is_refused(first: float, scale: float) -> None:
    with pytest.raises(occ.MatchError, match="allowed: "):
        occ.compare(np.ones(300), SIMULATED, first, scale)
