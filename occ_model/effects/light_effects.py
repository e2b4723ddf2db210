"""Effects on the light: the LED's rise and fall, and flicker of the surroundings' lamps."""

from dataclasses import replace
from fractions import Fraction
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import column_phases
from occ_model.camera.photometry import ColumnLight
from occ_model.effects.effect import Cost, LightEffect
from occ_model.light.cosine import Cosine
from occ_model.light.edged import EdgedWaveform
from occ_model.light.sent import PiecewiseLight, flicker_of, light_of
from occ_model.scene.scene import Scene


class LedEdges(LightEffect):
    """The light is the running mean of the sharp light over the edge time tau.

    Each change becomes a ramp of length tau: the light is the integral of the sharp one over the
    last tau, divided by tau. Its own integral has a closed form for any tau; see
    :class:`.EdgedWaveform`. Rise and fall take equally long, so that the mean light does not
    change. If tau is longer than a chip, single chips no longer reach full light.
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
    light, edge = light_of(scene.transmitter), Fraction(scene.transmitter.edge_time)
    if isinstance(light, Cosine):
        lit = _means(scene, light, edge)
    else:
        exposure = Fraction(scene.camera.exposure_time) * light.rate
        waveform = _edged(light, edge * light.rate)
        rate, period = light.rate, waveform.period
        lit = waveform.light_in(lambda shift: column_phases(scene, rate, period, shift), exposure)
        lit = np.clip(lit / float(exposure), 0.0, 1.0)
    lit.flags.writeable = False
    return lit


@lru_cache(maxsize=4)
def _edged(light: PiecewiseLight, edge: Fraction) -> EdgedWaveform:
    return EdgedWaveform(light.waveform, edge)


def _means(scene: Scene, light: Cosine, edge: Fraction = Fraction(0)) -> FloatArray:
    camera = scene.camera
    return light.means(
        Fraction(scene.model.start_time), Fraction(camera.readout_time), camera.columns,
        Fraction(camera.exposure_time), edge,
    )  # fmt: skip


class Flicker(LightEffect):
    """The external illuminance is E_v (1 + m cos(2 pi F x + phi)) at the time x.

    A lamp on the mains lights the surroundings with its own cosine; see :class:`.Cosine`.
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
    """Return the depth of the flicker after averaging over an exposure."""
    return flicker_of(scene).depth_in(Fraction(scene.camera.exposure_time))


@lru_cache(maxsize=4)
def ambient_fractions(scene: Scene) -> FloatArray:
    """Return the mean external illuminance in each column's exposure, as a multiple of E_v."""
    fractions = _means(scene, flicker_of(scene))
    fractions.flags.writeable = False
    return fractions
