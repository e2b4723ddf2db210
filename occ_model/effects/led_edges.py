"""LED rise and fall: the light follows the chips with ramps in place of steps."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import column_phases
from occ_model.camera.photometry import ColumnLight, pixel_value
from occ_model.effects.effect import LightEffect
from occ_model.effects.paper_view import PaperView, reachable_luminances
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable
from occ_model.transmitter.edges import EdgedWaveform, most_changes
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

    def is_present(self, scene: Scene) -> bool:
        """Return whether the LED takes any time to switch."""
        return scene.transmitter.edge_time != 0.0

    def _bound(self, view: PaperView, observable: Observable) -> float:  # noqa: ARG002 - rows alike
        """Bound the change by the columns that see an edge, and the change of each.

        A column's light changes where a chip does within its exposure or the edge time before it,
        and then by at most tau / 2, the light that one ramp keeps back.
        """
        scene = view.scene
        share = min(scene.transmitter.edge_time / (2.0 * scene.camera.exposure_time), 1.0)
        dark, bright = reachable_luminances(scene)
        if scene.model.averaging == "light":
            # The gamma encoding is steepest in the dark: there the share counts most.
            steps = pixel_value(np.array([dark, dark + (bright - dark) * share]), scene.camera)
        else:
            low, high = pixel_value(np.array([dark, bright]), scene.camera)
            steps = np.array([low, low + (high - low) * share])
        change = float(view.largest_changes(steps[:1], steps[1:])[0])
        return change * math.sqrt(_share_of_columns(view))

    def apply(self, scene: Scene, light: ColumnLight) -> ColumnLight:
        """Replace the light of every column by that of the ramps."""
        if not self.is_present(scene):
            return light
        return replace(light, lit=edged_lit_fraction(scene))


def _share_of_columns(view: PaperView) -> float:
    """Return the largest share of the observed columns in which a chip can change."""
    scene = view.scene
    columns, readout_time = view.region.columns, scene.camera.readout_time
    frequency = scene.transmitter.switching_frequency
    window = scene.camera.exposure_time + scene.transmitter.edge_time
    span = (columns * readout_time + window) * frequency
    changes = most_changes(sent_chips(scene.transmitter), span)
    return min(changes * (window / readout_time + 1.0) / columns, 1.0)


def edged_lit_fraction(scene: Scene) -> FloatArray:
    """Return the mean light in each column's exposure, 1 being the panel fully lit.

    Returns
    -------
    ndarray of float64, shape (columns,), from 0 to 1
    """
    frequency = Fraction(scene.transmitter.switching_frequency)
    exposure = Fraction(scene.camera.exposure_time) * frequency
    waveform = EdgedWaveform(
        sent_chips(scene.transmitter), Fraction(scene.transmitter.edge_time) * frequency
    )

    lit = waveform.lit_chips(lambda shift: column_phases(scene, waveform.period, shift), exposure)
    return np.clip(lit / float(exposure), 0.0, 1.0)
