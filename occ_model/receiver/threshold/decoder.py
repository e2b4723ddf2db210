"""The paper's decoder: threshold, run lengths, headers, bits."""

from dataclasses import replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.receiver.decoder import Decoder
from occ_model.receiver.read_payload import read_payload
from occ_model.receiver.short_chips import columns_of_chip, has_short_chips, with_short_chips
from occ_model.receiver.signal import otsu_threshold, why_flat
from occ_model.receiver.threshold.run_lengths import fit_chips, fit_pattern, run_histogram, runs_of
from occ_model.results.decoding import DecodeResult, Runs
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
    """Say why a payload may have been misread unnoticed; None where it may not."""
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
    if result.failure is None or _knows_length(scene):
        return result
    return replace(result, failure=with_short_chips(result.failure, scene))


def _knows_length(scene: Scene) -> bool:
    """Return whether the decoder may know a chip's length, and names it where it is too short."""
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
            failure=f"Too few stripes: {len(whole.lengths)} whole ones fit the panel's image; "
            "come closer or raise the frequency.",
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


DECODER = Decoder("threshold", "The paper's: threshold and run lengths", read_signal)
