"""Curves, reduced to the extremes that a screen shows, and drawn line by line.

Qt's raster engine draws separate lines ten times faster than a path of the same points: measured
at 1800 points, 1.1 ms of processor time in place of 12 ms.
"""

import numpy as np
from PySide6.QtCore import QLineF

from occ_model.arrays import FloatArray

DASH = (7.0, 5.0)  # pixels of a dash, and of the gap after it

_STRAIGHT_DISTANCE = 1e-6
"""Largest distance, in pixels, of a point that counts as on the line between its neighbours."""


def _drop_straight_points(xs: FloatArray, ys: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Leave out the points at which a curve goes straight on, as on its flat tops."""
    dx, dy = np.diff(xs), np.diff(ys)
    cross_products = np.abs(dx[:-1] * dy[1:] - dx[1:] * dy[:-1])
    lengths = np.hypot(dx[:-1] + dx[1:], dy[:-1] + dy[1:])
    is_corner = np.concatenate([[True], cross_products > _STRAIGHT_DISTANCE * lengths, [True]])
    return xs[is_corner], ys[is_corner]


def make_lines(
    xs: FloatArray, ys: FloatArray, dash: tuple[float, float] | None = None
) -> list[QLineF]:
    """Return the lines from each point to the next, or the dashes along them.

    ``xs``, ``ys``: shape (points,): the curve, in pixels.
    ``dash``: the length of dashes and gaps, in pixels along the curve; None for a solid one.
    """
    if len(xs) < 2:
        return []
    xs, ys = _drop_straight_points(xs, ys)
    if dash is None:
        return _connect(xs, ys)
    distances = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(xs), np.diff(ys)))])
    period = sum(dash)
    starts = np.arange(0.0, distances[-1], period)
    # Not by np.union1d, whose first call imports much of numpy.
    cuts = np.sort(np.concatenate([distances, starts, starts + dash[0]]))
    cuts = cuts[(cuts <= distances[-1]) & (np.diff(cuts, prepend=-1.0) > 0.0)]
    x, y = np.interp(cuts, distances, xs), np.interp(cuts, distances, ys)
    is_dash = np.mod((cuts[:-1] + cuts[1:]) / 2, period) < dash[0]
    ends = (x[:-1][is_dash], y[:-1][is_dash], x[1:][is_dash], y[1:][is_dash])
    return list(map(QLineF, *(end.tolist() for end in ends)))


def _connect(xs: FloatArray, ys: FloatArray) -> list[QLineF]:
    x, y = xs.tolist(), ys.tolist()
    return list(map(QLineF, x, y, x[1:], y[1:]))


def keep_extremes(
    positions: FloatArray, values: FloatArray, left: float, right: float, cells: int
) -> tuple[FloatArray, FloatArray]:
    """Reduce a curve of evenly spaced points to its extremes over the cells of a screen.

    Return the points in view and one beyond each end; of a cell with more than two points, only
    the lowest and the highest.
    """
    first = max(int(np.searchsorted(positions, left)) - 1, 0)
    last = int(np.searchsorted(positions, right, side="right")) + 1
    positions, values = positions[first:last], values[first:last]
    cell_size = len(values) // max(cells, 1)
    if cell_size < 2:
        return positions, values
    groups = len(values) // cell_size
    remainder = groups * cell_size
    cells_of_values = values[:remainder].reshape(groups, cell_size)
    low, high = cells_of_values.argmin(axis=1), cells_of_values.argmax(axis=1)
    starts = np.arange(groups) * cell_size
    extremes = np.sort(np.stack([low, high], axis=1), axis=1) + starts[:, None]
    ends = np.concatenate(
        [[0], extremes.ravel(), np.arange(remainder, len(values)), [len(values) - 1]]
    )
    indices = np.unique(ends)
    return positions[indices], values[indices]
