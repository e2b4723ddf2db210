"""Lines along which a number that is known at the points of a lattice is zero."""

import math
from itertools import pairwise

from occ_model.arrays import FloatArray

Point = tuple[float, float]


def zero_lines(places: tuple[FloatArray, FloatArray], sides: FloatArray) -> list[list[Point]]:
    """Give the lines, each as its points in order.

    Parameters
    ----------
    places : pair of ndarray of float64
        The points' positions along both axes.
    sides : ndarray of float64, shape (points along x, points along y)
        The number; cells with a corner at which it is no number have no line.
    """
    pieces = []
    xs, ys = (axis.tolist() for axis in places)
    numbers = sides.tolist()
    for i, (left, right) in enumerate(pairwise(xs)):
        for j, (low, high) in enumerate(pairwise(ys)):
            corners = (
                (left, low, numbers[i][j]),
                (right, low, numbers[i + 1][j]),
                (right, high, numbers[i + 1][j + 1]),
                (left, high, numbers[i][j + 1]),
            )
            pieces += _in_cell(corners)
    return _joined(pieces)


def _in_cell(corners: tuple[tuple[float, float, float], ...]) -> list[tuple[Point, Point]]:
    """Cut a cell's sides where the number changes its sign, and connect the cuts."""
    if any(math.isnan(side) for *_, side in corners):
        return []
    cuts = []
    for (x0, y0, a), (x1, y1, b) in pairwise((*corners, corners[0])):
        if (a < 0.0) != (b < 0.0):
            share = a / (a - b)
            # The same digits from both of the cells that share the side.
            cuts.append((round(x0 + share * (x1 - x0), 9), round(y0 + share * (y1 - y0), 9)))
    return list(zip(cuts[::2], cuts[1::2], strict=True))


def _joined(pieces: list[tuple[Point, Point]]) -> list[list[Point]]:
    """Put pieces that end where others begin together."""
    at: dict[Point, list[int]] = {}
    for number, piece in enumerate(pieces):
        for end in piece:
            at.setdefault(end, []).append(number)
    left = set(range(len(pieces)))
    ends = [point for point, numbers in at.items() if len(numbers) == 1]
    lines = []
    for start in (*ends, *at):  # those that begin somewhere first, then the rings
        line = _followed(start, pieces, at, left)
        if len(line) > 1:
            lines.append(line)
    return lines


def _followed(
    start: Point,
    pieces: list[tuple[Point, Point]],
    at: dict[Point, list[int]],
    left: set[int],
) -> list[Point]:
    line = [start]
    while True:
        number = next((n for n in at[line[-1]] if n in left), None)
        if number is None:
            return line
        left.discard(number)
        one, other = pieces[number]
        line.append(other if one == line[-1] else one)
