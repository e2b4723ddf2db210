"""The paper's decoder: threshold, run lengths, headers, bits."""

from dataclasses import replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.receiver.decoder import Decoder
from occ_model.receiver.signal import otsu_threshold, why_flat
from occ_model.receiver.threshold.framing import read_packet
from occ_model.receiver.threshold.run_lengths import fit_chips, fit_pattern, run_histogram, runs_of
from occ_model.results import DecodeResult, Runs
from occ_model.scene.scene import Scene

_SHORTEST_CHIP = 1.0
"""Columns of a chip below which runs cannot tell how many chips they hold."""

_FEWEST_RUNS = 3
"""Whole runs below which nothing can be said about a chip's length."""


def read_signal(signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read the code from a signal, knowing nothing of the scene but the number of bits.

    Only for a raw pattern, whose runs tell no scale, the length of a chip is taken as known.

    Parameters
    ----------
    signal : ndarray of float64, shape (columns,)
        Mean grey level of each column.
    scene
        Its transmitter says how many bits a code has, or that no packets are sent.

    Returns
    -------
    DecodeResult
        With every step as far as it came; the region is the caller's to add.
    """
    result = DecodeResult(DECODER.name, signal=signal, failure=why_flat(signal))
    if result.failure is not None:
        return result
    threshold = otsu_threshold(signal)
    runs = runs_of((signal > threshold).astype(np.uint8))
    result = replace(result, threshold=threshold, runs=runs)
    whole = Runs(runs.values[1:-1], runs.lengths[1:-1])
    if len(whole.lengths) < _FEWEST_RUNS:
        return replace(
            result,
            failure=f"Too few stripes: {len(whole.lengths)} whole ones fit the panel's image; "
            "come closer or raise the frequency.",
        )
    nominal = scene.transmitter.switching_period / scene.camera.readout_time
    if scene.transmitter.pattern and nominal < _SHORTEST_CHIP:
        return replace(
            result,
            failure=f"A chip lasts {nominal:.2g} columns: runs of columns cannot tell how many "
            "chips they hold.",
        )
    read = _read_chips(result, runs, whole, scene)
    if scene.transmitter.pattern:
        return replace(
            read,
            failure=f"A raw chip pattern is sent, which holds no packets; {len(read.chips)} chips "
            "were read.",
        )
    framed = read_packet(read.chips, scene.transmitter.bits)
    return replace(
        read,
        headers=framed.headers,
        bits=framed.bits,
        code=framed.code,
        failure=framed.failure,
    )


def _read_chips(result: DecodeResult, runs: Runs, whole: Runs, scene: Scene) -> DecodeResult:
    """Turn runs into chips; the first and last run count as far as the image shows them."""
    histograms = (run_histogram(whole, 0), run_histogram(whole, 1))
    if scene.transmitter.pattern:
        fit = fit_pattern(whole, scene.transmitter.switching_period / scene.camera.readout_time)
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
