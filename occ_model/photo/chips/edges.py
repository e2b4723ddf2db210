"""The edges of stripes, and the lattice of chips on which they lie.

Edges are where a profile crosses half-way between dark and bright. Gamma and saturation make bright
runs longer than dark ones, so that rising and falling edges are shifted oppositely: each kind has a
lattice of its own, of the same spacing.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import BoolArray, ByteArray, FloatArray, IndexArray

_HYSTERESIS = 0.15  # distance from the middle level that a profile reaches on both sides of an edge

LEAST_COHERENCE_RATIO = 0.93
"""Minimum coherence of a coarser lattice relative to the most coherent one."""

_SHORTENING = 0.7  # minimum ratio of the mean shortest run to a chip: noise shortens runs

LEAST_EDGES = 5  # minimum number of edges: a bright and a dark run between the outermost runs
LEAST_COLUMNS = 2.0  # minimum number of columns per chip
LEAST_PAIR = 2.0 * _SHORTENING * LEAST_COLUMNS  # minimum columns of a bright and a dark run

_STEPS_PER_CHIP = 6.0  # lattices tried while the last edge's phase moves by a chip from the first's
_RIM_DISTANCE = 0.2  # chips from the lattice beyond which an outermost edge is the panel's rim


@dataclass(frozen=True, eq=False, slots=True)
class Edges:
    """The edges of stripes: their places in columns, in order."""

    rising: FloatArray
    falling: FloatArray

    @property
    def count(self) -> int:
        return len(self.rising) + len(self.falling)

    @classmethod
    def join(cls, parts: Sequence["Edges"]) -> "Edges":
        """Join the edges of parts that follow each other."""
        return cls(
            np.concatenate([part.rising for part in parts]),
            np.concatenate([part.falling for part in parts]),
        )

    @property
    def places(self) -> FloatArray:
        return np.sort(np.concatenate([self.rising, self.falling]))

    @property
    def order(self) -> IndexArray:
        """Index that sorts the rising edges followed by the falling ones."""
        return np.argsort(np.concatenate([self.rising, self.falling]))

    @property
    def rises(self) -> BoolArray:
        """For each of the ``places``, whether it is a rising edge."""
        return np.asarray(self.order < len(self.rising))

    def within(self, first: float, last: float) -> "Edges":
        inside = [kind[(kind >= first) & (kind <= last)] for kind in (self.rising, self.falling)]
        return Edges(*inside)

    @property
    def shortest_pair(self) -> float:
        """Sum of the lengths, in columns, of the shortest bright and the shortest dark run.

        It does not change if bright runs are lengthened and dark ones shortened.
        """
        if min(len(self.rising), len(self.falling)) == 0:
            return np.inf
        # The panel's rim may shorten the first and the last gap.
        gaps = np.diff(self.places)[1:-1]
        kinds = gaps[::2], gaps[1::2]
        return float(sum(kind.min() for kind in kinds)) if all(map(len, kinds)) else np.inf


def edges_of(flattened: FloatArray) -> Edges:
    """Find the edges of stripes whose levels are 0 and 1."""
    levels = np.where(
        flattened > 0.5 + _HYSTERESIS, 1, np.where(flattened < 0.5 - _HYSTERESIS, -1, 0)
    )
    clear = np.flatnonzero(levels)
    changes = np.flatnonzero(np.diff(levels[clear]))
    rising: list[float] = []
    falling: list[float] = []
    for change in changes.tolist():
        first, last = int(clear[change]), int(clear[change + 1])
        kind = rising if levels[last] > 0 else falling
        kind.append(_crossing(flattened[first : last + 1], first))
    return Edges(np.array(rising), np.array(falling))


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
    return np.asarray((sums[0] + sums[1]) / max(edges.count, 1))


def _phase_factors(places: FloatArray, frequencies: FloatArray) -> NDArray[np.complex128]:
    return np.asarray(np.exp(2j * np.pi * np.outer(frequencies, places)).sum(axis=1))


def find_coarsest(edges: Edges) -> Lattice | None:
    """Find the coarsest pair of lattices on which edges lie; None if none is coherent."""
    if edges.count < LEAST_EDGES or edges.shortest_pair <= LEAST_PAIR:
        return None
    longest = edges.shortest_pair / 2.0 / _SHORTENING
    extent = float(np.ptp(edges.places))
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


def chip_numbers(edges: Edges, lattice: Lattice) -> tuple[FloatArray, FloatArray]:
    """Return the rising and falling edges' positions in chips: whole numbers except for noise."""
    return (
        edges.rising * lattice.frequency - lattice.rising,
        edges.falling * lattice.frequency - lattice.falling,
    )


def remove_rims(edges: Edges, lattice: Lattice) -> Edges:
    """Remove an outermost edge if it is the panel's rim and not a chip's.

    Then it is off the lattice, or by chance nearest to the lattice point of its neighbour.
    """
    numbers, places = np.concatenate(chip_numbers(edges, lattice))[edges.order], edges.places
    nearest = np.rint(numbers)
    distances, lengths = np.abs(numbers - nearest), np.diff(nearest)
    first = places[1] if distances[0] > _RIM_DISTANCE or lengths[0] < 1 else places[0]
    last = places[-2] if distances[-1] > _RIM_DISTANCE or lengths[-1] < 1 else places[-1]
    return edges.within(float(first), float(last))


def chips_between(edges: Edges, lattice: Lattice) -> tuple[ByteArray, int] | None:
    """Return the chips between the outermost edges, and the number of the first chip.

    None if two edges lie on the same place of the lattice.
    """
    numbers = np.rint(np.concatenate(chip_numbers(edges, lattice))[edges.order]).astype(np.int64)
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
    displacements = [kind - np.rint(kind) for kind in chip_numbers(edges, lattice)]
    all_displacements = np.concatenate(displacements)
    if len(all_displacements) < 5:
        return 0.0
    strength = sum(
        len(kind) * abs(np.exp(2j * np.pi * kind).mean()) ** 2
        for kind in displacements
        if len(kind) > 1
    )
    lattices = max(1.0, float(np.ptp(edges.places)) * lattice.frequency)
    chance = min(1.0, lattices * math.exp(-strength))
    deviation = max(
        float(np.sqrt((all_displacements**2).sum() / (len(all_displacements) - 3))), 1e-9
    )
    misplaced = math.erfc(0.5 / deviation / math.sqrt(2.0))
    return (1.0 - chance) * (1.0 - misplaced) ** len(all_displacements)
