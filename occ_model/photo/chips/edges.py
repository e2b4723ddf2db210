"""The edges of stripes, and the lattice of chips on which they lie.

Edges are where a profile crosses half-way between dark and bright. Gamma and saturation make bright
runs longer than dark ones, so that rising and falling edges are shifted oppositely: each kind has a
lattice of its own, of the same spacing.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import BoolArray, ByteArray, FloatArray, IndexArray

_HYSTERESIS = 0.15  # least distance from the middle level on both sides of an edge

LEAST_COHERENCE_RATIO = 0.93
"""Minimum coherence of a coarser lattice relative to the most coherent one."""

_SHORTENING = 0.7  # minimum length of the shortest runs, which noise shortens, in chips
LEAST_EDGES = 5  # minimum number of edges: a bright and a dark run between the outermost runs
LEAST_COLUMNS = 2.0  # minimum number of columns per chip
LEAST_PAIR = 2.0 * _SHORTENING * LEAST_COLUMNS  # minimum columns of a bright and a dark run

_STEPS_PER_CHIP = 6.0  # lattices tried while the last edge's phase moves by a chip from the first's
_RIM_DISTANCE = 0.2  # chips from the lattice beyond which an outermost edge is the panel's rim


@dataclass(frozen=True, eq=False, slots=True)
class Edges:
    """The edges of stripes, from left to right, rising and falling in turn."""

    place: FloatArray  # Shape (edges,): columns at which the light passes its middle level
    rises: BoolArray  # Shape (edges,): whether the light rises there; else it falls

    def __len__(self) -> int:
        return len(self.place)

    @property
    def rising(self) -> FloatArray:
        """Places of the rising edges."""
        return self.place[self.rises]

    @property
    def falling(self) -> FloatArray:
        """Places of the falling edges."""
        return self.place[~self.rises]

    def where(self, chosen: slice | BoolArray | IndexArray) -> Self:
        """Return some of the edges."""
        values = {each.name: getattr(self, each.name)[chosen] for each in fields(self)}
        return replace(self, **values)

    @classmethod
    def join(cls, parts: Sequence[Self]) -> Self:
        """Return the edges of all parts, from left to right."""
        values = [[getattr(part, each.name) for part in parts] for each in fields(cls)]
        whole = cls(*map(np.concatenate, values))
        return whole.where(np.argsort(whole.place, kind="stable"))

    @property
    def shortest_pair(self) -> float:
        """Sum of the lengths, in columns, of the shortest bright and the shortest dark run.

        It does not change if bright runs are lengthened and dark ones shortened.
        """
        # The panel's rim may shorten the first and the last gap.
        gaps = np.diff(self.place)[1:-1]
        kinds = gaps[::2], gaps[1::2]
        return float(sum(kind.min() for kind in kinds)) if all(map(len, kinds)) else np.inf


def edges_of(flattened: FloatArray) -> Edges:
    """Find the edges of stripes whose levels are 0 and 1."""
    levels = np.where(
        flattened > 0.5 + _HYSTERESIS, 1, np.where(flattened < 0.5 - _HYSTERESIS, -1, 0)
    )
    clear = np.flatnonzero(levels)
    changes = np.flatnonzero(np.diff(levels[clear]))
    ends = zip(clear[changes].tolist(), clear[changes + 1].tolist(), strict=True)
    place = [_crossing(flattened[first : last + 1], first) for first, last in ends]
    return Edges(np.array(place, dtype=np.float64), levels[clear[changes + 1]] > 0)


def _crossing(part: FloatArray, first: int) -> float:
    """Return the mean of the places at which a part of a profile crosses one half."""
    starts = np.flatnonzero((part[1:] > 0.5) != (part[:-1] > 0.5))
    low, high = part[starts], part[starts + 1]
    return first + float(np.mean(starts + (0.5 - low) / (high - low)))


@dataclass(frozen=True, slots=True)
class Lattice:
    """Two lattices of the same spacing, that of the rising and that of the falling edges."""

    frequency: float  # chips per column
    # Phases of the two lattices in chips, at column 0; they differ by at most half a chip
    rising: float
    falling: float
    coherence: float  # absolute value of the edges' mean phase factor, from 0 to 1


def coherence(edges: Edges, frequencies: FloatArray) -> FloatArray:
    """Return the coherence of edges with lattices of these frequencies, in chips per column."""
    sums = [np.abs(_phase_factors(kind, frequencies)) for kind in (edges.rising, edges.falling)]
    return np.asarray((sums[0] + sums[1]) / max(len(edges), 1))


def _phase_factors(places: FloatArray, frequencies: FloatArray) -> NDArray[np.complex128]:
    return np.asarray(np.exp(2j * np.pi * np.outer(frequencies, places)).sum(axis=1))


def find_coarsest(edges: Edges) -> Lattice | None:
    """Find the coarsest pair of lattices on which edges lie; None if none is coherent."""
    if len(edges) < LEAST_EDGES or edges.shortest_pair <= LEAST_PAIR:
        return None
    longest = edges.shortest_pair / 2.0 / _SHORTENING
    extent = float(np.ptp(edges.place))
    step = 1.0 / (_STEPS_PER_CHIP * extent)
    frequencies = np.arange(1.0 / longest, 1.0 / LEAST_COLUMNS, step)
    if frequencies.size < 3:
        return None
    coherences = coherence(edges, frequencies)
    peaks = 1 + np.flatnonzero(
        (coherences[1:-1] >= coherences[:-2]) & (coherences[1:-1] >= coherences[2:])
    )
    peaks = np.unique(np.append(peaks, 0)) if coherences[0] > coherences[1] else peaks
    if peaks.size == 0:
        return None
    good = peaks[coherences[peaks] >= LEAST_COHERENCE_RATIO * coherences[peaks].max()]
    fine = frequencies[good[0]] + np.linspace(-step, step, 41)
    return lattice_at(edges, float(fine[coherence(edges, fine).argmax()]))


def lattice_at(edges: Edges, frequency: float) -> Lattice:
    """Return the pair of lattices of one spacing that fits the edges best."""
    frequencies = np.array([frequency])
    turns = [
        float(np.angle(_phase_factors(kind, frequencies)[0])) / (2.0 * np.pi)
        for kind in (edges.rising, edges.falling)
    ]
    distance = (turns[1] - turns[0] + 0.5) % 1.0 - 0.5
    return Lattice(
        frequency, turns[0], turns[0] + distance, float(coherence(edges, frequencies)[0])
    )


def chip_numbers(edges: Edges, lattice: Lattice) -> FloatArray:
    """Return the edges' positions in chips: whole numbers except for noise."""
    first = np.where(edges.rises, lattice.rising, lattice.falling)
    return np.asarray(edges.place * lattice.frequency - first)


def part_between_rims(edges: Edges, lattice: Lattice) -> slice:
    """Return which edges are those of chips: all but an outermost one that is the panel's rim.

    A rim is off the lattice, or by chance nearest to the lattice point of its neighbour.
    """
    numbers = chip_numbers(edges, lattice)
    nearest = np.rint(numbers)
    is_off, lengths = np.abs(numbers - nearest) > _RIM_DISTANCE, np.diff(nearest)
    is_first_rim, is_last_rim = (is_off[end] or lengths[end] < 1 for end in (0, -1))
    return slice(int(is_first_rim), len(edges) - int(is_last_rim))


def chips_between(edges: Edges, lattice: Lattice) -> tuple[ByteArray, int] | None:
    """Return the chips between the outermost edges, and the number of the first chip.

    None if two edges lie on the same place of the lattice.
    """
    numbers = np.rint(chip_numbers(edges, lattice)).astype(np.int64)
    lengths = np.diff(numbers)
    if len(lengths) == 0 or lengths.min() < 1:
        return None
    return np.repeat(edges.rises[:-1], lengths).astype(np.uint8), int(numbers[0])


def certainty(edges: Edges, lattice: Lattice) -> float:
    """Return the probability that every edge belongs to the nearest place of the lattice.

    It is the product of two: that the coherence is not by chance (Rayleigh's test: n edges of
    random phase have a mean phase factor above R with the probability exp(-n R^2), for each lattice
    tried), and that no edge is displaced by half a chip or more, if displacements are normal.
    """
    if len(edges) < 5:
        return 0.0
    numbers = chip_numbers(edges, lattice)
    displacements = numbers - np.rint(numbers)
    strength = sum(
        len(kind) * abs(np.exp(2j * np.pi * kind).mean()) ** 2
        for kind in (displacements[edges.rises], displacements[~edges.rises])
        if len(kind) > 1
    )
    lattices = max(1.0, float(np.ptp(edges.place)) * lattice.frequency)
    chance = min(1.0, lattices * math.exp(-strength))
    deviation = max(math.sqrt(float((displacements**2).sum()) / (len(edges) - 3)), 1e-9)
    misplaced = math.erfc(0.5 / deviation / math.sqrt(2.0))
    return (1.0 - chance) * (1.0 - misplaced) ** len(edges)
