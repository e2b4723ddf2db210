"""The light that a transmitter sends, of any kind, as a waveform or a cosine."""

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise

import numpy as np

from occ_model.light.cosine import Cosine
from occ_model.light.waveform import Waveform
from occ_model.scene.light_samples import levels_of, samples_of
from occ_model.scene.light_words import MAINS_HARMONIC
from occ_model.scene.scene import Scene, Transmitter
from occ_model.transmitter.scheme import sent_chips


@dataclass(frozen=True, eq=False, slots=True)
class PiecewiseLight:
    """Light that repeats, constant on each piece."""

    waveform: Waveform
    rate: Fraction  # Units of the waveform per second, exact

    @property
    def period(self) -> Fraction:
        """Seconds after which the waveform is sent again."""
        return self.waveform.period / self.rate

    @property
    def mean(self) -> float:
        """Mean light, 1 being the panel fully lit."""
        return float(self.waveform.mean)


Light = PiecewiseLight | Cosine


def light_of(transmitter: Transmitter) -> Light:
    """Return the light that a transmitter sends; equal transmitters send the same object."""
    sent = transmitter
    match sent.light:
        case "lamp":
            return _blinking_light(sent.lamp_frequency, Fraction(sent.duty), sent.depth)
        case "pulses":
            lit = Fraction(sent.pulse_length) * Fraction(sent.pulse_frequency)
            return _blinking_light(sent.pulse_frequency, min(lit, Fraction(1)), 1.0)
        case "mains":
            return _mains_light(sent.mains_frequency, sent.mains_depth)
        case "waveform":
            if sent.waveform_file:
                return _recorded_light(sent.waveform_file)
            return _light_of_levels(sent.levels, sent.switching_frequency)
    return _light_of_chips(sent_chips(sent).tobytes(), sent.switching_frequency)


def light_period(transmitter: Transmitter) -> Fraction:
    """Return the seconds after which a transmitter's light repeats, exact."""
    return light_of(transmitter).period


def period_columns(scene: Scene) -> float:
    """Return the columns that are read out while a scene's light repeats once."""
    return float(light_period(scene.transmitter) / Fraction(scene.camera.readout_time))


def flicker_of(scene: Scene) -> Cosine:
    """Return the surroundings' light as a multiple of its mean; a mains lamp lights them, too."""
    light = light_of(scene.transmitter)
    if isinstance(light, Cosine):
        return light
    surroundings = scene.surroundings
    return Cosine(
        surroundings.flicker_frequency, surroundings.flicker_depth, surroundings.flicker_phase
    )


@lru_cache(maxsize=256)
def _light_of_chips(chips: bytes, frequency: float) -> PiecewiseLight:
    return PiecewiseLight(_waveform_of_chips(chips), Fraction(frequency))


@lru_cache(maxsize=16)
def _waveform_of_chips(chips: bytes) -> Waveform:
    return Waveform(np.frombuffer(chips, dtype=np.uint8))


@lru_cache(maxsize=64)
def _blinking_light(frequency: float, duty: Fraction, depth: float) -> PiecewiseLight:
    """Return light that is full for the first fraction ``duty`` of each cycle."""
    pieces = [(1.0, duty), (1.0 - depth, 1 - duty)]
    levels, lengths = zip(*((level, length) for level, length in pieces if length), strict=True)
    exact = [int(level) if level in (0.0, 1.0) else level for level in levels]
    waveform = Waveform(exact, lengths)
    return PiecewiseLight(waveform, waveform.period * Fraction(frequency))


@lru_cache(maxsize=8)
def _light_of_levels(line: str, frequency: float) -> PiecewiseLight:
    return PiecewiseLight(Waveform(levels_of(line)), Fraction(frequency))


@lru_cache(maxsize=4)
def _recorded_light(samples: str) -> PiecewiseLight:
    seconds, levels = samples_of(samples)
    lengths = [Fraction(last) - Fraction(first) for first, last in pairwise(seconds)]
    return PiecewiseLight(Waveform(levels, lengths), len(levels) / sum(lengths, Fraction(0)))


@lru_cache(maxsize=8)
def _mains_light(frequency: float, depth: float) -> Cosine:
    return Cosine(MAINS_HARMONIC * frequency, depth)
