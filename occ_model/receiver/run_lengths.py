"""Runs of ones and zeros, and the length of one chip that they tell of."""

from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, IndexArray
from occ_model.receiver.otsu import otsu_split
from occ_model.results import Runs

_LONGEST = np.array([2, 4])
"""Chips of the longest run of zeros, and of ones: a header after data that end in a one."""

_HEADER_RUNS = (3, 4)
"""Chips of the run of ones that holds a header: its own three, or four after a one."""


def runs_of(binary: ByteArray) -> Runs:
    """Split zeros and ones into runs of equal values."""
    changes = np.flatnonzero(binary[1:] != binary[:-1]) + 1
    starts = np.concatenate([[0], changes])
    lengths = np.diff(np.concatenate([starts, [len(binary)]])).astype(np.int64)
    return Runs(binary[starts], lengths)


def short_run(lengths: IndexArray) -> float:
    """Average the short runs: those below the Otsu split of the histogram of run lengths."""
    split = otsu_split(np.bincount(lengths))
    short = lengths if split is None else lengths[lengths <= split]
    return float(short.mean())


@dataclass(frozen=True, slots=True)
class ChipFit:
    """How run lengths turn into chips.

    A run of n ones is ``n * chip_length + widening`` columns long, one of n zeros as much shorter
    as ones are wider: a threshold off the middle moves every edge by the same amount.
    """

    chip_length: float
    widening: float
    misfit: float
    """Root mean square distance from whole chips, plus the share of runs that are too long."""

    def chips_in(self, runs: Runs) -> IndexArray:
        """Count the chips of every run, at least one each."""
        sign = np.where(runs.values == 1, 1.0, -1.0)
        counts = np.rint((runs.lengths - sign * self.widening) / self.chip_length)
        return np.maximum(counts, 1.0).astype(np.int64)


def fit_chips(runs: Runs) -> ChipFit:
    """Find the length of one chip from whole runs.

    The paper splits the histogram of the ones' run lengths, and that of the zeros', by Otsu's
    threshold and takes the average of the short runs for one chip. For zeros that always holds,
    since every packet has single zeros. For ones it misreads a code whose short runs are two chips
    long, such as 1023, and one whose single and double runs the split leaves together. So the
    ones' short runs are tried as one chip and as two, and the longest run of ones, which is the
    header's, as three chips and as four. Each trial is refined by least squares; the one whose
    runs lie nearest to whole chips within the longest that the framing allows is taken.

    Parameters
    ----------
    runs
        Runs that are not cut off by the region's edges, of both kinds.

    Returns
    -------
    ChipFit
    """
    zeros, ones = (runs.lengths[runs.values == value] for value in (0, 1))
    one_zero = short_run(zeros)
    trials = [(short_run(ones), chips) for chips in (1, 2)]
    trials += [(float(ones.max()), chips) for chips in _HEADER_RUNS]
    # What a threshold off the middle takes from a run of ones it gives to the run of zeros.
    lengths = [(length + one_zero) / (chips + 1) for length, chips in trials]
    fits = [_refined(runs, ChipFit(length, length - one_zero, 0.0)) for length in lengths]
    return min(fits, key=lambda fit: fit.misfit)


def _refined(runs: Runs, fit: ChipFit) -> ChipFit:
    """Improve a first guess by least squares over the runs' whole numbers of chips."""
    sign = np.where(runs.values == 1, 1.0, -1.0)
    for _ in range(3):
        counts = fit.chips_in(runs).astype(np.float64)
        terms = np.stack([counts, sign], axis=1)
        (chip_length, widening), *_ = np.linalg.lstsq(terms, runs.lengths, rcond=None)
        if chip_length <= 0.0:
            break
        fit = ChipFit(float(chip_length), float(widening), 0.0)
    chips = fit.chips_in(runs)
    residual = (runs.lengths - sign * fit.widening) / fit.chip_length - chips
    too_long = float(np.mean(chips > _LONGEST[runs.values]))
    return replace(fit, misfit=float(np.sqrt(np.mean(residual**2))) + too_long)
