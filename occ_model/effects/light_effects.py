"""Effects on the light: the LED's rise and fall, and flicker of the surroundings' lamps."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache, partial

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import column_phases, phases_of_images
from occ_model.camera.photometry import ColumnLight
from occ_model.effects.effect import Cost, LightEffect
from occ_model.light.cosine import Cosine
from occ_model.light.edged import EdgedWaveform, PhasesAt
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

    def sets_panel_light(self, scene: Scene) -> bool:
        return self.is_present(scene)

    def apply_to_images(
        self,
        scene: Scene,
        light: ColumnLight,
        start_times: Sequence[float],
        phases: Sequence[float],  # noqa: ARG002 - of the mains
    ) -> ColumnLight:
        if not self.is_present(scene):
            return light
        sent, edge = light_of(scene.transmitter), Fraction(scene.transmitter.edge_time)
        if isinstance(sent, Cosine):
            lit = np.array([_means(scene, sent, edge, time) for time in start_times])
        else:
            lit = _lit_from(scene, sent, partial(phases_of_images, scene, start_times, sent))
        return replace(light, lit=lit)


@lru_cache(maxsize=4)
def lit_fraction_with_edges(scene: Scene) -> FloatArray:
    """Return the mean light in each column's exposure, 1 being the panel fully lit."""
    light, edge = light_of(scene.transmitter), Fraction(scene.transmitter.edge_time)
    if isinstance(light, Cosine):
        lit = _means(scene, light, edge, scene.model.start_time)
    else:
        starts = partial(column_phases, scene, light.rate, light.waveform.period)
        lit = _lit_from(scene, light, starts)
    lit.flags.writeable = False
    return lit


def _lit_from(scene: Scene, light: PiecewiseLight, starts: PhasesAt) -> FloatArray:
    exposure = Fraction(scene.camera.exposure_time) * light.rate
    waveform = _waveform_with_edges(light, Fraction(scene.transmitter.edge_time) * light.rate)
    return np.clip(waveform.light_in(starts, exposure) / float(exposure), 0.0, 1.0)


@lru_cache(maxsize=4)
def _waveform_with_edges(light: PiecewiseLight, edge: Fraction) -> EdgedWaveform:
    return EdgedWaveform(light.waveform, edge)


def _means(scene: Scene, light: Cosine, edge: Fraction, start_time: float) -> FloatArray:
    camera = scene.camera
    return light.means(
        Fraction(start_time), Fraction(camera.readout_time), camera.columns,
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

    def apply_to_images(
        self,
        scene: Scene,
        light: ColumnLight,
        start_times: Sequence[float],
        phases: Sequence[float],
    ) -> ColumnLight:
        flicker, is_mains = flicker_of(scene), isinstance(light_of(scene.transmitter), Cosine)
        fractions = [
            _means(scene, flicker if is_mains else replace(flicker, phase=phase), Fraction(0), time)
            for time, phase in zip(start_times, phases, strict=True)
        ]
        return replace(light, ambient=light.ambient * np.array(fractions))


def depth_in_exposure(scene: Scene) -> float:
    """Return the depth of the flicker after averaging over an exposure."""
    return flicker_of(scene).depth_in(Fraction(scene.camera.exposure_time))


@lru_cache(maxsize=4)
def ambient_fractions(scene: Scene) -> FloatArray:
    """Return the mean external illuminance in each column's exposure, as a multiple of E_v."""
    fractions = _means(scene, flicker_of(scene), Fraction(0), scene.model.start_time)
    fractions.flags.writeable = False
    return fractions
