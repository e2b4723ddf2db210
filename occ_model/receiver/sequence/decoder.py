"""The sequence detector: the chip sequence whose exposures are most like the signal.

Beyond the paper, it knows the switching frequency, the exposure time and the readout time, and the
line code. It needs no list of codes: the data may be any. An exposure of several chips is a moving
average of them, which the Viterbi algorithm undoes.
"""

import math
from dataclasses import replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.receiver.decoder import has_short_chips, short_view, with_bits, with_short_chips
from occ_model.receiver.light import PER_CHIP, Light, by_rank, expected_light, in_light
from occ_model.receiver.sequence.code_words import code_words
from occ_model.receiver.sequence.exposures import Timing
from occ_model.receiver.sequence.fit import (
    Fit,
    detect,
    find_phase,
    first_guess,
    follow_timing,
    improve,
)
from occ_model.receiver.sequence.soft_frame import probability, read_frame
from occ_model.receiver.sequence.trellis import Word
from occ_model.receiver.signal import MAX_UNEXPLAINED, why_flat
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.scene.units import PERCENT
from occ_model.transmitter.scheme import scheme_of

_IMPROVEMENTS = 4  # maximum iterations of fit and detection

_MAX_NOISE_RATIO = 0.9
"""Fraction of the noise's variance before an improvement above which no other one is tried."""

_MIN_CERTAINTY = 0.9  # least probability that all bits are right, of a code that is read

_MAX_MEMORY = 32  # chips that an exposure reaches back to; a longer mean leaves hardly anything
_DOUBTFUL_FRACTION = 0.02
"""Fraction of the signal's variance that is neither the chips' light nor noise, above which their
timing may be another one."""

_MAX_UNEXPLAINED_OF_ANY_CHIPS = 0.005
"""``MAX_UNEXPLAINED`` where no rule refuses chips, whose light need not be that of random data."""


def read_signal(signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read the code from the chips whose exposures are most like the signal.

    The result holds the chips, the light of each column beside that of the chips' model, and the
    probability that each bit is right.
    """
    result = DecodeResult("sequence", signal=signal, failure=why_flat(signal))
    if result.failure is not None:
        return result
    transmitter, camera = scene.transmitter, scene.camera
    frequency = transmitter.switching_frequency
    timing = Timing(camera.exposure_time * frequency, camera.readout_time * frequency)
    refusal = _why_not(timing, len(signal), scene)
    if refusal is not None:
        return replace(result, failure=refusal)
    code = code_words(transmitter, timing.memory)
    fit, light = _fit(signal, scene, timing, code.words)
    result = _with_steps(result, fit, light)
    if transmitter.pattern:
        return replace(
            result,
            failure="A raw chip pattern is sent, which holds no packets; "
            f"{len(fit.chips.values)} chips were read.",
        )
    return _framed(result, fit, scene, code.header)


def _why_not(timing: Timing, rows: int, scene: Scene) -> str | None:
    """Return why chips cannot be resolved at a timing, or that too few are seen."""
    if has_short_chips(scene):
        return with_short_chips("The sequence detector needs one for each.", scene)
    if timing.memory > _MAX_MEMORY:
        return (
            f"An exposure covers {timing.exposure:.3g} chips; the sequence detector undoes up to "
            f"{_MAX_MEMORY}."
        )
    if scene.transmitter.pattern or not scheme_of(scene.transmitter).is_papers:
        return None
    length = scheme_of(scene.transmitter).length
    if rows * timing.step < length:
        return f"Less than one packet: {short_view(rows, length, scene)}"
    return None


def _fit(
    signal: FloatArray, scene: Scene, timing: Timing, words: tuple[Word, ...]
) -> tuple[Fit, Light]:
    """Detect the chips; where they explain too little, follow their timing and detect them anew."""
    light = in_light(signal, scene)
    brightness = first_guess(light.values, expected_light(scene), timing, PER_CHIP)
    known = find_phase(light.values, timing, brightness, words)
    found = _improved(signal, scene, detect(light.values, known, brightness, words), light, words)
    if found[0].unexplained() <= _DOUBTFUL_FRACTION:
        return found
    followed = follow_timing(light.values, known, brightness, words)
    fit = detect(light.values, followed, brightness, words)
    other = _improved(signal, scene, fit, light, words)
    return other if other[0].unexplained() < found[0].unexplained() else found


def _improved(
    signal: FloatArray, scene: Scene, fit: Fit, light: Light, words: tuple[Word, ...]
) -> tuple[Fit, Light]:
    """Improve what the chips were detected with, and detect them anew."""
    for _ in range(_IMPROVEMENTS):
        if light.is_estimated:
            # The chips found have a distribution of light of their own, nearer to the picture's.
            light = replace(light, values=by_rank(signal, fit.model))
        elif light.clipped.any():
            # A white column had that light or more, as the chips found say.
            least = fit.brightness.dark + fit.brightness.swing * fit.model
            more = np.where(
                light.clipped, np.maximum(in_light(signal, scene).values, least), light.values
            )
            light = replace(light, values=more)
        before, fit = fit, detect(light.values, *improve(light.values, fit), words)
        same = np.array_equal(fit.chips.values, before.chips.values)
        settled = (same and not light.is_estimated) or fit.noise > _MAX_NOISE_RATIO * before.noise
        if settled and fit.unexplained() <= MAX_UNEXPLAINED:
            break
    return fit, light


def _with_steps(result: DecodeResult, fit: Fit, light: Light) -> DecodeResult:
    fraction = fit.brightness.lit_fraction(light.values)
    count = len(fraction)
    places = fit.chips.first + np.arange(len(fit.chips.values)) - fit.timing.phase
    starts = np.asarray(places / fit.timing.step, dtype=np.float64)
    about, model = fraction - fraction.mean(), fit.model - fit.model.mean()
    energy = math.sqrt(float(about @ about) * float(model @ model))
    seen = (starts > -1.0 / fit.timing.step) & (starts < count)
    return replace(
        result,
        chip_length=1.0 / fit.timing.step,
        chips=fit.chips.values[seen],
        chip_starts=starts[seen],
        chip_likelihoods=probability(fit.ratios())[seen],
        correlation=float(about @ model) / energy if energy > 0.0 else 0.0,
        light=fraction,
        light_model=fit.model,
    )


def _framed(result: DecodeResult, fit: Fit, scene: Scene, header: tuple[int, ...]) -> DecodeResult:
    """Read the payload, if it is certain enough."""
    ratios = np.where(fit.chips.values == 1, 1.0, -1.0) * fit.ratios()
    scheme = scheme_of(scene.transmitter)
    frame = read_frame(ratios, scheme, header)
    read = with_bits(result, replace(frame.framed, headers=()), scene)
    read = replace(read, bit_likelihoods=frame.likelihoods, confidence=frame.certainty)
    failure = read.failure
    unexplained = fit.unexplained()
    if unexplained > (_MAX_UNEXPLAINED_OF_ANY_CHIPS if scheme.takes_any_chips else MAX_UNEXPLAINED):
        failure = (
            "The chips found do not explain the signal: "
            f"{PERCENT.format(unexplained, 2)} of its variance is neither theirs nor noise. Check "
            "that exposure time, switching frequency, readout time and scheme are the picture's, "
            "and that it is not overexposed."
        )
    elif failure is None and frame.certainty < _MIN_CERTAINTY and not scheme.framing.checks:
        failure = (
            "The chips are not certain enough: that all "
            f"{scheme.bits} bits are right has a probability of {frame.certainty:.2g}."
        )
    if failure is None:
        return read
    return replace(read, code=None, payload="", failure=failure)
