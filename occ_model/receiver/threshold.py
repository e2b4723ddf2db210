"""The paper's decoder: Otsu's threshold, run lengths, the length of a chip, headers, bits."""

from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.receiver.decoder import (
    Decoder,
    blame_short_chips,
    columns_of_chip,
    describe_short_view,
    has_short_chips,
    read_payload,
)
from occ_model.receiver.signal import explain_flat, otsu_split, otsu_threshold
from occ_model.results.decoding import PAPER_DECODER, DecodeResult, RunHistogram, Runs
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import scheme_of

_MIN_RUNS = 3  # minimum number of whole runs to estimate a chip's length


_LONGEST_EXPOSURE = 2.0
"""Exposure in chips above which a single chip changes a column by less than half of the swing.

A threshold in the middle then misses the chip, in the same way in all repetitions of a packet.
"""

_LONGEST_UNCHECKED_EXPOSURE = 1.0  # in chips, up to which single chips reach the level of runs


def read_signal(signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read the payload from a signal like :func:`read_stripes`, but reject uncertain payloads.

    If the exposure is so long that chips can be misread in the same way in every packet, and the
    framing does not check the payload, the bits are returned with a failure.
    """
    result = read_stripes(signal, scene)
    uncertainty = None if result.failure is not None else _explain_uncertainty(scene)
    return result if uncertainty is None else replace(result, code=None, failure=uncertainty)


def _explain_uncertainty(scene: Scene) -> str | None:
    """Return why a payload may have been misread unnoticed; None if this is impossible."""
    scheme = scheme_of(scene.transmitter)
    if scheme.is_papers or scheme.framing.checks:
        return None
    chips = scene.camera.exposure_time * scene.transmitter.switching_frequency
    if chips <= (_LONGEST_UNCHECKED_EXPOSURE if scheme.takes_any_chips else _LONGEST_EXPOSURE):
        return None
    return (
        f"The exposure lasts {chips:.2f} chips, so a threshold can miss single chips, and this "
        "scheme does not detect all wrong chips; the framing raw checks the payload."
    )


def read_stripes(signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read the payload from a signal with the scene's scheme and number of bits.

    For a raw pattern, whose runs have no scale, and for schemes other than the paper's, the length
    of a chip is known. The result contains all completed steps, without the region.
    """
    result = _read_steps(signal, scene)
    failure = result.failure
    if failure is None:
        return result
    if not _is_length_known(scene):
        failure = blame_short_chips(failure, scene)
    if not scene.transmitter.pattern:
        scheme = scheme_of(scene.transmitter)
        needed_chips = (2 if scheme.ends_by_header else 1) * scheme.length
        if len(signal) < needed_chips * columns_of_chip(scene):
            failure += " " + describe_short_view(
                len(signal), needed_chips, scene, _LONGEST_EXPOSURE
            )
    return replace(result, failure=failure)


def _is_length_known(scene: Scene) -> bool:
    """Return whether a chip's length is known, so that a failure can state that it is short."""
    return bool(scene.transmitter.pattern) or not scheme_of(scene.transmitter).is_papers


def _read_steps(signal: FloatArray, scene: Scene) -> DecodeResult:
    result = DecodeResult(DECODER.name, signal=signal, failure=explain_flat(signal))
    if result.failure is not None:
        return result
    threshold = otsu_threshold(signal)
    runs = split_into_runs((signal > threshold).astype(np.uint8))
    result = replace(result, threshold=threshold, runs=runs)
    whole_runs = Runs(runs.values[1:-1], runs.lengths[1:-1])
    if len(whole_runs.lengths) < _MIN_RUNS:
        return replace(
            result,
            failure=f"Too few stripes: only {len(whole_runs.lengths)} are completely visible.",
        )
    if _is_length_known(scene) and has_short_chips(scene):
        return replace(
            result,
            failure=f"A chip lasts {columns_of_chip(scene):.2g} columns: runs of columns do not "
            "show how many chips they contain.",
        )
    if scene.transmitter.pattern:
        return _read_pattern(result, runs, whole_runs, scene)
    return read_payload(_read_chips(result, runs, whole_runs, scene), scene)


def _read_pattern(result: DecodeResult, runs: Runs, whole_runs: Runs, scene: Scene) -> DecodeResult:
    """Read the chips of a raw pattern, which contains no code."""
    result = _read_chips(result, runs, whole_runs, scene)
    return replace(
        result,
        failure=f"A raw chip pattern is sent, which contains no packets; {len(result.chips)} chips "
        "were read.",
    )


def _read_chips(result: DecodeResult, runs: Runs, whole_runs: Runs, scene: Scene) -> DecodeResult:
    """Convert runs to chips; only the visible parts of the first and the last run count."""
    histograms = (run_histogram(whole_runs, 0), run_histogram(whole_runs, 1))
    if _is_length_known(scene):
        fit = fit_pattern(whole_runs, columns_of_chip(scene))
    else:
        fit = fit_chips(whole_runs, histograms)
    counts = fit.count_chips(runs)
    ends = np.cumsum(runs.lengths).astype(np.float64)
    starts = ends - runs.lengths
    chip_in_run = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    chip_starts = np.repeat(starts, counts) + chip_in_run * np.repeat(runs.lengths / counts, counts)
    return replace(
        result,
        histograms=histograms,
        chip_length=fit.chip_length,
        chips=np.repeat(runs.values, counts),
        chip_starts=chip_starts,
    )


DECODER = Decoder(PAPER_DECODER, "The paper's: threshold and run lengths", read_signal)


_MAX_RUN_CHIPS = np.array([2, 4])  # in a run of zeros and of ones: a header after a one has 4
_HEADER_RUNS = (3, 4)  # chips of the run of ones that contains a header: three, or one more
_NO_HEADER_PENALTY = 0.1  # in chips, for a fit without a header, since the picture may show none
_WIDENING_PENALTY = 0.05  # in chips, for each chip of widening in the fit of a pattern
_WIDENINGS = 19  # number of widenings tried for a raw pattern, which has no framing

_MAX_ROUNDS = 3  # rounds of least squares, unless the numbers of chips converge earlier


def split_into_runs(binary: ByteArray) -> Runs:
    """Split zeros and ones into runs of equal values."""
    changes = np.flatnonzero(binary[1:] != binary[:-1]) + 1
    starts = np.concatenate([[0], changes])
    lengths = np.diff(np.concatenate([starts, [len(binary)]])).astype(np.int64)
    return Runs(binary[starts], lengths)


def run_histogram(runs: Runs, value: int) -> RunHistogram:
    """Count the run lengths of zeros or of ones, and split them by Otsu's threshold."""
    counts = np.bincount(runs.lengths[runs.values == value]).astype(np.int64)
    return RunHistogram(counts, otsu_split(counts))


def mean_short_run(histogram: RunHistogram) -> float:
    """Average the short runs: those up to the histogram's split, or all if there is none."""
    counts = histogram.counts[: None if histogram.split is None else histogram.split + 1]
    return float(counts @ np.arange(len(counts)) / counts.sum())


@dataclass(frozen=True, slots=True)
class ChipFit:
    """The relation of run lengths to chips.

    A run of n ones is ``n * chip_length + widening`` columns long, and a run of n zeros ``n *
    chip_length - widening``, since a threshold off the middle moves all edges equally.
    """

    chip_length: float
    widening: float

    def count_chips(self, runs: Runs) -> IndexArray:
        sign = np.where(runs.values == 1, 1.0, -1.0)
        counts = np.rint((runs.lengths - sign * self.widening) / self.chip_length)
        return np.maximum(counts, 1.0).astype(np.int64)


def fit_chips(runs: Runs, histograms: tuple[RunHistogram, RunHistogram]) -> ChipFit:
    """Find the length of a chip from whole runs of both kinds.

    The paper splits the histograms of the run lengths of ones and of zeros by Otsu's threshold, and
    takes the average of the short runs for one chip. This misreads a code whose short runs are two
    chips long, such as 1023, and a code whose single and double runs are on the same side of the
    split. Therefore several interpretations are tried: the short runs of ones as one or two chips,
    the longest run of ones, which contains the header, as three or four chips, and the short runs
    of zeros as one or two chips (an odd number of bits that are all 1 has no single zero). Each
    trial is refined by least squares. In the best trial the runs are closest to whole chips, not
    longer than the framing allows, and include a header. A widening may exceed a chip, because a
    packet without single chips can still be read.
    """
    short_zero, short_one = (mean_short_run(histogram) for histogram in histograms)
    longest_one = float(len(histograms[1].counts) - 1)
    trials = [(short_one, chips) for chips in (1, 2)]
    trials += [(longest_one, chips) for chips in _HEADER_RUNS]
    one_length, one_chips, zero_chips = np.array(
        [
            (length, chips, short_zero_chips)
            for short_zero_chips in (1, 2)
            for length, chips in trials
        ]
    ).T
    # A threshold off the middle shortens runs of ones as much as it lengthens those of zeros.
    chip_length = (one_length + short_zero) / (one_chips + zero_chips)
    return _find_best_fit(runs, chip_length, one_length - one_chips * chip_length)


def fit_pattern(runs: Runs, nominal: float) -> ChipFit:
    """Find the length of a chip of a raw pattern, near a nominal one.

    Without packets the runs do not distinguish one chip from two, so the scale must be known.
    Several widenings are tried, of which smaller ones are more likely. If an enhancement moves the
    threshold by more than half a chip, the runs of one pattern can equal those of another.
    """
    widening = nominal * np.linspace(-0.9, 0.9, _WIDENINGS)
    # A threshold is rarely far off the middle.
    penalty = _WIDENING_PENALTY * np.abs(widening) / nominal
    chip_length = np.full(_WIDENINGS, nominal)
    return _find_best_fit(runs, chip_length, widening, penalty, nominal=nominal)


def _find_best_fit(
    runs: Runs,
    chip_length: FloatArray,
    widening: FloatArray,
    penalty: FloatArray | float = 0.0,
    nominal: float | None = None,
) -> ChipFit:
    """Improve initial guesses by least squares over the runs' whole chips, and return the best.

    All guesses are improved together, and equal runs are weighted by their number. With a
    ``nominal`` length, the deviation from it counts instead of the rules of the framing.
    """
    run_kinds, repeats = np.unique(2 * runs.lengths + runs.values, return_counts=True)
    values, lengths = run_kinds % 2, (run_kinds // 2).astype(np.float64)
    sign = np.where(values == 1, 1.0, -1.0)

    def round_to_chips() -> FloatArray:
        counts = np.rint((lengths - sign * widening[:, None]) / chip_length[:, None])
        return np.asarray(np.maximum(counts, 1.0))

    n = round_to_chips()
    for _ in range(_MAX_ROUNDS):
        # Normal equations of lengths = chip_length * n + widening * sign.
        nn, ns, ss = (n * n) @ repeats, n @ (repeats * sign), float(repeats.sum())
        nl, sl = n @ (repeats * lengths), float((sign * lengths) @ repeats)
        determinant = nn * ss - ns**2  # never 0, because ones and zeros differ in sign
        improved_length = (ss * nl - ns * sl) / determinant
        is_valid = improved_length > 0.0
        widening = np.where(is_valid, (nn * sl - ns * nl) / determinant, widening)
        chip_length = np.where(is_valid, improved_length, chip_length)
        previous, n = n, round_to_chips()
        if np.array_equal(previous, n):
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
    return ChipFit(float(chip_length[best]), float(widening[best]))
