"""How much of each pixel the panel covers, compared with counting and with direct blurs."""

import cv2
import numpy as np
import pytest
from amount import amount

from occ_model.camera.coverage import Coverage, CoveredPart

ROWS, COLUMNS = 90, 120
STAR = np.array(
    [[60, 4.3], [70.2, 35], [110.7, 38], [75.1, 50], [100, 85.6], [59.5, 60], [20.3, 85], [45, 50]]
)


def cover_rows(
    outline: np.ndarray, blur: float = 0.0, size: tuple[int, int] = (ROWS, COLUMNS)
) -> np.ndarray:
    return Coverage(outline, *size, blur).rows(range(size[0]))


def count_inside(outline: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Return which pixels are inside, by the edges that a ray to the left of each crosses."""
    x, y = columns[None, :], rows[:, None]
    inside = np.zeros((len(rows), len(columns)), dtype=bool)
    for (x0, y0), (x1, y1) in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        if y0 == y1:
            continue
        crossed = ((y0 <= y) != (y1 <= y)) & (x0 + (y - y0) / (y1 - y0) * (x1 - x0) <= x)
        inside ^= crossed
    return inside


def blur_directly(outline: np.ndarray, blur: float, size: tuple[int, int]) -> np.ndarray:
    """Blur a sharp mask with wide margins at full resolution."""
    rows, columns = size
    margin = int(5 * blur) + 1
    mask = count_inside(
        outline, np.arange(-margin, rows + margin), np.arange(-margin, columns + margin)
    )
    wide = cv2.GaussianBlur(mask.astype(np.float64), (0, 0), blur)
    return wide[margin:-margin, margin:-margin]


@pytest.mark.parametrize("blur", [0.0, 0.3, 2.0, 15.0, 210.0])
def test_an_outline_outside_covers_nothing_and_one_round_all_all(blur: float) -> None:
    square = np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]]) * 1e7
    for shift in ([3e7, 0], [-3e7, 0], [0, 3e7], [0, -3e7]):
        assert cover_rows(square + shift, blur).max() < 1e-7
    np.testing.assert_allclose(cover_rows(square, blur), 1.0, rtol=0, atol=1e-4)


@pytest.mark.parametrize("blur", [2.0, 8.0, 16.0, 60.0])
def test_a_straight_edge_is_blurred_over_the_stated_deviation(blur: float) -> None:
    # From 8 pixels on, the cells of a coarser grid blur as well, by half a cell.
    beyond = np.array([[300.3, -2e3], [2e3, -2e3], [2e3, 3e3], [300.3, 3e3]])
    steps = np.diff(cover_rows(beyond, blur, (40, 700)).mean(axis=0), prepend=0.0)
    columns = np.arange(700)
    deviation = np.sqrt(np.cov(columns, aweights=np.maximum(steps, 0.0), ddof=0))
    assert deviation == pytest.approx(blur, rel=5e-3)


@pytest.mark.parametrize("blur", [0.4, 1.0, 3.0, 7.9, 8.0, 12.5, 30.0, 60.0])
@pytest.mark.parametrize("scale", amount([3.0], [0.5, 1.0, 3.0]))
def test_blurred_coverage_is_a_blur_at_full_resolution(scale: float, blur: float) -> None:
    outline = (STAR - [60, 45]) * scale + [70, 40]
    expected = blur_directly(outline, blur, (ROWS, COLUMNS))
    # The coarse grid's cells and the straight lines between them add 1/64 to the blur's variance.
    largest = 6e-3 if blur >= 8.0 else 2e-4
    np.testing.assert_allclose(cover_rows(outline, blur), expected, rtol=0, atol=largest)


@pytest.mark.parametrize("blur", [0.0, 3.0, 20.0])
def test_rows_are_the_same_however_many_are_asked_for(blur: float) -> None:
    whole = Coverage(STAR, ROWS, COLUMNS, blur)
    every = whole.rows(range(ROWS))
    one_by_one = np.concatenate([whole.rows(range(row, row + 1)) for row in range(ROWS)])
    np.testing.assert_allclose(one_by_one, every, rtol=0, atol=1e-6)
    for step in (2, 30):
        some = whole.rows(range(1, ROWS, step))
        np.testing.assert_allclose(some, every[1::step], rtol=0, atol=1e-6)


@pytest.mark.parametrize("left", [-0.4, 30.3, COLUMNS + 0.6])
@pytest.mark.parametrize("blur", [0.0, 0.7, 3.0, 20.0])
def test_parts_without_fractions_are_covered_fully_and_columns_beside_parts_not_at_all(
    blur: float, left: float
) -> None:
    square = np.array([[left, -900.0], [left + 50, -900], [left + 50, 900], [left, 900]])
    expected = np.clip(blur_directly(square, max(blur, 1e-3), (ROWS, COLUMNS)), 0.0, 1.0)
    is_beside = np.ones(COLUMNS, dtype=bool)
    for part in Coverage(square, ROWS, COLUMNS, blur).parts(range(ROWS)):
        is_beside[part.columns] = False
        if part.fraction is None:
            np.testing.assert_allclose(expected[:, part.columns], 1.0, atol=1e-4)
        else:
            assert blur > 0.0  # with upright edges all rows are equal
    np.testing.assert_allclose(expected[:, is_beside], 0.0, atol=1e-4)
    assert blur or is_beside.sum() == (expected == 0.0).all(axis=0).sum()


def test_a_part_without_some_columns_is_what_lies_between_them() -> None:
    fraction = np.arange(12.0, dtype=np.float32)[None, :]
    part = CoveredPart(slice(10, 22), fraction)
    pieces = part.cut_out([slice(0, 11), slice(13, 15), slice(21, 40), slice(50, 60)])
    assert [piece.columns for piece in pieces] == [slice(11, 13), slice(15, 21)]
    assert [piece.fraction.tolist()[0] for piece in pieces] == [[1, 2], [5, 6, 7, 8, 9, 10]]
    assert part.cut_out([])[0].fraction.tolist() == fraction.tolist()
    for beside in (part.crop(slice(0, 5)), part.crop(slice(30, 40))):
        assert beside.columns.start == beside.columns.stop
        assert beside.fraction.shape == (1, 0)
