"""The paper's decoder: Otsu's threshold, the lengths of runs and of one chip, headers, bits."""

from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.receiver.decoder import (
    Decoder,
    columns_of_chip,
    has_short_chips,
    read_payload,
    short_view,
    with_short_chips,
)
from occ_model.receiver.signal import otsu_split, otsu_threshold, why_flat
from occ_model.results.decoding import PAPER_DECODER, DecodeResult, RunHistogram, Runs
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import scheme_of

_MIN_RUNS = 3  # fewest whole runs from which a chip's length is estimated


_LONGEST_EXPOSURE = 2.0
"""Chips of an exposure beyond which a single chip leaves less than half of its light in a column.

A threshold in the middle no longer sees it, and all repetitions of a packet show the same errors.
"""

_LONGEST_UNCHECKED = 1.0  # exposure in chips up to which single chips reach the level of runs


def read_signal(signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read the payload from a signal, as :func:`read_stripes` does, as long as it shows the chips.

    Where the known exposure is so long that several chips can be misread alike in every packet, and
    the framing does not check the payload, the bits are given with a failure.
    """
    result = read_stripes(signal, scene)
    unsure = None if result.failure is not None else _why_unsure(scene)
    return result if unsure is None else replace(result, code=None, failure=unsure)


def _why_unsure(scene: Scene) -> str | None:
    """Return why a payload may have been misread unnoticed; None where it cannot."""
    scheme = scheme_of(scene.transmitter)
    if scheme.is_papers or scheme.framing.checks:
        return None
    chips = scene.camera.exposure_time * scene.transmitter.switching_frequency
    if chips <= (_LONGEST_UNCHECKED if scheme.takes_any_chips else _LONGEST_EXPOSURE):
        return None
    return (
        f"The exposure lasts {chips:.2f} chips, of which a threshold sees no single ones for "
        "certain, and this scheme finds not all that are wrong; the framing raw checks the payload."
    )


def read_stripes(signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read the payload from a signal; of the scene, scheme and number of bits are known.

    For a raw pattern, whose runs have no scale, and for other schemes than the paper's the length
    of a chip is known too. The result holds every step that was reached, without the region.
    """
    result = _read(signal, scene)
    failure = result.failure
    if failure is None:
        return result
    if not _knows_length(scene):
        failure = with_short_chips(failure, scene)
    if not scene.transmitter.pattern:
        scheme = scheme_of(scene.transmitter)
        needed = (2 if scheme.ends_by_header else 1) * scheme.length
        if len(signal) < needed * columns_of_chip(scene):
            failure += " " + short_view(len(signal), needed, scene, _LONGEST_EXPOSURE)
    return replace(result, failure=failure)


def _knows_length(scene: Scene) -> bool:
    """Return whether a chip's length is known, so that a failure names one that is too short."""
    return bool(scene.transmitter.pattern) or not scheme_of(scene.transmitter).is_papers


def _read(signal: FloatArray, scene: Scene) -> DecodeResult:
    result = DecodeResult(DECODER.name, signal=signal, failure=why_flat(signal))
    if result.failure is not None:
        return result
    threshold = otsu_threshold(signal)
    runs = runs_of((signal > threshold).astype(np.uint8))
    result = replace(result, threshold=threshold, runs=runs)
    whole = Runs(runs.values[1:-1], runs.lengths[1:-1])
    if len(whole.lengths) < _MIN_RUNS:
        return replace(
            result,
            failure=f"Too few stripes: {len(whole.lengths)} whole ones were found.",
        )
    if _knows_length(scene) and has_short_chips(scene):
        return replace(
            result,
            failure=f"A chip lasts {columns_of_chip(scene):.2g} columns: runs of columns cannot "
            "tell how many chips they hold.",
        )
    if scene.transmitter.pattern:
        return _read_pattern(result, runs, whole, scene)
    read = _read_chips(result, runs, whole, scene)
    return read_payload(read, scene)


def _read_pattern(result: DecodeResult, runs: Runs, whole: Runs, scene: Scene) -> DecodeResult:
    """Read the chips of a raw pattern, which holds no code."""
    read = _read_chips(result, runs, whole, scene)
    return replace(
        read,
        failure=f"A raw chip pattern is sent, which holds no packets; {len(read.chips)} chips "
        "were read.",
    )


def _read_chips(result: DecodeResult, runs: Runs, whole: Runs, scene: Scene) -> DecodeResult:
    """Convert runs to chips; of the first and last run only the part in the image counts."""
    histograms = (run_histogram(whole, 0), run_histogram(whole, 1))
    if _knows_length(scene):
        fit = fit_pattern(whole, columns_of_chip(scene))
    else:
        fit = fit_chips(whole, histograms)
    counts = fit.chips_in(runs)
    ends = np.cumsum(runs.lengths).astype(np.float64)
    starts = ends - runs.lengths
    within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    chip_starts = np.repeat(starts, counts) + within * np.repeat(runs.lengths / counts, counts)
    return replace(
        result,
        histograms=histograms,
        chip_length=fit.chip_length,
        chips=np.repeat(runs.values, counts),
        chip_starts=chip_starts,
    )


DECODER = Decoder(PAPER_DECODER, "The paper's: threshold and run lengths", read_signal)


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
