"""The lines of a curve pass through all of its points, however few lines they are."""

from itertools import pairwise

import numpy as np
import pytest

from occ_gui.story.curve_lines import DASH, lines_of


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
    lines = lines_of(xs, ys)
    ends = [*(line.p1() for line in lines), lines[-1].p2()]
    drawn = np.interp(xs, [end.x() for end in ends], [end.y() for end in ends])
    np.testing.assert_allclose(drawn, ys, atol=1e-4)
    assert (ends[0].x(), ends[-1].x()) == (xs[0], xs[-1])
    assert all(one.p2() == other.p1() for one, other in pairwise(lines))


def test_a_straight_part_is_one_line(stairs: tuple[np.ndarray, np.ndarray]) -> None:
    xs, ys = stairs
    assert len(lines_of(xs[:100], ys[:100])) == 5  # three tops, and two edges between them
    assert len(lines_of(xs, 0.3 * xs - 2.0)) == 1


def test_dashes_cover_their_share_of_the_curve(stairs: tuple[np.ndarray, np.ndarray]) -> None:
    xs, ys = stairs
    solid, dashed = (
        sum(line.length() for line in lines) for lines in (lines_of(xs, ys), lines_of(xs, ys, DASH))
    )
    assert dashed / solid == pytest.approx(DASH[0] / sum(DASH), abs=0.02)
