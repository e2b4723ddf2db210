"""The error stated of an edge's line is that of its points' scatter, alike or not."""

import numpy as np
import pytest
from amount import amount

from occ_model.room.edges import _BLOCK, _Line, _variance_ratio

_POINTS = 640
_SLOPE, _MIDDLE = 0.03, 250.0


def line(random: np.random.Generator, reach: int) -> _Line:
    """Return a line through points whose errors are means over so many neighbours."""
    noise = random.normal(size=_POINTS + reach - 1)
    errors = 0.2 * np.convolve(noise, np.full(reach, reach**-0.5), mode="valid")
    x = np.arange(_POINTS, dtype=np.float64)
    return _Line(0, True, x, _MIDDLE + _SLOPE * x + errors, np.zeros((2, 2)))


def cut(reach: int) -> float:
    """Return how many times too small a variance is that blocks tell of means over neighbours.

    Points k apart have 1 - k / reach of their variance in common, in all and within a block.
    """
    apart = np.arange(1 - reach, reach)
    alike = 1.0 - np.abs(apart) / reach
    return float(alike.sum() / (alike * np.maximum(1.0 - np.abs(apart) / _BLOCK, 0.0)).sum())


@pytest.mark.parametrize("reach", [1, 8])
def test_a_line_is_as_far_off_as_the_scatter_within_blocks_tells(reach: int) -> None:
    random = np.random.default_rng(9107 + reach)
    squares, rooms = [], amount(30, 150)
    for _ in range(rooms):
        lines = [line(random, reach) for _ in range(4)]
        alike = _variance_ratio(lines)
        for each in lines:
            edge = each.edge(alike)
            true = _MIDDLE + _SLOPE * edge.points[:, 0]
            off = (edge.points[:, 1] - true) * edge.normal[1]
            squares.append(off @ np.linalg.solve(edge.covariance, off) / 2.0)
    # The mean square of 1,200 numbers scatters by 4 %.
    assert np.mean(squares) == pytest.approx(cut(reach), rel=0.12 * np.sqrt(150 / rooms))
    assert cut(reach) < 1.5
