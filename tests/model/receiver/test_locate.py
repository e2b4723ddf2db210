"""The panel is located from its brightest pixels."""

from itertools import pairwise

import numpy as np
import pytest
from amount import amount
from hypothesis import given, settings, strategies as st
from hypothesis.extra import numpy as arrays
from numpy.typing import NDArray

from occ_model.receiver.signal import bright_level, locate
from occ_model.results.decoding import Region

FRACTION = 0.05

images = arrays.arrays(np.uint8, arrays.array_shapes(min_dims=2, max_dims=2, max_side=24))


def region_in(image: NDArray[np.uint8], fraction: float) -> Region | None:
    found = locate(image, fraction)
    return None if found is None else found.region


def dark(rows: int, columns: int, level: int = 20) -> np.ndarray:
    return np.full((rows, columns), level, dtype=np.uint8)


def lit(rows: int, columns: int, region: Region, level: int = 200) -> np.ndarray:
    image = dark(rows, columns)
    paint(image, region, level)
    return image


def paint(image: np.ndarray, region: Region, level: int) -> None:
    image[region.first_row : region.last_row, region.first_column : region.last_column] = level


def draw_rectangle(rows: int, columns: int) -> st.SearchStrategy[Region]:
    """Draw any rectangle of an image, including its borders and single pixels."""
    along = st.tuples(st.integers(0, rows), st.integers(0, rows)).filter(lambda p: p[0] != p[1])
    across = st.tuples(st.integers(0, columns), st.integers(0, columns))
    across = across.filter(lambda p: p[0] != p[1])
    return st.builds(lambda r, c: Region(*sorted(r), *sorted(c)), along, across)


@pytest.mark.parametrize("shape", [(60, 90), (700, 1500), (1501, 1103), (3, 3000), (2000, 5)])
@settings(max_examples=amount(12, 100))
@given(data=st.data())
def test_a_bright_rectangle_is_found_exactly_wherever_it_is(
    shape: tuple[int, int], data: st.DataObject
) -> None:
    region = data.draw(
        draw_rectangle(*shape).filter(lambda r: r.rows * r.columns < shape[0] * shape[1])
    )
    assert region_in(lit(*shape, region), FRACTION) == region


@pytest.mark.parametrize(("rows", "columns"), [(1000, 1000), (1, 100_000), (100_000, 1)])
def test_a_pixel_of_which_no_cell_of_the_contours_shows_a_trace_is_found(
    rows: int, columns: int
) -> None:
    pixel = Region(rows - 1, rows, columns - 1, columns)
    assert region_in(lit(rows, columns, pixel), FRACTION) == pixel


@pytest.mark.parametrize(
    "region",
    [
        Region(0, 900, 0, 400),
        Region(0, 1, 0, 1),
        Region(899, 900, 1199, 1200),
        Region(0, 900, 600, 601),
        Region(450, 451, 0, 1200),
        Region(100, 800, 1, 1199),
        Region(440, 450, 700, 720),
    ],
    ids=lambda r: f"rows {r.first_row}-{r.last_row} columns {r.first_column}-{r.last_column}",
)
@pytest.mark.parametrize("fraction", [1e-4, FRACTION, 0.5])
def test_the_bright_fraction_does_not_move_a_rectangle(region: Region, fraction: float) -> None:
    assert region_in(lit(900, 1200, region), fraction) == region


@pytest.mark.parametrize("period", [4, 10, 37, 120])
@pytest.mark.parametrize("shape", [(300, 400), (1200, 1600)])
def test_a_striped_panel_is_found_from_the_first_to_the_last_stripe(
    shape: tuple[int, int], period: int
) -> None:
    image = dark(*shape)
    first, last, top, bottom = 40, shape[1] - 60, 30, shape[0] - 50
    starts = range(first, last - period // 2, period)
    for start in starts:
        paint(image, Region(top, bottom, start, start + period // 2), 220)
    assert region_in(image, FRACTION) == Region(top, bottom, first, starts[-1] + period // 2)


def test_stripes_of_several_brightnesses_are_one_panel() -> None:
    image = dark(200, 300)
    levels = [150, 220, 180, 255, 150]
    edges = [50, 80, 110, 150, 160, 200]
    for (start, end), level in zip(pairwise(edges), levels, strict=True):
        paint(image, Region(40, 160, start, end - 4), level)
    assert region_in(image, 0.5) == Region(40, 160, 50, 196)


@given(places=st.sets(st.tuples(st.integers(0, 74), st.integers(0, 124)), max_size=60))
def test_isolated_hot_pixels_away_from_the_panel_do_not_widen_it(
    places: set[tuple[int, int]],
) -> None:
    panel = Region(300, 900, 500, 1700)
    image = lit(1500, 2500, panel)
    for row, column in places:
        # The contours are on a coarser grid, so pixels within a cell of them belong to them.
        if not (14 <= row <= 45 and 24 <= column <= 85):
            image[20 * row, 20 * column] = 255
    assert region_in(image, FRACTION) == panel


def test_a_distant_panel_is_found_among_bright_surroundings() -> None:
    rng = np.random.default_rng(3)
    image = rng.integers(10, 30, (600, 800), dtype=np.uint8)
    panel = Region(250, 280, 390, 420)  # 0.2 % of the area
    paint(image, panel, 200)
    assert region_in(image, FRACTION) == panel


def check_any(image: np.ndarray, fraction: float) -> None:
    """Check the properties that the region of any image has."""
    before = image.copy()
    region = region_in(image, fraction)
    np.testing.assert_array_equal(image, before)
    if region is None:
        assert np.ptp(image) == 0
        return
    rows, columns = image.shape
    assert 0 <= region.first_row < region.last_row <= rows
    assert 0 <= region.first_column < region.last_column <= columns
    outside = image.copy()
    paint(outside, region, 0)
    # The region contains the brightest pixels, and each edge touches one brighter than the rest.
    assert outside.max() < image.max()
    part = image[region.first_row : region.last_row, region.first_column : region.last_column]
    for edge in (part[0], part[-1], part[:, 0], part[:, -1]):
        assert edge.max() > image.min()
        assert edge.max() > outside.max()


@given(image=images, fraction=st.floats(1e-4, 0.5))
def test_a_region_contains_its_bright_pixels_and_fits_them_closely(
    image: np.ndarray, fraction: float
) -> None:
    check_any(image, fraction)


@given(image=images, fraction=st.floats(1e-4, 0.5))
def test_mirroring_or_turning_an_image_does_the_same_to_its_region(
    image: np.ndarray, fraction: float
) -> None:
    region = region_in(image, fraction)
    turned = region_in(np.ascontiguousarray(image.T), fraction)
    mirrored = region_in(np.ascontiguousarray(image[:, ::-1]), fraction)
    if region is None:
        assert turned is None
        assert mirrored is None
        return
    assert turned == Region(
        region.first_column, region.last_column, region.first_row, region.last_row
    )
    columns = image.shape[1]
    assert mirrored == Region(
        region.first_row,
        region.last_row,
        columns - region.last_column,
        columns - region.first_column,
    )


def test_stripes_merge_when_they_grow_by_half_their_gaps() -> None:
    image = np.zeros((120, 400), dtype=np.uint8)
    for first in range(100, 300, 40):
        image[30:90, first : first + 10] = 255
    found = locate(image, FRACTION)
    assert found.bright_level == 255
    assert found.contours == 5
    # Gaps of 30 columns close when each side has grown by 15.
    assert found.growth == 15


def test_pixels_that_make_up_exactly_the_bright_fraction_are_bright() -> None:
    counts = np.zeros(256, dtype=np.int64)
    counts[[20, 200, 255]] = 90, 5, 5
    assert bright_level(counts, 0.05) == 255
    assert bright_level(counts, 0.06) == 200
    # Pixels below the split between dark and bright are never bright.
    between = bright_level(counts, 0.5)
    assert 20 < between <= 200
