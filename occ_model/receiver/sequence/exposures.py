"""What the rows show of the chips: each row is the mean of the chips that its exposure covers.

Row i is exposed over [i s + p, i s + p + T] in chips, with s = t_r f, T = t f and a phase p. The
fraction of chip k in it is the overlap of the exposure with [k, k + 1], over T: the taps of a
rectangular filter, sampled at the line rate.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, IndexArray

_KINDS = 4  # kinds of chips in an exposure: the latest, those it covers whole, and the two earliest


@dataclass(frozen=True, slots=True)
class Timing:
    """The timing of rows against chips."""

    exposure: float  # Length of an exposure in chips, T
    step: float  # Chips from the start of one row's exposure to that of the next, s
    phase: float = 0.0  # Where the first row's exposure starts, in chips, p; chip 0 starts at 0

    @property
    def memory(self) -> int:
        """Number of chips that an exposure reaches back over, at least 1."""
        return max(1, int(np.ceil(self.exposure - 1e-9)))

    def starts(self, rows: int) -> FloatArray:
        """Return where the exposure of each row starts, in chips, shape (rows,)."""
        return np.asarray(self.phase + self.step * np.arange(rows), dtype=np.float64)


def taps(timing: Timing, starts: FloatArray) -> tuple[IndexArray, FloatArray]:
    """Return the chip that each exposure ends in, and the fractions of that and the chips before.

    Those have the shape (..., memory + 1), the latest first; their sum is 1.
    """
    ends = starts + timing.exposure
    last = np.floor(ends)
    begins = last[..., None] - np.arange(timing.memory + 1)
    overlap = np.minimum(ends[..., None], begins + 1.0) - np.maximum(starts[..., None], begins)
    return last.astype(np.int64), np.maximum(overlap, 0.0) / timing.exposure


@dataclass(frozen=True, eq=False, slots=True)
class ChipStatistics:
    """All that a squared distance of rows from chips depends on, gathered by the last chip.

    The squared distance of the rows that end in a chip from the light of chips c is
    c' G c - 2 v' c, and a number that does not depend on the chips.
    """

    first: int  # The first chip that a row ends in
    # Shape (chips, features): v, the diagonal of G, and twice the entries of its upper triangle
    features: FloatArray
    energy: FloatArray  # Shape (chips,): the number that does not depend on the chips


def features_of(words: FloatArray) -> FloatArray:
    """Return the weight of each feature in the distance of some chips, shape (..., features)."""
    upper, lower = _pairs(words.shape[-1])
    return np.concatenate([-2.0 * words, words, words[..., upper] * words[..., lower]], axis=-1)


@lru_cache(maxsize=32)
def _pairs(count: int) -> tuple[IndexArray, IndexArray]:
    return np.triu_indices(count, 1)


@lru_cache(maxsize=32)
def _kinds(reach: int) -> tuple[IndexArray, IndexArray, IndexArray, IndexArray]:
    """Return which chips of an exposure have the same sums over rows.

    Between its first chips and its last ones all have the same fraction. Returns a chip of each
    kind, the pairs of kinds whose fractions are multiplied, and which sum each feature is: first
    those of a kind and the light, then those products.
    """
    kind = np.clip(np.arange(reach), None, 1)
    kind[-2:] = np.arange(reach)[-2:] if reach < _KINDS else (2, 3)
    chosen = np.unique(kind, return_index=True)[1]
    kinds = len(chosen)
    one, other = np.triu_indices(kinds)
    product = np.zeros((kinds, kinds), dtype=np.int64)
    product[one, other] = product[other, one] = kinds + np.arange(len(one))
    upper, lower = _pairs(reach)
    sums = np.concatenate([kind, product[kind, kind], product[kind[upper], kind[lower]]])
    return chosen, one, other, sums


def gather(light: FloatArray, timing: Timing) -> ChipStatistics:
    """Gather rows, each a fraction of full light, by the chip that each of them ends in."""
    last, fractions = taps(timing, timing.starts(len(light)))
    first, reach = int(last[0]), fractions.shape[1]
    chosen, one, other, sums = _kinds(reach)
    of_kinds = np.ascontiguousarray(fractions[:, chosen].T)
    # Differences of running sums: exact enough, as no sum exceeds the number of rows.
    running = np.zeros((len(chosen) + len(one) + 1, len(light) + 1))
    terms = running[:, 1:]
    np.multiply(of_kinds, light, out=terms[: len(chosen)])
    np.multiply(of_kinds[one], of_kinds[other], out=terms[len(chosen) : -1])
    np.multiply(light, light, out=terms[-1])
    np.cumsum(terms, axis=1, out=terms)
    edges = np.searchsorted(last, np.arange(first, int(last[-1]) + 2))
    of_chips = np.diff(running[:, edges], axis=1)
    features = of_chips[sums]
    features[2 * reach :] *= 2.0
    return ChipStatistics(first, features.T, of_chips[-1])
