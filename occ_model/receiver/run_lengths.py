"""Runs of ones and zeros, and the length of one chip that they tell of."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.receiver.otsu import otsu_split
from occ_model.results import Runs

_LONGEST_ONES = (3, 4)
"""Chips of the longest run of ones: the header's three, or four where the data end in a one."""

_LONGEST_ZEROS = 2
"""Chips of the longest run of zeros that the line code allows."""


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

    def chips_in(self, runs: Runs) -> IndexArray:
        """Count the chips of every run, at least one each."""
        sign = np.where(runs.values == 1, 1.0, -1.0)
        counts = np.rint((runs.lengths - sign * self.widening) / self.chip_length)
        return np.maximum(counts, 1.0).astype(np.int64)


def fit_chips(runs: Runs) -> ChipFit | None:
    """Find the length of one chip from whole runs.

    The paper splits the histogram of the ones' run lengths, and that of the zeros', by Otsu's
    threshold and takes the average of the short runs for one chip. That misreads a code whose
    runs are all two chips long, such as 1023, where "short" means two. So the average is taken as
    one chip, and as two; and what decides is the framing: every packet has one header, so that
    the longest run of ones must come out as three chips, or as four where the data end in a one,
    and no run of zeros as more than two. Among what is left the best fit to whole chips wins.

    Parameters
    ----------
    runs
        Runs that are not cut off by the region's edges.

    Returns
    -------
    ChipFit or None
        None where no chip length agrees with the framing.
    """
    sign = np.where(runs.values == 1, 1.0, -1.0)
    shorts = [short_run(runs.lengths[runs.values == v]) for v in (0, 1) if v in runs.values]
    fits = []
    for candidate in (short / chips for short in shorts for chips in (1, 2, 3)):
        fit = _refined(runs, sign, candidate)
        if fit is not None and _agrees(runs, fit):
            fits.append(fit)
    return min(fits, key=lambda fit: fit.misfit, default=None)


def _refined(runs: Runs, sign: FloatArray, chip_length: float) -> ChipFit | None:
    """Improve a first guess by least squares over the runs' whole numbers of chips."""
    lengths = runs.lengths.astype(np.float64)
    fit = ChipFit(chip_length, 0.0, np.inf)
    for _ in range(3):
        counts = fit.chips_in(runs).astype(np.float64)
        # Normal equations of lengths = chip_length * counts + widening * sign.
        a, b, c = counts @ counts, counts @ sign, float(len(counts))
        determinant = a * c - b * b
        if determinant <= 1e-9 * a * c:  # all runs alike: nothing to part the two by
            chip_length, widening = float(counts @ lengths) / a, 0.0
        else:
            x, y = counts @ lengths, sign @ lengths
            chip_length = float(c * x - b * y) / determinant
            widening = float(a * y - b * x) / determinant
        if chip_length <= 0.0:
            return None
        residual = (lengths - chip_length * counts - widening * sign) / chip_length
        fit = ChipFit(chip_length, widening, float(np.sqrt(np.mean(residual**2))))
    return fit


def _agrees(runs: Runs, fit: ChipFit) -> bool:
    """Whether the longest runs are as long as the framing says."""
    counts = fit.chips_in(runs)
    longest = [int(counts[runs.values == value].max(initial=0)) for value in (0, 1)]
    return longest[0] <= _LONGEST_ZEROS and longest[1] in _LONGEST_ONES
