"""An image averaged over a grid: exact, and without false stripes wherever the grid lies."""

import numpy as np
import pytest
from amount import amount
from gui.kinds import Grey, not_none
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PySide6.QtCore import QRectF

from occ_gui.picture.photo_overlay import cell_means, difference_cells


def noise(rows: int, columns: int) -> Grey:
    return np.random.default_rng(rows * columns).integers(0, 256, (rows, columns), dtype=np.uint8)


def by_hand(image: Grey, grid: QRectF, shape: tuple[int, int]) -> NDArray[np.float64]:
    """Cut every pixel into 16 x 16 parts and average those in each cell."""
    fine = image.astype(np.float64).repeat(16, axis=0).repeat(16, axis=1)
    top, left = round(16 * grid.top()), round(16 * grid.left())
    part = fine[top : top + round(16 * grid.height()), left : left + round(16 * grid.width())]
    high, wide = part.shape[0] // shape[0], part.shape[1] // shape[1]
    cells = part[: high * shape[0], : wide * shape[1]].reshape(shape[0], high, shape[1], wide)
    return np.asarray(cells.mean(axis=(1, 3)))


@settings(max_examples=amount(30, 60))
@given(
    st.integers(0, 40), st.integers(0, 40), st.integers(1, 8), st.integers(1, 8),
    st.integers(1, 40), st.integers(1, 40),
)  # fmt: skip
def test_a_cell_holds_the_exact_mean_of_what_lies_under_it(
    left: int, top: int, columns: int, rows: int, wide: int, high: int
) -> None:
    image = noise(30, 25)
    # Cells of up to 2.5 pixels, in sixteenths.
    grid = QRectF(left / 16, top / 16, columns * wide / 16, rows * high / 16)
    means = cell_means(image, QRectF(0, 0, 25, 30), grid, (rows, columns))
    assert means == pytest.approx(by_hand(image, grid, (rows, columns)), abs=1e-6)


def test_where_the_image_lies_counts_and_not_only_the_grid() -> None:
    image = noise(20, 20)
    plain = cell_means(image, QRectF(0, 0, 20, 20), QRectF(2, 3, 10, 8), (4, 5))
    scaled = cell_means(image, QRectF(100, -50, 60, 60), QRectF(106, -41, 30, 24), (4, 5))
    assert scaled == pytest.approx(plain)


@pytest.mark.parametrize("shift", [0.0, 0.3, 1.7])
@pytest.mark.parametrize("cells", [37, 101, 250, 999])
def test_fine_stripes_in_coarse_cells_are_grey_without_aliasing(cells: int, shift: float) -> None:
    period, columns = 4, 4000
    stripes = np.where(np.arange(columns) % period < period // 2, 0, 255).astype(np.uint8)
    image = np.tile(stripes, (8, 1))
    grid = QRectF(shift, 0, columns - 8, 8)
    means = cell_means(image, QRectF(0, 0, columns, 8), grid, (1, cells))
    wide = (columns - 8) / cells
    over = min(wide % period, period - wide % period)
    assert np.abs(means - 127.5).max() <= 255 * 0.5 * over / wide + 3


def test_a_cell_smaller_than_a_pixel_shows_that_pixel() -> None:
    image = np.array([[10, 200]], dtype=np.uint8)
    means = cell_means(image, QRectF(0, 0, 2, 1), QRectF(0, 0, 2, 1), (1, 8))
    assert means.tolist() == [[10.0] * 4 + [200.0] * 4]


def test_a_large_image_is_averaged_to_within_two_levels() -> None:
    image = noise(1203, 1601)
    means = cell_means(image, QRectF(0, 0, 1601, 1203), QRectF(1, 1, 1600, 1200), (6, 8))
    exact = image[1:1201, 1:1601].reshape(6, 200, 8, 200).mean(axis=(1, 3))
    assert np.abs(means - exact).max() < 2.0


@pytest.mark.parametrize("width", [1e-13, 1e-9, 0.5])
@pytest.mark.parametrize("place", [0.0, 9.999999999999998, 10.0])
def test_a_grid_at_the_very_edge_has_means_too(place: float, width: float) -> None:
    image = noise(10, 10)
    grid = QRectF(place, place, width, width)
    means = cell_means(image, QRectF(0, 0, 10, 10), grid, (2, 3))
    assert means.shape == (2, 3)
    assert np.isfinite(means).all()


def test_cells_of_a_difference_cover_the_overlap_alone() -> None:
    first = (np.full((40, 60), 90, dtype=np.uint8), QRectF(-0.5, -0.5, 60.0, 40.0))
    second = (np.full((40, 60), 65, dtype=np.uint8), QRectF(29.5, 9.5, 60.0, 40.0))
    found = not_none(difference_cells(first, second, 900))
    levels, grid = found
    assert grid == QRectF(29.5, 9.5, 30.0, 30.0)
    assert levels.shape == (30, 30)
    assert np.allclose(levels, 25.0)
    few = not_none(difference_cells(first, second, 10))
    assert few[0].shape == (10, 10)
    assert difference_cells(first, (second[0], QRectF(100.0, 0.0, 60.0, 40.0)), 900) is None
