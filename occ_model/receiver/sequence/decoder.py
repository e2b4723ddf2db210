"""The sequence detector: find the chip sequence whose exposures are most similar to the signal.

Beyond the paper, it knows the switching frequency, the exposure time, the readout time and the line
code. It needs no list of codes and accepts any data. An exposure of several chips is a moving
average of them, which the Viterbi algorithm undoes.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.products import dot
from occ_model.receiver.decoder import (
    add_bits,
    blame_short_chips,
    describe_short_view,
    has_short_chips,
)
from occ_model.receiver.light import (
    PER_CHIP,
    Light,
    convert_to_light,
    expected_light,
)
from occ_model.receiver.sequence.code_words import find_code_words
from occ_model.receiver.sequence.exposures import RowTiming
from occ_model.receiver.sequence.fit import (
    SequenceFit,
    detect,
    find_phase,
    follow_timing,
    guess_brightness,
    improve,
)
from occ_model.receiver.sequence.requests import Reading, run_readings
from occ_model.receiver.sequence.soft_frame import probability, read_frame
from occ_model.receiver.sequence.trellis import Word
from occ_model.receiver.signal import MAX_UNEXPLAINED, explain_flat
from occ_model.results.decoding import DecodeResult
from occ_model.scene.scene import Scene
from occ_model.scene.units import PERCENT
from occ_model.transmitter.scheme import scheme_of

_MAX_ROUNDS = 4  # maximum number of rounds of fit and detection

_MAX_NOISE_RATIO = 0.9
"""Ratio of the noise variances after and before a round, above which no further round follows."""

_MIN_CERTAINTY = 0.9  # minimum probability that all bits are correct, to read a code

_MAX_MEMORY = 32  # maximum chips in an exposure, since a mean of more has hardly any swing
_DOUBTFUL_FRACTION = 0.02
"""Unexplained fraction of the signal's variance above which the chips' timing may be wrong."""

_MAX_UNEXPLAINED_OF_ANY_CHIPS = 0.005
"""``MAX_UNEXPLAINED`` of a scheme that accepts any chips: random data's light may not fit them."""


def read_signal(signal: FloatArray, scene: Scene) -> DecodeResult:
    """Read the code from the chips whose exposures are most similar to the signal.

    The result contains the chips, the light of each column and of the chips' model, and the
    probability that each bit is correct.
    """
    return read_signals([signal], [scene])[0]


def read_signals(signals: Sequence[FloatArray], scenes: Sequence[Scene]) -> list[DecodeResult]:
    """Read several signals, each with its own scene, and search for their chips together."""
    return run_readings([_read(*both) for both in zip(signals, scenes, strict=True)])


def _read(signal: FloatArray, scene: Scene) -> Reading[DecodeResult]:
    result = DecodeResult("sequence", signal=signal, failure=explain_flat(signal))
    if result.failure is not None:
        return result
    transmitter, camera = scene.transmitter, scene.camera
    frequency = transmitter.switching_frequency
    timing = RowTiming(camera.exposure_time * frequency, camera.readout_time * frequency)
    refusal = _explain_refusal(timing, len(signal), scene)
    if refusal is not None:
        return replace(result, failure=refusal)
    code = find_code_words(transmitter, timing.memory)
    fit, light = yield from _fit(signal, scene, timing, code.words)
    ratios = fit.ratios()
    result = _add_steps(result, fit, light, ratios)
    if transmitter.pattern:
        return replace(
            result,
            failure="A raw chip pattern is sent, which contains no packets; "
            f"{len(fit.chips.values)} chips were read.",
        )
    return _read_payload(result, fit, ratios, scene, code.header)


def _explain_refusal(timing: RowTiming, rows: int, scene: Scene) -> str | None:
    """Return why chips cannot be resolved with a timing, or that too few are visible."""
    if has_short_chips(scene):
        return blame_short_chips("The sequence detector needs one for each chip.", scene)
    if timing.memory > _MAX_MEMORY:
        return (
            f"An exposure covers {timing.exposure:.3g} chips; the sequence detector can undo up to "
            f"{_MAX_MEMORY}."
        )
    if scene.transmitter.pattern or not scheme_of(scene.transmitter).is_papers:
        return None
    length = scheme_of(scene.transmitter).length
    if rows * timing.step < length:
        return f"Less than one packet: {describe_short_view(rows, length, scene)}"
    return None


def _fit(
    signal: FloatArray, scene: Scene, timing: RowTiming, words: tuple[Word, ...]
) -> Reading[tuple[SequenceFit, Light]]:
    """Detect the chips; if they explain too little, refine their timing and detect them again."""
    light = convert_to_light(signal, scene)
    brightness = guess_brightness(light.values, expected_light(scene), timing, PER_CHIP)
    nominal_timing = yield from find_phase(light.values, timing, brightness, words)
    fit = yield from detect(light.values, nominal_timing, brightness, words)
    fit_and_light = yield from _improve_rounds(signal, scene, fit, light, words)
    if fit_and_light[0].unexplained() <= _DOUBTFUL_FRACTION:
        return fit_and_light
    refined_timing = yield from follow_timing(light.values, nominal_timing, brightness, words)
    fit = yield from detect(light.values, refined_timing, brightness, words)
    refined = yield from _improve_rounds(signal, scene, fit, light, words)
    return refined if refined[0].unexplained() < fit_and_light[0].unexplained() else fit_and_light


def _improve_rounds(
    signal: FloatArray, scene: Scene, fit: SequenceFit, light: Light, words: tuple[Word, ...]
) -> Reading[tuple[SequenceFit, Light]]:
    """Improve timing, brightness and light by the detected chips, and detect them again."""
    for _ in range(_MAX_ROUNDS):
        if light.ranks is not None:
            # The light of the detected chips is distributed more like the picture's.
            light = replace(light, values=light.ranks.to_light(np.sort(fit.model)))
        elif light.clipped.any():
            # A white column may have had more light, as far as the detected chips show.
            least_light = fit.brightness.dark + fit.brightness.swing * fit.model
            unclipped = np.where(
                light.clipped,
                np.maximum(convert_to_light(signal, scene).values, least_light),
                light.values,
            )
            light = replace(light, values=unclipped)
        previous = fit
        fit = yield from detect(light.values, *improve(light.values, fit), words)
        is_unchanged = np.array_equal(fit.chips.values, previous.chips.values)
        is_settled = is_unchanged or fit.noise > _MAX_NOISE_RATIO * previous.noise
        if is_settled and fit.unexplained() <= MAX_UNEXPLAINED:
            break
    return fit, light


def _add_steps(
    result: DecodeResult, fit: SequenceFit, light: Light, ratios: FloatArray
) -> DecodeResult:
    lit_fraction = fit.brightness.lit_fraction(light.values)
    count = len(lit_fraction)
    positions = fit.chips.first + np.arange(len(fit.chips.values)) - fit.timing.phase
    starts = np.asarray(positions / fit.timing.step, dtype=np.float64)
    centred, model = lit_fraction - lit_fraction.mean(), fit.model - fit.model.mean()
    energy = math.sqrt(dot(centred, centred) * dot(model, model))
    is_visible = (starts > -1.0 / fit.timing.step) & (starts < count)
    return replace(
        result,
        chip_length=1.0 / fit.timing.step,
        chips=fit.chips.values[is_visible],
        chip_starts=starts[is_visible],
        chip_likelihoods=probability(ratios)[is_visible],
        correlation=dot(centred, model) / energy if energy > 0.0 else 0.0,
        light=lit_fraction,
        light_model=fit.model,
    )


def _read_payload(
    result: DecodeResult,
    fit: SequenceFit,
    ratios: FloatArray,
    scene: Scene,
    header: tuple[int, ...],
) -> DecodeResult:
    """Read the payload if it is certain enough."""
    signed_ratios = np.where(fit.chips.values == 1, ratios, -ratios)
    scheme = scheme_of(scene.transmitter)
    frame = read_frame(signed_ratios, scheme, header)
    result = add_bits(result, replace(frame.framed, headers=()), scene)
    result = replace(result, bit_likelihoods=frame.likelihoods, confidence=frame.certainty)
    failure = result.failure
    unexplained = fit.unexplained()
    if unexplained > (_MAX_UNEXPLAINED_OF_ANY_CHIPS if scheme.takes_any_chips else MAX_UNEXPLAINED):
        failure = (
            "The chips found do not explain the signal: "
            f"{PERCENT.format(unexplained, 2)} of its variance is due neither to them nor to "
            "noise. Check that exposure time, switching frequency, readout time and scheme are "
            "those of the picture, and that it is not overexposed."
        )
    elif failure is None and frame.certainty < _MIN_CERTAINTY and not scheme.framing.checks:
        failure = (
            "The chips are not certain enough: all "
            f"{scheme.bits} bits are correct with a probability of only {frame.certainty:.2g}."
        )
    if failure is None:
        return result
    return replace(result, code=None, payload="", failure=failure)
