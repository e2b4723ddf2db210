"""The most likely chips of a trellis, and how much likelier each is than its opposite.

The forward and the backward recursion over the trellis (Bahl, Cocke, Jelinek and Raviv, IEEE Trans.
Inf. Theory 20:284, 1974) with the largest term of each sum alone: max-log-MAP. The chips that come
out are those of the Viterbi algorithm. A long sequence is cut into parts that overlap, so that
numpy works on all parts at once.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.receiver.sequence.exposures import ChipStatistics, features_of
from occ_model.receiver.sequence.trellis import NO_STATE, Trellis

_NEVER = 1e30
"""Distance of a state that cannot be reached."""

SURVIVAL = 5
"""Memories of a trellis after which the paths that survive have one beginning."""

_LONGEST_PART = 128
"""Chips of a part of a sequence, without what overlaps."""


@dataclass(frozen=True, eq=False, slots=True)
class Chips:
    """Chips that were detected.

    Parameters
    ----------
    first
        The number of the first of them.
    values : ndarray of uint8, shape (chips,)
        The chips.
    margins : ndarray of float64, shape (chips,)
        By how much the squared distance of the rows would grow if this chip were the opposite, the
        others then being the best for it.
    """

    first: int
    values: ByteArray
    margins: FloatArray


def best_chips(trellis: Trellis, statistics: ChipStatistics) -> Chips:
    """Find the chips whose light is nearest to the rows, from the first that a row can show.

    Parameters
    ----------
    trellis
        The code.
    statistics
        What the rows say.
    """
    # The first row shows one chip more than the state after it holds: the state before it does.
    features = np.pad(statistics.features, ((1, 0), (0, 0)))
    parts = _Parts.of(len(features), trellis.memory)
    costs = _costs(trellis, parts.of_chips(features))
    forward = _forward(trellis, costs)
    both = _add_backward(trellis, costs, forward)
    values, margins = _decided(trellis, both, parts)
    return Chips(statistics.first - trellis.memory, values, margins)


def least_distances(trellis: Trellis, statistics: Sequence[ChipStatistics]) -> FloatArray:
    """Return the least squared distance of rows from any chips, for several timings.

    Parameters
    ----------
    trellis
        The code.
    statistics
        What the rows say at each timing.

    Returns
    -------
    ndarray of float64, shape (timings,)
    """
    count = max(len(one.features) for one in statistics)
    features = np.zeros((count, len(statistics), statistics[0].features.shape[1]))
    for place, one in enumerate(statistics):
        features[: len(one.features), place] = one.features
    now = np.zeros((trellis.states, len(statistics)))
    for cost in _costs(trellis, features):
        now = np.add(now[trellis.before], cost).min(axis=0)
    energy = np.array([float(one.energy.sum()) for one in statistics])
    return np.asarray(now.min(axis=0) + energy)


@dataclass(frozen=True, eq=False, slots=True)
class _Parts:
    """Parts of a sequence of equal length, each reaching into its neighbours."""

    count: int
    core: int
    overlap: int
    chips: IndexArray
    """The chip of each step of each part, shape (steps, parts); outside there are none."""

    @classmethod
    def of(cls, count: int, memory: int) -> Self:
        overlap = SURVIVAL * (memory + 1)
        parts = -(-count // _LONGEST_PART)
        if parts == 1 or count <= 2 * overlap:
            return cls(count, count, 0, np.arange(count)[:, None])
        core = -(-count // parts)
        steps = np.arange(-overlap, core + overlap)
        return cls(count, core, overlap, steps[:, None] + core * np.arange(parts))

    def of_chips(self, features: FloatArray) -> FloatArray:
        """Return the features of each step of each part; 0 where there are no rows."""
        inside = (self.chips >= 0) & (self.chips < self.count)
        return features[np.clip(self.chips, 0, self.count - 1)] * inside[..., None]


def _costs(trellis: Trellis, features: FloatArray) -> FloatArray:
    """Return the squared distance of each step of the trellis.

    Parameters
    ----------
    trellis
        The code.
    features : ndarray of float64, shape (chips, parts, features)
        What the rows say.

    Returns
    -------
    ndarray of float64, shape (chips, steps, states, parts)
    """
    of_words = features_of(trellis.words).reshape(-1, features.shape[-1])
    costs = of_words @ features.swapaxes(1, 2)
    costs[:, (trellis.before == NO_STATE).ravel()] = _NEVER
    return np.asarray(costs.reshape(len(costs), *trellis.before.shape, -1))


def _forward(trellis: Trellis, costs: FloatArray) -> FloatArray:
    """Return the least distance of the ways to each state, shape (chips, states, parts)."""
    least = np.empty((len(costs), trellis.states, costs.shape[-1]))
    now, ways = np.zeros(least.shape[1:]), np.empty(costs.shape[1:])
    for step, cost in enumerate(costs):
        np.add(now.take(trellis.before, axis=0, out=ways, mode="wrap"), cost, out=ways)
        now = np.minimum.reduce(ways, axis=0, out=least[step])
    return least


def _add_backward(trellis: Trellis, costs: FloatArray, forward: FloatArray) -> FloatArray:
    """Add the least distance of the ways on from each state, in place."""
    now = np.zeros(forward.shape[1:])
    ways = np.empty((costs.shape[1] * costs.shape[2] + 1, costs.shape[-1]))
    ways[NO_STATE] = _NEVER
    on, into = np.empty((*trellis.after.shape, costs.shape[-1])), ways[:-1].reshape(costs.shape[1:])
    for step in range(len(costs) - 2, -1, -1):
        np.add(costs[step + 1], now, out=into)
        ways.take(trellis.after, axis=0, out=on, mode="wrap")
        np.minimum.reduce(on, axis=0, out=now)
        forward[step] += now
    return forward


def _decided(trellis: Trellis, distance: FloatArray, parts: _Parts) -> tuple[ByteArray, FloatArray]:
    """Decide each chip from the least distance of the ways through each state."""

    def margins(of_states: FloatArray, age: int) -> FloatArray:
        lit = trellis.chips[:, age] == 1
        dark = of_states[..., ~lit, :].min(axis=-2)
        return np.asarray(dark - of_states[..., lit, :].min(axis=-2))

    inner = distance[parts.overlap : parts.overlap + parts.core]
    # The first state also holds the chips before its own.
    first = [margins(inner[0], age)[0] for age in range(trellis.memory - 1, 0, -1)]
    later = margins(inner, 0).T.ravel()[: parts.count]
    lit = np.concatenate([first, later])
    return (lit > 0.0).astype(np.uint8), np.abs(lit)
