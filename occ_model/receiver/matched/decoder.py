"""The matched decoder: correlate the signal with the forward model of every code and phase.

Beyond the paper, it knows the switching frequency, the exposure time and the readout time. The
signal is first folded over one packet. An exposure may cover several chips, because each code still
has its own profile.
"""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.exposure import column_phases
from occ_model.receiver.decoder import (
    Decoder,
    add_bits,
    blame_short_chips,
    describe_short_view,
    mention_short_chips,
)
from occ_model.receiver.matched.templates import (
    BINS_PER_CHIP,
    MOST_BITS,
    CodeTemplates,
    PayloadTemplates,
    codes_by_levels,
    find_same_chips,
    make_code_templates,
    make_payload_templates,
    sums_of_halves,
)
from occ_model.receiver.signal import explain_flat
from occ_model.results.decoding import DecodeResult
from occ_model.scene.parameters.light import MAX_BITS
from occ_model.scene.scene import Scene
from occ_model.transmitter.framings.framing import Framed
from occ_model.transmitter.scheme import bits_of, packet_length, scheme_of

_MIN_CORRELATION = 0.7  # minimum for reading a code: half of the signal's variance is explained
_MIN_CONFIDENCE = 0.05  # minimum for reading a code; below it the best code may be so by chance
_NEGLIGIBLE_UNEXPLAINED = 1e-3
"""Unexplained fraction of the variance below which a code counts as a perfect match, since bins and
ranks are no more exact. If two codes match perfectly, either may have been sent."""

_SAME_LEVEL = 1e-5  # maximum rounding error of lit fractions

_WIDEST_GAP = 1.25
"""Maximum distance in chips between starts of exposures for a signal to determine a code.

If each chip has a column of its own, no gap exceeds one chip, except for rounding to bins.
"""

_CANDIDATE_CODES = 16  # number of codes compared in the second, more exact step
_SUMS_IN_MEMORY = 2**15  # correlations computed at a time, to fit the processor's cache


def read_signal(signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read the code whose forward model is most similar to the signal.

    With r1 and r2 the correlations of the best and the second best code with the signal, the
    confidence is 1 - (1 - r1^2) / (1 - r2^2): 0 if both explain the same fraction of the variance,
    and near 1 if only the best code explains all of it.
    """
    result = DecodeResult(DECODER.name, signal=signal, failure=explain_flat(signal))
    if result.failure is not None:
        return result
    if scene.transmitter.pattern:
        return replace(result, failure="A raw chip pattern is sent, which contains no packets.")
    scheme = scheme_of(scene.transmitter)
    max_bits = MAX_BITS if scheme.is_papers else MOST_BITS
    if scheme.bits > max_bits:
        return replace(
            result,
            failure=f"The payload has {scheme.bits} bits; the matched decoder compares all "
            f"payloads, at most {max_bits} bits for this scheme: use the sequence detector.",
        )
    frequency = scene.transmitter.switching_frequency
    visible_chips = len(signal) * scene.camera.readout_time * frequency
    if visible_chips < scheme.length:
        view = describe_short_view(len(signal), scheme.length, scene)
        return replace(result, failure=f"Less than one packet: {view}")
    exposure = Fraction(scene.camera.exposure_time) * Fraction(frequency)
    templates: CodeTemplates | PayloadTemplates
    if scheme.is_papers:
        templates = make_code_templates(scheme.bits, exposure)
    else:
        templates = make_payload_templates(scheme, exposure)
    if not np.isfinite(templates.energy).any():
        return replace(
            result,
            failure="All codes look the same: the exposure lasts a whole number of packets, or so "
            "many packets that only their mean remains.",
        )
    starts = _start_bins(len(signal), scene, scheme.length)
    counts = np.bincount(starts, minlength=scheme.length * BINS_PER_CHIP)
    gap = _widest_gap(counts) / BINS_PER_CHIP
    if gap > _WIDEST_GAP:
        failure = (
            f"Not every chip is visible: exposures start up to {gap:.2g} chips apart within a "
            "packet."
        )
        return replace(result, failure=blame_short_chips(failure, scene))
    result = _find_best_code(result, _fold(signal, starts, counts), templates, scene)
    if result.failure is None:
        return result
    return replace(result, failure=mention_short_chips(result.failure, scene))


def _start_bins(columns: int, scene: Scene, period: int) -> IndexArray:
    # The signal may start at any column, because the packet's phase is unknown.
    phases = column_phases(
        scene, Fraction(scene.transmitter.switching_frequency), period, columns=columns
    )
    bins = period * BINS_PER_CHIP
    return np.rint((phases.whole + phases.fraction) * BINS_PER_CHIP).astype(np.int64) % bins


def _widest_gap(counts: IndexArray) -> int:
    """Return the largest distance between bins of a packet in which an exposure starts."""
    filled_bins = np.flatnonzero(counts)
    return int(np.diff(filled_bins, append=filled_bins[0] + len(counts)).max())


def _fold(signal: FloatArray, starts: IndexArray, counts: IndexArray) -> FloatArray:
    """Average the columns whose exposures start in the same bin of a packet, shape (bins,)."""
    sums = np.bincount(starts, signal, minlength=len(counts))
    filled_bins = np.flatnonzero(counts)
    # Bins without columns are interpolated, since a profile has no jumps.
    return np.interp(
        np.arange(len(counts)),
        filled_bins,
        sums[filled_bins] / counts[filled_bins],
        period=len(counts),
    )


def _find_best_code(
    result: DecodeResult,
    folded: FloatArray,
    templates: CodeTemplates | PayloadTemplates,
    scene: Scene,
) -> DecodeResult:
    """Compare the folded signal with every code, then more exactly with the most likely ones."""
    # The camera preserves the order of grey levels, so a bin's rank gives its lit fraction, and
    # gamma and enhancement need not be known.
    rank = folded.argsort(kind="stable").argsort()
    if isinstance(templates, CodeTemplates):
        candidates, shifts = find_most_likely(templates.levels[rank], templates)
    else:
        candidates, shifts = templates.find_most_likely(
            rank, _CANDIDATE_CODES, math.sqrt(1.0 - _NEGLIGIBLE_UNEXPLAINED)
        )
    models = templates.profiles(candidates)
    # The levels of a single code are more exact than those of all codes together.
    signals = np.sort(models, axis=1)[:, rank]
    places = (np.arange(len(folded)) - shifts[:, None]) % len(folded)
    models = np.take_along_axis(models, places, axis=1)
    # A flat profile has only rounding errors, with which any signal correlates.
    has_swing = np.isfinite(templates.energy[candidates])
    correlations = np.minimum(
        _row_correlations(signals, models), _level_correlations(folded, models)
    )
    correlations = np.where(has_swing, correlations, 0.0)
    second, best = np.argsort(correlations)[-2:].tolist()
    r1, r2 = float(correlations[best]), float(correlations[second])
    confidence = 1.0 - _unexplained_variance(r1) / _unexplained_variance(r2)
    code = int(candidates[best])
    result = replace(
        result, correlation=r1, confidence=confidence, folded=signals[best], model=models[best]
    )
    failure = None
    if isinstance(templates, PayloadTemplates):
        failure = _explain_ambiguity(code, candidates, scene)
    if failure is None and (r1 < _MIN_CORRELATION or confidence < _MIN_CONFIDENCE):
        failure = (
            f"No code stands out: the best one, {code}, has a correlation of {r1:.3f} with the "
            f"signal, and the second best, {candidates[second]}, of {r2:.3f}."
        )
    if failure is not None:
        return replace(result, failure=failure)
    bits = np.array(bits_of(code, scene.transmitter.payload_length), dtype=np.uint8)
    return add_bits(result, Framed((), bits), scene)


def _explain_ambiguity(code: int, candidates: IndexArray, scene: Scene) -> str | None:
    """Return a sentence if another code sends the same chips; None otherwise."""
    other = find_same_chips(code, candidates, scheme_of(scene.transmitter))
    if other is None:
        return None
    first, second = sorted((code, other))
    return (
        f"The codes {first} and {second} send the same endless chips: the framing does not "
        "distinguish them."
    )


def find_most_likely(signal: FloatArray, templates: CodeTemplates) -> tuple[IndexArray, IndexArray]:
    """Return the codes that correlate best with the signal, and the bins at which they start."""
    bins, period = len(signal), packet_length(templates.bits)
    centred = signal - signal.mean()
    spectrum = np.fft.rfft(centred) * np.conj(np.fft.rfft(templates.response))
    correlations = np.fft.irfft(spectrum, bins)
    places = np.arange(period)[:, None] * BINS_PER_CHIP + np.arange(bins)
    first, second = sums_of_halves(np.concatenate([correlations] * 2)[places], templates.bits)
    codes = codes_by_levels(templates.bits)
    scores = _maximum_sums(first, second).ravel() / np.sqrt(templates.energy[codes])
    count = min(_CANDIDATE_CODES, len(scores))
    candidates = np.argpartition(scores, -count)[-count:]
    first_row, second_row = np.divmod(candidates, len(second))
    return codes[candidates], (first[first_row] + second[second_row]).argmax(axis=1)


def _maximum_sums(first: FloatArray, second: FloatArray) -> FloatArray:
    """Add each row of one array to each row of the other, and return the maximum of each sum."""
    columns, shape = first.shape[1], (len(first), len(second))
    # Neighbours in memory belong to different sums, so that the processor adds several at a time.
    first, second = first.T[:, :, None].copy(), second.T[:, None].copy()
    step = max(1, _SUMS_IN_MEMORY // (shape[0] * shape[1]))
    sums = np.empty((min(step, columns), *shape))
    largest = np.full(shape, -np.inf)
    for start in range(0, columns, step):
        part = slice(start, start + step)
        sums_of_part = np.add(first[part], second[part], out=sums[: len(first[part])])
        np.maximum(
            largest,
            sums_of_part.reshape(len(sums_of_part), -1).max(axis=0).reshape(shape),
            out=largest,
        )
    return largest


def _level_correlations(folded: FloatArray, models: FloatArray) -> FloatArray:
    """Correlate the signal with its means over the bins that have the same level in each model.

    By ranks alone, a model of few levels fits any signal with the same order. But bins of the same
    lit fraction have the same grey level, whatever the tone curve.
    """
    rows, bins = models.shape
    order = models.argsort(axis=1)
    light = (folded - folded.mean())[order]
    is_level_start = np.ones((rows, bins), dtype=bool)
    is_level_start[:, 1:] = np.diff(np.take_along_axis(models, order, axis=1), axis=1) > _SAME_LEVEL
    starts = np.flatnonzero(is_level_start)
    counts = np.diff(starts, append=light.size)
    energies = np.add.reduceat(light.ravel(), starts) ** 2 / counts
    energy = float(light[0] @ light[0])
    # A signal that folds to one level correlates with nothing.
    fractions = np.bincount(starts // bins, energies, minlength=rows) / (energy or np.inf)
    return np.asarray(np.sqrt(np.clip(fractions, 0.0, 1.0)))


def _unexplained_variance(correlation: float) -> float:
    """Return the fraction of the signal's variance that a code leaves unexplained."""
    return max(1.0 - correlation**2, _NEGLIGIBLE_UNEXPLAINED)


def _row_correlations(a: FloatArray, b: FloatArray) -> FloatArray:
    a = a - a.mean(axis=1, keepdims=True)
    b = b - b.mean(axis=1, keepdims=True)
    energy = np.sqrt((a**2).sum(axis=1) * (b**2).sum(axis=1))
    product = (a * b).sum(axis=1)
    # A row without any variance correlates with nothing.
    correlations = np.zeros(len(product))
    np.divide(product, energy, out=correlations, where=energy > 0.0)
    return np.clip(correlations, -1.0, 1.0)


DECODER = Decoder("matched", "Matched: correlates with every code", read_signal)
