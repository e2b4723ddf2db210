"""The edges between bright and dark in one strip of a photo."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.photo.chips.edges import Edges

_LEAST_DEVIATIONS = 6.0  # minimum height of a step in standard deviations of the noise
_LEAST_HEIGHT = 6.0  # minimum height of a step in grey levels
_LEAST_STEP_RATIO = 0.15  # minimum height of a step over its neighbours'; less is ringing

_CHAIN_STEPS, _LEAST_CHAIN_RATIO = 5, 0.2
"""Number of consecutive steps, and minimum ratio of neighbouring ones, of a chain that is kept even
beside a steep rim: exposures longer than a chip leave faint stripes."""

_EDGE_TOLERANCE = 0.06  # maximum distance of equal edges in chips, besides a column
_LEAST_SWING_RATIO = 0.5  # minimum height of an edge over the swing around it, for its level


@dataclass(frozen=True, eq=False, slots=True)
class LampEdges(Edges):
    """Edges with the levels of light between which each of them lies, in grey levels."""

    low: FloatArray  # Shape (edges,)
    high: FloatArray  # Shape (edges,)

    @property
    def swing(self) -> FloatArray:
        return self.high - self.low

    def part(self, first: int, last: int) -> "LampEdges":
        return self.where(slice(first, last))


def edges_of(profile: FloatArray) -> LampEdges:
    """Find the edges of a profile that stand out of its noise."""
    steps = np.diff(profile)
    noise = 1.4826 * float(np.median(np.abs(steps - np.median(steps)))) / np.sqrt(2.0)
    turns = _turning_points(profile, max(_LEAST_DEVIATIONS * noise, _LEAST_HEIGHT))
    turns = _without_ringing(profile, turns)
    first, last = turns[:-1], turns[1:]
    levels = profile[turns]
    low, high = np.minimum(levels[:-1], levels[1:]), np.maximum(levels[:-1], levels[1:])
    begin, end = _middles(turns, levels)
    ends = zip(first.tolist(), last.tolist(), begin.tolist(), end.tolist(), strict=True)
    place = np.array([_crossing(profile, *one) for one in ends])
    return LampEdges(place.reshape(-1), levels[1:] > levels[:-1], low, high)


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
    """Leave out turning points of steps that are small beside those to either side."""
    kept = turns
    while len(kept) > 2:
        steps = np.abs(np.diff(profile[kept]))
        left, right = np.append(0.0, steps[:-1]), np.append(steps[1:], 0.0)
        small = (steps < _LEAST_STEP_RATIO * np.maximum(left, right)) & ~_in_chain(steps)
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


def _in_chain(steps: FloatArray) -> BoolArray:
    """Whether each step is one of several that follow each other and are about as large."""
    ratio = np.minimum(steps[1:], steps[:-1]) / np.maximum(steps[1:], steps[:-1])
    chains = np.append(0, np.cumsum(ratio < _LEAST_CHAIN_RATIO))
    return np.asarray(np.bincount(chains)[chains] >= _CHAIN_STEPS)


def _middles(turns: IndexArray, levels: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the level at which each edge counts as passed, at its beginning and at its end.

    It is the middle between the dark and the bright level around the edge, which may change along a
    lamp. At that level a chip has its full length, even one that is shorter than the exposure and
    so does not reach the levels of its neighbours.
    """
    if len(turns) < 2:
        return np.zeros(0), np.zeros(0)
    steps = np.diff(levels)
    is_high = np.append(steps < 0.0, steps[-1] > 0.0)
    highest = _envelope(turns, levels, is_high)
    lowest = -_envelope(turns, -levels, ~is_high)
    middle, own = 0.5 * (lowest + highest), 0.5 * (levels[:-1] + levels[1:])
    span = np.maximum.reduce([levels[:-1], levels[1:], highest[:-1], highest[1:]])
    span = span - np.minimum.reduce([levels[:-1], levels[1:], lowest[:-1], lowest[1:]])
    low, high = np.minimum(levels[:-1], levels[1:]), np.maximum(levels[:-1], levels[1:])
    is_regular = np.abs(steps) > _LEAST_SWING_RATIO * span
    for end in (middle[:-1], middle[1:]):
        is_regular &= (end > low) & (end < high)
    return np.where(is_regular, middle[:-1], own), np.where(is_regular, middle[1:], own)


def _envelope(turns: IndexArray, levels: FloatArray, is_high: BoolArray) -> FloatArray:
    """Return the level that the high turning points follow, at each turning point."""
    place, high = turns[is_high].astype(np.float64), levels[is_high].copy()
    if len(high) > 2:
        # A line through its neighbours passes above a short chip.
        fraction = (place[1:-1] - place[:-2]) / (place[2:] - place[:-2])
        high[1:-1] = np.maximum(high[1:-1], levels[is_high][:-2] * (1.0 - fraction)
                                + levels[is_high][2:] * fraction)  # fmt: skip
    return np.asarray(np.interp(turns, place, high))


def _crossing(profile: FloatArray, first: int, last: int, begin: float, end: float) -> float:
    """Find where a profile passes a level that changes evenly; of several places the middle one."""
    count = last - first
    level = begin + (end - begin) / count * np.arange(count + 1)
    above = profile[first : last + 1] - level
    changes = np.flatnonzero((above[1:] >= 0.0) != (above[:-1] >= 0.0))
    if changes.size == 0:
        return 0.5 * (first + last)
    at = int(changes[len(changes) // 2])
    step = float(above[at + 1] - above[at])
    return first + at + (-float(above[at]) / step if step else 0.5)


def equal_within(chip: float) -> float:
    """Return the distance in columns within which edges of chips of a length are equal."""
    return 1.0 + _EDGE_TOLERANCE * chip


def matches(edges: Edges, others: Edges, chip: float) -> BoolArray:
    """Whether each edge has an equal one among others, shape (edges,); ``chip``: in columns."""
    off = equal_within(chip)
    near = np.zeros(len(edges), dtype=bool)
    for kind in (True, False):
        here, there = edges.rises == kind, others.place[others.rises == kind]
        if there.size and here.any():
            near[here] = _distance(edges.place[here], there) <= off
    return near


def _distance(places: FloatArray, others: FloatArray) -> FloatArray:
    after = np.minimum(np.searchsorted(others, places), len(others) - 1)
    before = np.maximum(after - 1, 0)
    return np.asarray(np.minimum(np.abs(others[after] - places), np.abs(others[before] - places)))
