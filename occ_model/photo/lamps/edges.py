"""The edges between bright and dark in one strip of a photo."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray, IndexArray

_ABOVE_NOISE = 6.0
"""Number of standard deviations of noise that a step must have."""

LEAST_SWING = 6.0
"""Grey levels that a step must have."""

_LEAST_STEP_FRACTION = 0.15
"""Share of a neighbouring step below which a step is ringing, scatter or texture beside it."""


_LEAST_SWING_RATIO = 0.5
"""Ratio to the swing around it from which an edge is one of the same lamp."""


@dataclass(frozen=True, eq=False, slots=True)
class Edges:
    """Edges between bright and dark, from left to right, falling and rising in turn.

    Parameters
    ----------
    place : ndarray of float64, shape (edges,)
        The column at which each passes the middle between its two levels.
    rises : ndarray of bool, shape as ``place``
        Whether it is bright on the right.
    low, high : ndarray of float64, shape as ``place``
        The two levels in grey levels.
    """

    place: FloatArray
    rises: np.ndarray
    low: FloatArray
    high: FloatArray

    def __len__(self) -> int:
        return len(self.place)

    def part(self, first: int, last: int) -> "Edges":
        """Give the edges from the first to before the last."""
        return self.where(slice(first, last))

    def where(self, chosen: slice | np.ndarray) -> "Edges":
        """Give the edges that are chosen, in their order."""
        return Edges(self.place[chosen], self.rises[chosen], self.low[chosen], self.high[chosen])


def edges_of(profile: FloatArray) -> Edges:
    """Find the edges of a profile that stand out of its noise.

    Parameters
    ----------
    profile : ndarray of float64, shape (columns,)
        Grey levels.
    """
    steps = np.diff(profile)
    noise = 1.4826 * float(np.median(np.abs(steps - np.median(steps)))) / np.sqrt(2.0)
    turns = _turning_points(profile, max(_ABOVE_NOISE * noise, LEAST_SWING))
    turns = _without_ringing(profile, turns)
    first, last = turns[:-1], turns[1:]
    levels = profile[turns]
    low, high = np.minimum(levels[:-1], levels[1:]), np.maximum(levels[:-1], levels[1:])
    middle = _middle(low, high).tolist()
    ends = zip(first.tolist(), last.tolist(), middle, strict=True)
    place = np.array([_crossing(profile, a, b, level) for a, b, level in ends])
    return Edges(place.reshape(-1), levels[1:] > levels[:-1], low, high)


def _turning_points(profile: FloatArray, least: float) -> IndexArray:
    """Find the highest and lowest columns in turn, each step being at least so large."""
    inner = np.flatnonzero(np.diff(np.sign(np.diff(profile)))) + 1
    places = np.concatenate([[0], inner, [len(profile) - 1]]).tolist()
    values = profile[places].tolist()
    turns: list[int] = []
    top = bottom = 0
    upward: bool | None = None
    for index, value in enumerate(values):
        if value > values[top]:
            top = index
        if value < values[bottom]:
            bottom = index
        if upward is not False and value <= values[top] - least:
            turns.append(places[top])
            upward, bottom, top = False, index, index
        elif upward is not True and value >= values[bottom] + least:
            turns.append(places[bottom])
            upward, top, bottom = True, index, index
    if upward is not None:
        turns.append(places[top if upward else bottom])
    return np.array(turns, dtype=np.int64)


def _without_ringing(profile: FloatArray, turns: IndexArray) -> IndexArray:
    """Take out steps that are much smaller than those beside them."""
    kept = turns
    while len(kept) > 2:
        steps = np.abs(np.diff(profile[kept]))
        left, right = np.append(0.0, steps[:-1]), np.append(steps[1:], 0.0)
        small = steps < _LEAST_STEP_FRACTION * np.maximum(left, right)
        outer = np.zeros(len(kept), dtype=bool)
        outer[[0, -1]] = small[[0, -1]]
        # Both ends of a small step go; of small steps side by side the smallest goes first.
        small[[0, -1]] = False
        small &= (steps < np.where(left > 0.0, left, np.inf)) & (steps <= right)
        gone = outer | np.append(small, False) | np.append(False, small)
        if not gone.any():
            break
        kept = kept[~gone]
    return kept


def _middle(low: FloatArray, high: FloatArray) -> FloatArray:
    """Give the level at which each edge is placed: the middle between the levels around it.

    A chip shorter than the exposure does not reach the levels of its neighbours, yet it is as long
    as them at the middle of theirs.
    """
    if low.size == 0:
        return low
    lows = np.pad(low, 1, mode="edge")
    highs = np.pad(high, 1, mode="edge")
    lowest = np.minimum(np.minimum(lows[:-2], lows[2:]), low)
    highest = np.maximum(np.maximum(highs[:-2], highs[2:]), high)
    middle = 0.5 * (lowest + highest)
    alike = high - low > _LEAST_SWING_RATIO * (highest - lowest)
    inside = (middle > low) & (middle < high)
    return np.where(alike & inside, middle, 0.5 * (low + high))


def _crossing(profile: FloatArray, first: int, last: int, level: float) -> float:
    """Find where a profile passes a level between two columns, in the middle if several times."""
    above = profile[first : last + 1] >= level
    changes = np.flatnonzero(above[1:] != above[:-1])
    if changes.size == 0:
        return 0.5 * (first + last)
    at = first + int(changes[len(changes) // 2])
    step = float(profile[at + 1] - profile[at])
    return at + (level - float(profile[at])) / step if step else at + 0.5


def matches(edges: Edges, others: Edges, off: float) -> np.ndarray:
    """Whether each edge has one of the same kind near it among others, shape (edges,)."""
    near = np.zeros(len(edges), dtype=bool)
    for kind in (True, False):
        here, there = edges.rises == kind, others.place[others.rises == kind]
        if there.size and here.any():
            near[here] = _distance(edges.place[here], there) <= off
    return near


def _distance(places: FloatArray, others: FloatArray) -> FloatArray:
    """Give the distance of each place from the nearest of others, which are in order."""
    after = np.clip(np.searchsorted(others, places), 0, len(others) - 1)
    before = np.maximum(after - 1, 0)
    return np.minimum(np.abs(others[after] - places), np.abs(others[before] - places))
