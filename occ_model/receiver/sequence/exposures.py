"""What the rows say of the chips: each row is the mean of the chips that its exposure covers.

Row i is exposed over [i s + p, i s + p + T] in chips, with s = t_r f, T = t f and a phase p. The
share of chip k in it is the overlap of the exposure with [k, k + 1], over T: the taps of a
rectangular filter, sampled at the line rate.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray, IndexArray

_KINDS = 4
"""Kinds of chips in an exposure: the latest, those it covers whole, and the two earliest."""


@dataclass(frozen=True, slots=True)
class Timing:
    """The timing of rows against chips.

    Parameters
    ----------
    exposure
        Length of an exposure in chips, T.
    step
        Chips from the start of one row's exposure to that of the next, s.
    phase
        Where the first row's exposure starts, in chips, p; chip 0 starts at 0.
    """

    exposure: float
    step: float
    phase: float = 0.0

    @property
    def memory(self) -> int:
        """Chips that an exposure can reach back to, from the one that it ends in; at least one."""
        return max(1, int(np.ceil(self.exposure - 1e-9)))

    def starts(self, rows: int) -> FloatArray:
        """Return where the exposure of each row starts, in chips, shape (rows,)."""
        return np.asarray(self.phase + self.step * np.arange(rows), dtype=np.float64)


def taps(timing: Timing, starts: FloatArray) -> tuple[IndexArray, FloatArray]:
    """Return the chip that each exposure ends in, and the shares of that and the chips before.

    Parameters
    ----------
    timing
        Its exposure is used.
    starts : ndarray of float64, any shape
        Where the exposures start, in chips.

    Returns
    -------
    last : ndarray of int64, shape as ``starts``
        The chips.
    shares : ndarray of float64, shape (..., memory + 1)
        The shares of the chip and of those before it, the latest first; their sum is 1.
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

    Parameters
    ----------
    first
        The first chip that a row ends in.
    features : ndarray of float64, shape (chips, features)
        v, the diagonal of G, and twice the entries of its upper triangle.
    energy : ndarray of float64, shape (chips,)
        The number that does not depend on the chips.
    """

    first: int
    features: FloatArray
    energy: FloatArray


def features_of(words: FloatArray) -> FloatArray:
    """Return what each feature counts in the distance of some chips, shape (..., features)."""
    upper, lower = np.triu_indices(words.shape[-1], 1)
    return np.concatenate([-2.0 * words, words, words[..., upper] * words[..., lower]], axis=-1)


def gather(light: FloatArray, timing: Timing) -> ChipStatistics:
    """Gather rows by the chip that each of them ends in.

    Parameters
    ----------
    light : ndarray of float64, shape (rows,)
        The share of full light of each row.
    timing
        The timing.
    """
    last, shares = taps(timing, timing.starts(len(light)))
    first, count = int(last[0]), int(last[-1] - last[0]) + 1
    # Between the first chips and the last ones of an exposure all have the same share.
    reach = shares.shape[1]
    kind = np.clip(np.arange(reach), None, 1)
    kind[-2:] = np.arange(reach)[-2:] if reach < _KINDS else (2, 3)
    of_kinds = np.ascontiguousarray(shares[:, np.unique(kind, return_index=True)[1]].T)
    kinds = len(of_kinds)
    one, other = np.triu_indices(kinds)
    terms = np.concatenate(
        [of_kinds * light, of_kinds[one] * of_kinds[other], (light * light)[None]]
    )
    # Differences of running sums: exact enough, as no sum exceeds the number of rows.
    running = np.pad(np.cumsum(terms, axis=1), ((0, 0), (1, 0)))
    edges = np.searchsorted(last, np.arange(first, first + count + 1))
    sums = np.diff(running[:, edges], axis=1)
    upper, lower = np.triu_indices(reach, 1)
    product = np.zeros((kinds, kinds), dtype=np.int64)
    product[one, other] = product[other, one] = kinds + np.arange(len(one))
    features = np.concatenate(
        [sums[kind], sums[product[kind, kind]], 2.0 * sums[product[kind[upper], kind[lower]]]]
    )
    return ChipStatistics(first, features.T, sums[-1])
