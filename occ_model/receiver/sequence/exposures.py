"""Model the light of rows: each row is the mean of the chips in its exposure.

Row i is exposed over [i s + p, i s + p + T] in chips, with s = t_r f, T = t f and a phase p. The
fraction of chip k in it is the overlap of the exposure with [k, k + 1], divided by T: the taps of a
rectangular filter, sampled at the line rate.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray

_KINDS = 4  # kinds of chips in an exposure: the latest, completely covered ones, the two earliest


@dataclass(frozen=True, slots=True)
class RowTiming:
    """The timing of rows relative to chips."""

    exposure: float  # Length of an exposure in chips, T
    step: float  # Chips between the starts of consecutive rows' exposures, s
    phase: float = 0.0  # Start of the first row's exposure in chips, p; chip 0 starts at 0

    @property
    def memory(self) -> int:
        """Number of chips over which an exposure extends back, at least 1."""
        return max(1, int(np.ceil(self.exposure - 1e-9)))

    def starts(self, rows: int) -> FloatArray:
        """Return the start of each row's exposure in chips, shape (rows,)."""
        return np.asarray(self.phase + self.step * np.arange(rows), dtype=np.float64)


def taps(
    timing: RowTiming, starts: FloatArray, ages: IndexArray | None = None
) -> tuple[IndexArray, FloatArray]:
    """Return the chip in which each exposure ends, and the fractions of it and of earlier chips.

    ``ages``: how many chips before the last one each begins, by default all from 0 to ``memory``.
    The fractions have the shape (ages, ...); the sum of all is 1.
    """
    if ages is None:
        ages = np.arange(timing.memory + 1)
    last = np.floor(starts + timing.exposure)
    start = starts - last
    # An exposure covers a chip up to the chip's end, and the last one up to its own end.
    covered = np.subtract.outer(1.0 - ages, start)
    covered[ages == 0] = start + timing.exposure
    # Short exposures differ from their ends by no more than the rounding of their starts.
    np.clip(covered, 0.0, min(1.0, timing.exposure), out=covered)
    covered /= timing.exposure
    return last.astype(np.int64), covered


@dataclass(frozen=True, eq=False, slots=True)
class ChipStatistics:
    """Statistics that determine the squared distance of rows from chips, for each last chip.

    All chips of an exposure between the last one and the two earliest have the same fraction, and
    thus are of one kind: with k_i lit chips of kind i, the squared distance of the rows that end in
    a chip is sum_ij S_ij k_i k_j - 2 sum_i V_i k_i, plus a number that does not depend on the
    chips. V_i sums the rows' light times the kind's fraction, S_ij the products of fractions.
    """

    first: int  # The first chip in which a row ends
    sums: FloatArray  # Shape (weights, chips): V, then the upper triangle of S with its diagonal
    energy: FloatArray  # Shape (chips,): the number that does not depend on the chips


def weights_of(words: ByteArray) -> FloatArray:
    """Return the factor of each of the sums in the squared distance, shape (weights, ...).

    ``words``: the chips of exposures with the latest first, shape (..., memory + 1).
    """
    ages, first, second = _kinds(words.shape[-1])
    bounds = np.append(ages, words.shape[-1])
    lit = np.stack([words[..., a:b].sum(axis=-1) for a, b in pairwise(bounds)]).astype(np.float64)
    products = lit[first] * lit[second]
    products[first != second] *= 2.0
    return np.concatenate([-2.0 * lit, products])


@lru_cache(maxsize=32)
def _kinds(reach: int) -> tuple[IndexArray, IndexArray, IndexArray]:
    """Return the age of each kind's latest chip, and the two kinds of each product."""
    ages = np.arange(reach) if reach <= _KINDS else np.array([0, 1, reach - 2, reach - 1])
    return (ages, *np.triu_indices(len(ages)))


def gather(light: FloatArray, timing: RowTiming) -> ChipStatistics:
    """Sum up rows, given as fractions of full light, for each chip in which rows end."""
    ages, first, second = _kinds(timing.memory + 1)
    last, fractions = taps(timing, timing.starts(len(light)), ages)
    kinds, products = len(ages), len(first)
    terms = np.empty((kinds + products + 1, len(light)))
    np.multiply(fractions, light, out=terms[:kinds])
    np.multiply(fractions[first], fractions[second], out=terms[kinds:-1])
    np.multiply(light, light, out=terms[-1])
    edges = np.searchsorted(last, np.arange(last[0], last[-1] + 2))
    sums = np.add.reduceat(terms, edges[:-1], axis=1)
    sums[:, np.diff(edges) == 0] = 0.0  # where a step is a whole chip, rounding may skip one
    return ChipStatistics(int(last[0]), sums[:-1], sums[-1])
