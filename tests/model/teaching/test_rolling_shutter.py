"""The exposures shown of a rolling shutter add up to what the model's columns gather."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import occ_model as occ
from occ_model.scene.scene import Scene
from occ_model.teaching.light_over_columns import rolling_shutter


@settings(max_examples=60, deadline=None)
@given(
    st.floats(500.0, 3e4), st.floats(1e-5, 1e-3), st.floats(1e-6, 5e-5), st.floats(-2.0, 2.0),
    st.sampled_from(["", "10", "1101000"]),
)  # fmt: skip
def test_the_light_within_each_exposure_is_its_lit_fraction(
    frequency: float, exposure: float, readout: float, start: float, pattern: str
) -> None:
    scene = Scene().replace(
        switching_frequency=frequency, exposure_time=exposure, readout_time=readout,
        start_time=start, pattern=pattern, columns=400,
    )  # fmt: skip
    shown = rolling_shutter(scene)
    assert len(shown.columns) <= 25
    assert shown.edges[0] <= 0.0
    assert shown.edges[-1] >= shown.duration
    cumulated = np.concatenate([[0.0], np.cumsum(np.diff(shown.edges) * shown.lit)])
    ends = shown.starts + shown.exposure_time
    gathered = np.interp(ends, shown.edges, cumulated) - np.interp(
        shown.starts, shown.edges, cumulated
    )
    np.testing.assert_allclose(gathered / exposure, shown.lit_fraction, atol=1e-6)


def test_a_picture_of_two_columns_shows_both() -> None:
    shown = rolling_shutter(occ.load_preset("phone-68us").replace(columns=2))
    assert shown.columns.tolist() == [0, 1]


def test_the_shown_columns_begin_within_four_chips() -> None:
    scene = occ.load_preset("phone-68us").replace(switching_frequency=2e3)
    shown = rolling_shutter(scene)
    assert shown.starts[-1] == pytest.approx(4 * 500e-6, rel=0.01)


@pytest.mark.parametrize("shown", [2, 7, 25])
def test_as_many_columns_are_shown_as_asked_for_where_there_are_more(shown: int) -> None:
    scene = occ.load_preset("phone-68us").replace(switching_frequency=1e3)
    columns = rolling_shutter(scene, shown).columns
    assert len(columns) == shown
    assert columns[0] == 0
