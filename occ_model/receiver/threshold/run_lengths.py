"""Run lengths of ones and zeros, and the length of one chip estimated from them."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.receiver.signal import otsu_split
from occ_model.results.decoding import RunHistogram, Runs

_MAX_RUN_CHIPS = np.array([2, 4])  # chips of a run of zeros, and of ones: a header after a one
_HEADER_RUNS = (3, 4)  # chips of the run of ones that holds a header: its three, or one more
_NO_HEADER_PENALTY = 0.1  # penalty in chips of a fit without a header, as the picture may show none
_WIDENING_PENALTY = 0.05  # penalty of a pattern's fit, in chips, for each chip of widening
_WIDENINGS = 19  # widenings that are tried for a raw pattern, which has no framing

_IMPROVEMENTS = 3  # maximum rounds of least squares; they end when the numbers of chips stay


def runs_of(binary: ByteArray) -> Runs:
    """Split zeros and ones into runs of equal values."""
    changes = np.flatnonzero(binary[1:] != binary[:-1]) + 1
    starts = np.concatenate([[0], changes])
    lengths = np.diff(np.concatenate([starts, [len(binary)]])).astype(np.int64)
    return Runs(binary[starts], lengths)


def run_histogram(runs: Runs, value: int) -> RunHistogram:
    """Count the run lengths of zeros or of ones, and split them by Otsu's threshold."""
    counts = np.bincount(runs.lengths[runs.values == value]).astype(np.int64)
    return RunHistogram(counts, otsu_split(counts))


def short_run(histogram: RunHistogram) -> float:
    """Average the short runs: those up to the histogram's split, or all where there is none."""
    counts = histogram.counts[: None if histogram.split is None else histogram.split + 1]
    return float(counts @ np.arange(len(counts)) / counts.sum())


@dataclass(frozen=True, slots=True)
class ChipFit:
    """The relation of run lengths to chips.

    A run of n ones is ``n * chip_length + widening`` columns long, one of n zeros
    ``n * chip_length - widening``: a threshold off the middle moves every edge by the same amount.
    """

    chip_length: float
    widening: float
    misfit: float  # root mean square distance from whole chips, plus penalties

    def chips_in(self, runs: Runs) -> IndexArray:
        sign = np.where(runs.values == 1, 1.0, -1.0)
        counts = np.rint((runs.lengths - sign * self.widening) / self.chip_length)
        return np.maximum(counts, 1.0).astype(np.int64)


def fit_chips(runs: Runs, histograms: tuple[RunHistogram, RunHistogram]) -> ChipFit:
    """Find the length of one chip from whole runs of both kinds.

    The paper splits the histogram of the ones' run lengths, and that of the zeros', by Otsu's
    threshold; the average of the short runs is one chip. That misreads a code whose short runs are
    two chips long, such as 1023, and one whose single and double runs are on one side of the split.
    So the ones' short runs are tried as one chip and as two, the longest run of ones, which holds
    the header, as three chips and as four, and the zeros' short runs as one chip and as two (an odd
    number of bits, all of them 1, leaves no single zero). Each trial is refined by least squares.
    The best trial is the one whose runs are nearest to whole chips, no longer than the framing
    allows, and include a header. A widening may exceed a chip: a packet without single chips can
    still be read.
    """
    short_zero, short_one = (short_run(histogram) for histogram in histograms)
    longest_one = float(len(histograms[1].counts) - 1)
    trials = [(short_one, chips) for chips in (1, 2)]
    trials += [(longest_one, chips) for chips in _HEADER_RUNS]
    one_length, one_chips, zero_chips = np.array(
        [(length, chips, zeros_in) for zeros_in in (1, 2) for length, chips in trials]
    ).T
    # A threshold off the middle shortens runs of ones by as much as it lengthens those of zeros.
    chip_length = (one_length + short_zero) / (one_chips + zero_chips)
    return _best_fit(runs, chip_length, one_length - one_chips * chip_length)


def fit_pattern(runs: Runs, nominal: float) -> ChipFit:
    """Find the length of one chip of a raw pattern, near a nominal one.

    Without packets the runs do not distinguish one chip from two, so the scale must be known.
    Several widenings are tried, of which smaller ones are likelier. Where an enhancement has moved
    the threshold by more than half a chip, the runs of one pattern can equal those of another.
    """
    widening = nominal * np.linspace(-0.9, 0.9, _WIDENINGS)
    # A threshold is rarely far off the middle.
    penalty = _WIDENING_PENALTY * np.abs(widening) / nominal
    chip_length = np.full(_WIDENINGS, nominal)
    return _best_fit(runs, chip_length, widening, penalty, nominal=nominal)


def _best_fit(
    runs: Runs,
    chip_length: FloatArray,
    widening: FloatArray,
    penalty: FloatArray | float = 0.0,
    nominal: float | None = None,
) -> ChipFit:
    """Improve first guesses by least squares over the runs' whole chips, and return the best.

    All guesses are improved at once, and equal runs are counted, not repeated. With a ``nominal``
    length, the distance from it counts in place of the framing.
    """
    kinds, repeats = np.unique(2 * runs.lengths + runs.values, return_counts=True)
    values, lengths = kinds % 2, (kinds // 2).astype(np.float64)
    sign = np.where(values == 1, 1.0, -1.0)

    def chips() -> FloatArray:
        counts = np.rint((lengths - sign * widening[:, None]) / chip_length[:, None])
        return np.asarray(np.maximum(counts, 1.0))

    n = chips()
    for _ in range(_IMPROVEMENTS):
        # Normal equations of lengths = chip_length * n + widening * sign.
        nn, ns, ss = (n * n) @ repeats, n @ (repeats * sign), float(repeats.sum())
        nl, sl = n @ (repeats * lengths), float((sign * lengths) @ repeats)
        determinant = nn * ss - ns**2  # never 0: ones and zeros differ in sign
        better = (ss * nl - ns * sl) / determinant
        usable = better > 0.0
        widening = np.where(usable, (nn * sl - ns * nl) / determinant, widening)
        chip_length = np.where(usable, better, chip_length)
        before, n = n, chips()
        if np.array_equal(before, n):
            break

    residual = (lengths - sign * widening[:, None]) / chip_length[:, None] - n
    misfit = penalty + np.sqrt((residual**2) @ repeats / repeats.sum())
    if nominal is not None:
        misfit += np.abs(chip_length / nominal - 1.0)
    else:
        misfit += (n > _MAX_RUN_CHIPS[values]) @ repeats / repeats.sum()
        ones = n[:, values == 1]
        has_header = ((ones >= min(_HEADER_RUNS)) & (ones <= max(_HEADER_RUNS))).any(axis=1)
        misfit += np.where(has_header, 0.0, _NO_HEADER_PENALTY)
    best = int(misfit.argmin())
    return ChipFit(float(chip_length[best]), float(widening[best]), float(misfit[best]))
