"""How much of a pixel the panel covers, sharp and blurred, against rational arithmetic."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import strategies as st

from hard_cases.laws import cases, record
from hard_cases.references import decades
from occ_model.camera.coverage import Coverage
from occ_model.camera.projection import row_spans


@st.composite
def quads(draw: st.DrawFn) -> np.ndarray:
    """Four corners round an ellipse of any size and place, to a billion pixels."""
    angles = sorted(draw(st.lists(st.floats(0, 6.28), min_size=4, max_size=4, unique=True)))
    wide, high = draw(decades(1e-3, 1e9)), draw(decades(1e-3, 1e9))
    turn, way = draw(st.floats(0, 3.15)), draw(st.sampled_from([1, -1]))
    x, y = draw(st.floats(-1.2, 1.2)), draw(st.floats(-1.2, 1.2))
    circle = np.array([(wide * math.cos(a), high * math.sin(a)) for a in angles])
    turned = circle @ [[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]]
    # Its rim passes near the picture, whatever its size.
    if draw(st.booleans()):
        # Upright edges, which must be so to the last digit, and level ones.
        turned = np.array([[-wide, -high], [wide, -high], [wide, high], [-wide, high]])
    quad = turned + np.array([20 + x * min(wide, 1e6), 6 + y * min(high, 1e6)])
    return quad[::way] if draw(st.booleans()) else np.rint(quad)[::way]


def crossings(polygon: np.ndarray, row: int) -> list[Fraction]:
    """Where a row crosses the outline, exactly, in order; a corner counts for one of its edges."""
    found = []
    points = [tuple(map(Fraction, point)) for point in polygon.tolist()]
    for (x0, y0), (x1, y1) in zip(points, [*points[1:], points[0]], strict=True):
        if (y0 <= row) != (y1 <= row):
            found.append(x0 + (row - y0) / (y1 - y0) * (x1 - x0))
    return sorted(found)


@cases(quad=quads())
def test_row_spans_are_those_of_rational_arithmetic(quad: np.ndarray) -> None:
    rows, columns = 12, 41
    first, last = row_spans(quad, rows, columns)
    worst = Fraction(0)
    for row in range(rows):
        ends = crossings(quad, row) or [Fraction(columns)] * 2
        left, right = ends[0], ends[-1]
        # A whole number is at or beyond a place where it is so of the whole number above that.
        inside = range(math.ceil(left), math.ceil(right))
        for column in range(columns):
            if bool(first[row] <= column < last[row]) != (column in inside):
                worst = max(worst, min(abs(column - left), abs(column - right)))
    size = max(float(np.abs(quad).max()), columns)
    error = float(worst) / size
    record("row_spans: a misjudged centre's distance, of the corners'", "to 1e9 px", error, 1e-15)


@st.composite
def stars(draw: st.DrawFn) -> np.ndarray:
    """Draw a concave polygon of any size around a point near the picture."""
    count = draw(st.integers(3, 12))
    size = draw(decades(1e-2, 1e6))
    reach = draw(st.lists(st.floats(0.05, 1.0), min_size=count, max_size=count))
    turn = draw(st.floats(0, 6.28))
    angle = turn + 2 * np.pi * np.arange(count) / count
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=-1) * np.array(reach)[:, None] * size
    star = circle + np.array([draw(st.floats(-20, 60)), draw(st.floats(-10, 30))])
    star = np.rint(star) if draw(st.booleans()) else star
    return star[:: draw(st.sampled_from([1, -1]))]


@cases(star=stars())
def test_sharp_coverage_is_that_of_rational_arithmetic(star: np.ndarray) -> None:
    rows, columns = 12, 41
    found = Coverage(star, rows, columns).rows(range(rows))
    assert np.isin(found, [0.0, 1.0]).all()
    worst = Fraction(0)
    for row in range(rows):
        ends = crossings(star, row)
        firsts = [math.ceil(end) for end in ends]
        for column in range(columns):
            inside = sum(first <= column for first in firsts) % 2 == 1
            if inside != bool(found[row, column]):
                worst = max(worst, min((abs(column - end) for end in ends), default=Fraction(99)))
    size = max(float(np.abs(star).max()), columns)
    error = float(worst) / size
    record("coverage: a misjudged centre's distance, of the corners'", "to 1e6 px", error, 1e-15)


def normal(x: float) -> float:
    return 0.5 * math.erfc(-x / math.sqrt(2.0))


@cases(
    blur=decades(8.0, 1e9),
    left=st.floats(-4.0, 3.0),
    top=st.floats(-4.0, 3.0),
    width=decades(0.05, 1e3),
    height=decades(0.05, 1e3),
)
def test_the_widest_blur_of_a_rectangle_is_two_normal_integrals(
    blur: float, left: float, top: float, width: float, height: float
) -> None:
    ends = np.array([left, left + width, top, top + height]) * blur
    outline = np.array([ends[[0, 2]], ends[[1, 2]], ends[[1, 3]], ends[[0, 3]]])
    found = Coverage(outline, 3, 5, blur).rows(range(3))
    # A panel consists of the pixels whose centres it covers.
    x0, x1, y0, y1 = (np.ceil(ends) - 0.5).tolist()
    across = [normal((x1 - c) / blur) - normal((x0 - c) / blur) for c in range(5)]
    down = [normal((y1 - r) / blur) - normal((y0 - r) / blur) for r in range(3)]
    error = float(np.abs(found - np.outer(down, across)).max())
    record("a wide blur against the normal distribution", "blur 8 to 1e9 px", error, 6e-3)


@pytest.mark.parametrize("columns", [32_766, 32_768, 70_000, 200_000])
def test_a_blur_of_more_columns_than_16_bits_hold_is_right(columns: int) -> None:
    # OpenCV uses 16 bits for the coordinates of a transformed picture.
    ends = np.array([0.3, 0.9]) * columns
    outline = np.array([[ends[0], -99], [ends[1], -99], [ends[1], 99], [ends[0], 99]])
    found = Coverage(outline, 2, columns, 8.5).rows(range(2))
    column = np.arange(columns)
    x0, x1 = (np.ceil(ends) - 0.5).tolist()
    spans = (x0 - 45 <= column) & (column <= x0 + 45) | (x1 - 45 <= column) & (column <= x1 + 45)
    expected = ((x0 < column) & (column < x1)).astype(float)
    expected[spans] = [
        normal((x1 - c) / 8.5) - normal((x0 - c) / 8.5) for c in column[spans].tolist()
    ]
    np.testing.assert_allclose(found, np.tile(expected, (2, 1)), rtol=0, atol=5e-3)


@pytest.mark.parametrize("side", range(3, 60, 7))
def test_an_upright_edge_on_pixels_centres_is_not_jagged(side: int) -> None:
    # x (1 - s) + x s is not x for every s: one row in ten lost a pixel, so that the rim was jagged.
    for x in range(side, side + 7):
        outline = np.array([[x, -9.7], [90, -9.7], [90, 411.3], [x, 411.3]])
        first, last = row_spans(outline, 300, 80)
        assert (first == x).all()
        assert (last == 80).all()
        np.testing.assert_array_equal(
            Coverage(outline, 300, 80).rows(range(300)), np.tile(np.arange(80) >= x, (300, 1))
        )
