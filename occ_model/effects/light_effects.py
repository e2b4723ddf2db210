"""Effects on the light: the LED's rise and fall, and flicker of the surroundings' lamps."""

import math
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import column_phases, cycle_phases
from occ_model.camera.photometry import ColumnLight
from occ_model.effects.effect import Cost, LightEffect
from occ_model.scene.scene import Scene
from occ_model.transmitter.packet import sent_chips
from occ_model.transmitter.waveform import EdgedWaveform


class LedEdges(LightEffect):
    """The light is the running mean of the chips over the edge time tau.

    Each change becomes a ramp of length tau: the light is the chips' integral over the last tau,
    divided by tau. Its own integral has a closed form for any tau; see :class:`.EdgedWaveform`.
    Rise and fall take equally long, so that the mean light does not change. If tau is longer than a
    chip, single chips no longer reach full light.
    """

    name = "led-edges"
    label = "LED rise and fall"
    parameters = ("edge_time",)
    cost = Cost(picture=0.3e-3)

    def is_present(self, scene: Scene) -> bool:
        return scene.transmitter.edge_time != 0.0

    def apply(self, scene: Scene, light: ColumnLight) -> ColumnLight:
        if not self.is_present(scene):
            return light
        return replace(light, lit=lit_fraction_with_edges(scene))


@lru_cache(maxsize=4)
def lit_fraction_with_edges(scene: Scene) -> FloatArray:
    """Return the mean light in each column's exposure, 1 being the panel fully lit."""
    frequency = Fraction(scene.transmitter.switching_frequency)
    exposure = Fraction(scene.camera.exposure_time) * frequency
    edge = Fraction(scene.transmitter.edge_time) * frequency
    waveform = _waveform(sent_chips(scene.transmitter).tobytes(), edge)
    lit = waveform.lit_chips(lambda shift: column_phases(scene, waveform.period, shift), exposure)
    found = np.clip(lit / float(exposure), 0.0, 1.0)
    found.flags.writeable = False
    return found


@lru_cache(maxsize=4)
def _waveform(chips: bytes, edge: Fraction) -> EdgedWaveform:
    return EdgedWaveform(np.frombuffer(chips, dtype=np.uint8), edge)


class Flicker(LightEffect):
    """The external illuminance is E_v (1 + m cos(2 pi F x + phi)) at the time x.

    Its mean over an exposure [x, x + t] is E_v (1 + m sinc(F t) cos(2 pi F (x + t/2) + phi)) with
    sinc(y) = sin(pi y) / (pi y), the frequency response of an exposure as a moving average.
    """

    name = "flicker"
    label = "Mains flicker"
    parameters = ("flicker_depth", "flicker_frequency", "flicker_phase")
    cost = Cost(picture=0.12e-3)

    def is_present(self, scene: Scene) -> bool:
        return depth_in_exposure(scene) != 0.0

    def apply(self, scene: Scene, light: ColumnLight) -> ColumnLight:
        return replace(light, ambient=light.ambient * ambient_fractions(scene))


def depth_in_exposure(scene: Scene) -> float:
    """Return the depth of the flicker that is left after averaging over an exposure."""
    depth = scene.surroundings.flicker_depth
    return depth * abs(exposure_response(scene)) if depth else 0.0


@lru_cache(maxsize=4)
def ambient_fractions(scene: Scene) -> FloatArray:
    """Return the mean external illuminance in each column's exposure, as a multiple of E_v."""
    surroundings, exposure = scene.surroundings, Fraction(scene.camera.exposure_time)
    cycles = cycle_phases(scene, surroundings.flicker_frequency, exposure / 2)
    swing = np.cos(2.0 * math.pi * cycles + surroundings.flicker_phase)
    found = np.asarray(1.0 + surroundings.flicker_depth * exposure_response(scene) * swing)
    found.flags.writeable = False
    return found


def exposure_response(scene: Scene) -> float:
    """Return sinc(F t), the fraction of the flicker's depth that is left after an exposure.

    Whole cycles are subtracted before the sine, so that a whole number of them gives exactly 0.
    """
    cycles = Fraction(scene.surroundings.flicker_frequency) * Fraction(scene.camera.exposure_time)
    whole = round(cycles)
    sine = math.sin(math.pi * float(cycles - whole))
    return (-sine if whole % 2 else sine) / (math.pi * float(cycles))
