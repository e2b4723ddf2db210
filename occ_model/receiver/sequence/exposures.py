"""Model the light of rows: each row is the mean of the chips in its exposure.

Row i is exposed over [i s + p, i s + p + T] in chips, with s = t_r f, T = t f and a phase p. The
fraction of chip k in it is the overlap of the exposure with [k, k + 1], divided by T: the taps of a
rectangular filter, sampled at the line rate.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, IndexArray

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


def taps(timing: RowTiming, starts: FloatArray) -> tuple[IndexArray, FloatArray]:
    """Return the chip in which each exposure ends, and the fractions of it and of earlier chips.

    The fractions have the shape (..., memory + 1), with the latest first; their sum is 1.
    """
    ends = starts + timing.exposure
    last = np.floor(ends)
    begins = last[..., None] - np.arange(timing.memory + 1)
    overlap = np.minimum(ends[..., None], begins + 1.0) - np.maximum(starts[..., None], begins)
    return last.astype(np.int64), np.maximum(overlap, 0.0) / timing.exposure


@dataclass(frozen=True, eq=False, slots=True)
class ChipStatistics:
    """Statistics that determine the squared distance of rows from chips, for each last chip.

    The squared distance of the rows that end in a chip from the light of chips c is c' G c - 2 v'
    c, plus a number that does not depend on the chips.
    """

    first: int  # The first chip in which a row ends
    # Shape (chips, features): v, the diagonal of G, and twice the entries of its upper triangle
    features: FloatArray
    energy: FloatArray  # Shape (chips,): the number that does not depend on the chips


def features_of(words: FloatArray) -> FloatArray:
    """Return the weight of each feature in the distance from some chips, shape (..., features)."""
    upper, lower = _pairs(words.shape[-1])
    return np.concatenate([-2.0 * words, words, words[..., upper] * words[..., lower]], axis=-1)


@lru_cache(maxsize=32)
def _pairs(count: int) -> tuple[IndexArray, IndexArray]:
    return np.triu_indices(count, 1)


@lru_cache(maxsize=32)
def _kinds(reach: int) -> tuple[IndexArray, IndexArray, IndexArray, IndexArray]:
    """Group the chips of an exposure that have the same sums over rows into kinds.

    All chips between the first and the last ones have the same fraction. Returns one chip of each
    kind, the two kinds of each product of fractions, and the index of each feature's sum: first
    come the sums of a kind times the light, then those of the products.
    """
    kind = np.clip(np.arange(reach), None, 1)
    kind[-2:] = np.arange(reach)[-2:] if reach < _KINDS else (2, 3)
    examples = np.unique(kind, return_index=True)[1]
    kinds = len(examples)
    first_kind, second_kind = np.triu_indices(kinds)
    product = np.zeros((kinds, kinds), dtype=np.int64)
    product[first_kind, second_kind] = product[second_kind, first_kind] = kinds + np.arange(
        len(first_kind)
    )
    upper, lower = _pairs(reach)
    sums = np.concatenate([kind, product[kind, kind], product[kind[upper], kind[lower]]])
    return examples, first_kind, second_kind, sums


def gather(light: FloatArray, timing: RowTiming) -> ChipStatistics:
    """Sum up rows, given as fractions of full light, for each chip in which rows end."""
    last, fractions = taps(timing, timing.starts(len(light)))
    first, reach = int(last[0]), fractions.shape[1]
    examples, first_kind, second_kind, sums = _kinds(reach)
    kind_fractions = np.ascontiguousarray(fractions[:, examples].T)
    # Differences of running sums are exact enough, as no sum exceeds the number of rows.
    running_sums = np.zeros((len(examples) + len(first_kind) + 1, len(light) + 1))
    terms = running_sums[:, 1:]
    np.multiply(kind_fractions, light, out=terms[: len(examples)])
    np.multiply(
        kind_fractions[first_kind], kind_fractions[second_kind], out=terms[len(examples) : -1]
    )
    np.multiply(light, light, out=terms[-1])
    np.cumsum(terms, axis=1, out=terms)
    edges = np.searchsorted(last, np.arange(first, int(last[-1]) + 2))
    chip_sums = np.diff(running_sums[:, edges], axis=1)
    features = chip_sums[sums]
    features[2 * reach :] *= 2.0
    return ChipStatistics(first, features.T, chip_sums[-1])
