"""Columns near bright cells: the law of a cell that is bright enough in any of its rows."""

import numpy as np
import pytest
from numpy.typing import NDArray

from occ_model.receiver.locate import least_bright_share
from occ_model.results import Region
from occ_model.study.noisy_columns import _near_cells

CELL, CELLS = 4, 12


def near(bright: NDArray[np.float64], rows: int, seed: int = 1) -> NDArray[np.bool_]:
    span = Region(0, rows, 0, len(bright))
    return np.asarray(_near_cells(bright, CELL, span, np.random.default_rng(seed)))


@pytest.mark.parametrize(("first", "last"), [(3, 3), (2, 7), (0, 4), (6, 11)])
def test_columns_count_from_one_cell_before_the_bright_ones_to_one_after(
    first: int, last: int
) -> None:
    bright = np.zeros(CELL * CELLS)
    bright[CELL * first : CELL * (last + 1)] = 1.0
    expected = np.zeros(CELL * CELLS, dtype=bool)
    expected[max(first - 1, 0) * CELL : (last + 2) * CELL] = True
    np.testing.assert_array_equal(near(bright, rows=40), expected)


def test_where_no_cell_is_bright_enough_every_column_counts() -> None:
    assert near(np.zeros(CELL * CELLS), rows=40).all()


@pytest.mark.parametrize(("share", "rows"), [(0.05, 4), (0.1, 4), (0.03, 40), (0.0, 40)])
def test_a_cell_is_bright_as_often_as_among_pixels_drawn_one_by_one(
    share: float, rows: int
) -> None:
    bright = np.zeros(CELL * CELLS)
    bright[CELL * 5 : CELL * 6] = share
    trials = 3000
    # One cell that is bright leaves the columns far from it out.
    found = np.mean([not near(bright, rows, seed)[0] for seed in range(trials)])
    random = np.random.default_rng(7)
    counts = random.binomial(CELL * CELL, share, (trials, rows // CELL))
    expected = np.mean((counts > least_bright_share() * CELL * CELL).any(axis=1))
    assert found == pytest.approx(expected, abs=5.0 * np.sqrt(0.5 / trials))
