"""LED rise and fall: the light follows the chips with ramps in place of steps."""

from dataclasses import replace
from fractions import Fraction
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import column_phases
from occ_model.camera.photometry import ColumnLight
from occ_model.effects.effect import Cost, LightEffect
from occ_model.scene.scene import Scene
from occ_model.transmitter.edges import EdgedWaveform
from occ_model.transmitter.packet import sent_chips


class LedEdges(LightEffect):
    """The light follows the chips as their running mean over the edge time tau.

    A change of chip becomes a ramp of length tau: (1/tau) of the chips' integral over the last tau.
    The running integral of that has a closed form in turn, for any tau: see
    :mod:`occ_model.transmitter.edges`. As the rise and the fall take equally long, the mean light
    stays what it was; where tau is longer than a chip, single chips no longer reach full light.
    """

    name = "led-edges"
    label = "LED rise and fall"
    parameters = ("edge_time",)
    cost = Cost(picture=0.3e-3)

    def is_present(self, scene: Scene) -> bool:
        """Return whether the LED takes any time to switch."""
        return scene.transmitter.edge_time != 0.0

    def apply(self, scene: Scene, light: ColumnLight) -> ColumnLight:
        """Replace the light of every column by that of the ramps."""
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
