"""Curves and pictures are reduced to a screen, and drawn, without losing light or extremes."""

from itertools import pairwise

import cv2
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from occ_gui.simulation.snapshot import mean_of_cells
from occ_gui.story.curve_lines import DASH, keep_extremes, make_lines
from occ_gui.story.stripes_row import resample


@pytest.fixture
def stairs() -> tuple[np.ndarray, np.ndarray]:
    """Tops, slopes and noise, as profiles have them."""
    tops = np.repeat([20.0, 180.0, 180.0, 40.0], 25)
    slopes = np.interp(np.arange(100.0), np.arange(0.0, 101.0, 20.0), [5, 90, 10, 10, 200, 0])
    noise = np.random.default_rng(4).normal(100.0, 3.0, 50)
    ys = np.concatenate([tops, slopes, noise])
    return 96.0 + 1.7 * np.arange(len(ys)), ys


def test_every_point_lies_on_a_line(stairs: tuple[np.ndarray, np.ndarray]) -> None:
    xs, ys = stairs
    lines = make_lines(xs, ys)
    ends = [*(line.p1() for line in lines), lines[-1].p2()]
    drawn = np.interp(xs, [end.x() for end in ends], [end.y() for end in ends])
    np.testing.assert_allclose(drawn, ys, atol=1e-4)
    assert (ends[0].x(), ends[-1].x()) == (xs[0], xs[-1])
    assert all(one.p2() == other.p1() for one, other in pairwise(lines))


def test_a_straight_part_is_one_line(stairs: tuple[np.ndarray, np.ndarray]) -> None:
    xs, ys = stairs
    assert len(make_lines(xs[:100], ys[:100])) == 5  # three tops, and two edges between them
    assert len(make_lines(xs, 0.3 * xs - 2.0)) == 1


def test_dashes_cover_their_fraction_of_the_curve(stairs: tuple[np.ndarray, np.ndarray]) -> None:
    xs, ys = stairs
    curves = make_lines(xs, ys), make_lines(xs, ys, DASH)
    solid, dashed = (sum(line.length() for line in lines) for lines in curves)
    assert solid == pytest.approx(np.hypot(np.diff(xs), np.diff(ys)).sum())
    assert dashed / solid == pytest.approx(DASH[0] / sum(DASH), abs=0.02)
    for line in make_lines(xs, ys, DASH):
        middle = (line.x1() + line.x2()) / 2
        assert (line.y1() + line.y2()) / 2 == pytest.approx(np.interp(middle, xs, ys), abs=1e-4)


COLUMNS = 40


def picture(rows: int = 6) -> np.ndarray[tuple[int, int], np.dtype[np.uint8]]:
    levels = np.random.default_rng(5).integers(0, 256, COLUMNS, dtype=np.uint8)
    return np.tile(levels, (rows, 1))


@settings(max_examples=20, deadline=None)
@given(first=st.floats(0.0, 20.0), span=st.floats(0.5, 19.9), cells=st.integers(1, 90))
def test_a_cell_is_the_mean_of_the_columns_under_it(first: float, span: float, cells: int) -> None:
    pixels = picture()
    edges = np.linspace(first, first + span, cells + 1)
    resampled = resample(pixels, edges, 4)
    assert resampled.shape == (4, cells)
    fine = np.linspace(0.0, 1.0, 2001)[:-1] + 0.5 / 2000
    for cell in range(cells):
        under = edges[cell] + fine * (edges[cell + 1] - edges[cell])
        mean = pixels[0, under.astype(int)].mean()
        assert resampled[:, cell] == pytest.approx(mean, abs=0.8)


def test_fine_stripes_of_rows_become_grey() -> None:
    fine = np.tile(np.array([[0], [200]], dtype=np.uint8), (30, 10))
    np.testing.assert_array_equal(resample(fine, np.arange(11.0), 10), 100)


def test_the_outer_columns_continue_beyond_the_picture() -> None:
    pixels = picture()
    row = resample(pixels, np.array([-4.0, -2.0, 0.0, 40.0, 41.0, 43.0]), 3)[0]
    assert row[0] == row[1] == pixels[0, 0]
    assert row[-1] == row[-2] == pixels[0, -1]


@pytest.mark.parametrize("cells", [7, 100, 999, 5000])
def test_a_reduced_curve_keeps_its_extremes_and_its_ends(cells: int) -> None:
    positions = np.arange(3000.0)
    values = np.random.default_rng(2).normal(size=3000)
    values[1234], values[77] = 50.0, -40.0
    x, y = keep_extremes(positions, values, 0.0, 2999.0, cells)
    assert (y.max(), y.min()) == (50.0, -40.0)
    assert (x[0], x[-1]) == (0.0, 2999.0)
    assert (np.diff(x) > 0).all()
    np.testing.assert_array_equal(values[x.astype(int)], y)
    assert len(x) <= max(3000 // max(1, 3000 // cells) * 2 + 2 * cells, 3000)


def test_only_points_in_view_are_kept() -> None:
    positions = np.arange(3000.0)
    x, _ = keep_extremes(positions, positions, 1000.5, 1010.5, 800)
    np.testing.assert_array_equal(x, np.arange(1000.0, 1012.0))


@pytest.mark.parametrize("size", [(419, 864), (1152, 864), (64, 80)])
def test_a_shrunk_picture_has_the_means_of_its_cells(size: tuple[int, int]) -> None:
    rows, columns = 40, 50
    y, x = np.meshgrid(*(np.linspace(0.0, np.pi, side) for side in size), indexing="ij")
    picture = (120.0 + 100.0 * np.sin(x) * np.cos(y)).astype(np.uint8)
    exact = cv2.resize(picture, (columns, rows), interpolation=cv2.INTER_AREA)
    small = mean_of_cells(picture, columns, rows)
    assert small.shape == (rows, columns)
    a_cell = 100.0 * np.pi / min(rows, columns)  # the most by which neighbours differ
    assert np.abs(small.astype(int) - exact).max() <= a_cell / 2 + 1


def test_stripes_of_a_draft_of_few_rows_are_averaged() -> None:
    stripes = np.tile(np.repeat(np.array([20, 220], dtype=np.uint8), 5), (72, 300))
    small = mean_of_cells(stripes, 60, 90)
    assert small.shape == (72, 60)
    assert np.abs(small.astype(int) - 120).max() <= 1
