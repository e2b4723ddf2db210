"""Levels by normal equations, and those by which further columns are at least white."""

import numpy as np
import pytest

from occ_model.photo.fit.normal_equations import at_least_one
from occ_model.photo.stripes.envelope import smooth_shapes

COLUMNS, WEIGHT = 200, 25.0


@pytest.mark.parametrize("freedom", [2, 4])
def test_levels_by_which_columns_are_at_least_one_leave_the_misfit_no_slope(freedom: int) -> None:
    """Where only the darkest columns are seen, whole steps of Newton's go round in circles."""
    for seed in range(40):
        random = np.random.default_rng(seed)
        lit, shapes = random.uniform(size=COLUMNS), smooth_shapes(COLUMNS, freedom)
        model = np.hstack([shapes, shapes * lit[:, None]])
        light = 0.1 + 2.0 * lit
        seen, white = lit < 0.06, light > 1.0
        values = light[seen] + 0.02 * random.normal(size=int(seen.sum()))
        matrix, sums, columns = model[seen].T @ model[seen], model[seen].T @ values, model[white].T
        guess = random.integers(2, size=int(white.sum())).astype(bool)
        together, levels, below = at_least_one(matrix, sums, columns, WEIGHT, guess)
        np.testing.assert_array_equal(below, levels @ columns < 1.0)
        some = columns[:, below]
        pull = sums + WEIGHT * some.sum(axis=1)
        np.testing.assert_allclose(together @ levels, pull, atol=1e-9 * np.abs(pull).max())
        added = together - matrix - WEIGHT * some @ some.T
        assert np.abs(added).max() < 1e-6 * np.trace(together)
