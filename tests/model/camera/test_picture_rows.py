"""Rows of a picture: how they are divided, and what stands for them."""

import numpy as np
import pytest

from occ_model.camera.picture_rows import Rim, Rows, split_at


@pytest.mark.parametrize("step", [1, 3])
@pytest.mark.parametrize("places", [(), (20,), (25, 31), (0, 20, 64, 99), (70, 40)])
def test_a_band_is_divided_before_the_rows_named_and_nowhere_else(
    places: tuple[int, ...], step: int
) -> None:
    band = range(20, 64, step)
    parts = [part for part in split_at(band, places) if part]
    assert [row for part in parts for row in part] == list(band)
    after = {next((row for row in band if row >= place), None) for place in places}
    assert {part[0] for part in parts} == {20} | (after - {None})


def test_rows_without_weights_are_the_same_rows() -> None:
    random = np.random.default_rng(3)
    nodes = random.random((2, 6), dtype=np.float32)
    weights = np.array([[1.0, 0.0], [0.5, 0.5], [0.0, 1.0]], dtype=np.float32)
    rim = Rim(slice(1, 3), np.full((3, 2), 7.0, dtype=np.float32), np.ones((3, 2), dtype=bool))
    rows = Rows(range(3), nodes, weights, (rim,), (slice(3, 5),))
    each = rows.each_row()
    np.testing.assert_allclose(each.values, rows.values, rtol=1e-6)
    # What is not smooth may be done to them now.
    squared = each.changed(np.square)
    np.testing.assert_allclose(squared.values, rows.values**2, rtol=1e-6)
