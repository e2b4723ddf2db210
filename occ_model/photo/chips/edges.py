"""The edges of stripes: where a profile crosses half-way between dark and bright."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray

_HYSTERESIS = 0.15  # height beyond the middle, on both sides of an edge, that is not noise


@dataclass(frozen=True, eq=False, slots=True)
class Edges:
    """The edges of stripes: their places in columns, in order."""

    rising: FloatArray
    falling: FloatArray

    @property
    def count(self) -> int:
        """Number of edges of either kind."""
        return len(self.rising) + len(self.falling)

    @property
    def places(self) -> FloatArray:
        """All edges in order."""
        return np.sort(np.concatenate([self.rising, self.falling]))

    def within(self, first: float, last: float) -> "Edges":
        """Keep the edges from one column to another."""
        kept = [kind[(kind >= first) & (kind <= last)] for kind in (self.rising, self.falling)]
        return Edges(*kept)

    @property
    def shortest_pair(self) -> float:
        """Length in columns of the shortest bright and the shortest dark run together.

        Light that lengthens bright runs shortens dark ones by as much.
        """
        if min(len(self.rising), len(self.falling)) == 0:
            return np.inf
        # The first and the last gap may be cut short by the panel's rim.
        gaps = np.diff(self.places)[1:-1]
        kinds = gaps[::2], gaps[1::2]
        return float(sum(kind.min() for kind in kinds)) if all(map(len, kinds)) else np.inf


def edges_of(flattened: FloatArray) -> Edges:
    """Find the edges of stripes whose levels are 0 and 1."""
    sure = np.where(
        flattened > 0.5 + _HYSTERESIS, 1, np.where(flattened < 0.5 - _HYSTERESIS, -1, 0)
    )
    known = np.flatnonzero(sure)
    changes = np.flatnonzero(np.diff(sure[known]))
    rising: list[float] = []
    falling: list[float] = []
    for change in changes.tolist():
        first, last = int(known[change]), int(known[change + 1])
        kind = rising if sure[last] > 0 else falling
        kind.append(_crossing(flattened[first : last + 1], first))
    return Edges(np.array(rising), np.array(falling))


def _crossing(part: FloatArray, first: int) -> float:
    """Return the mean of the places at which a part of a profile crosses one half."""
    before = np.flatnonzero((part[1:] > 0.5) != (part[:-1] > 0.5))
    low, high = part[before], part[before + 1]
    return first + float(np.mean(before + (0.5 - low) / (high - low)))
