"""Effects on the light: LED rise and fall, and mains flicker of the surroundings."""

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
    """The light follows the chips as their running mean over the edge time tau.

    A change of chip becomes a ramp of length tau: (1/tau) of the chips' integral over the last tau.
    The running integral of that has a closed form in turn, for any tau: see
    :class:`.EdgedWaveform`. As the rise and the fall take equally long, the mean light stays what
    it was; where tau is longer than a chip, single chips no longer reach full light.
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
        return replace(light, lit=edged_lit_fraction(scene))


@lru_cache(maxsize=4)
def edged_lit_fraction(scene: Scene) -> FloatArray:
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
    sinc(y) = sin(pi y) / (pi y): the exposure is a moving average, and that is its frequency
    response.
    """

    name = "flicker"
    label = "Mains flicker"
    parameters = ("flicker_depth", "flicker_frequency", "flicker_phase")
    cost = Cost(picture=0.12e-3)

    def is_present(self, scene: Scene) -> bool:
        return seen_depth(scene) != 0.0

    def apply(self, scene: Scene, light: ColumnLight) -> ColumnLight:
        return replace(light, ambient=light.ambient * ambient_fractions(scene))


def seen_depth(scene: Scene) -> float:
    """Return the flicker's depth in the mean light of an exposure."""
    depth = scene.surroundings.flicker_depth
    return depth * abs(response(scene)) if depth else 0.0


@lru_cache(maxsize=4)
def ambient_fractions(scene: Scene) -> FloatArray:
    """Return the mean external illuminance in each column's exposure, as a multiple of E_v."""
    surroundings, exposure = scene.surroundings, Fraction(scene.camera.exposure_time)
    cycles = cycle_phases(scene, surroundings.flicker_frequency, exposure / 2)
    swing = np.cos(2.0 * math.pi * cycles + surroundings.flicker_phase)
    found = np.asarray(1.0 + surroundings.flicker_depth * response(scene) * swing)
    found.flags.writeable = False
    return found


def response(scene: Scene) -> float:
    """Return sinc(F t), the fraction of the flicker that an exposure leaves.

    Whole cycles are subtracted before the sine, so that it is exactly 0 for a whole number of them.
    """
    cycles = Fraction(scene.surroundings.flicker_frequency) * Fraction(scene.camera.exposure_time)
    whole = round(cycles)
    sine = math.sin(math.pi * float(cycles - whole))
    return (-sine if whole % 2 else sine) / (math.pi * float(cycles))
