"""The pixels of a sample as the lens lights them: their values before saturation."""

from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import (
    fast_power,
    luminance_of,
    panel_values,
    pixel_value,
    surroundings_values,
)
from occ_model.camera.projection import geometry_of
from occ_model.camera.row_memory import MEMORY
from occ_model.effects.effect import OpticsEffect, PaperView
from occ_model.effects.sample import PixelSample, choose_sample
from occ_model.effects.simulated_columns import Names, SimulatedColumns


def sample_of(view: PaperView, lenses: Sequence[OpticsEffect], *, in_blocks: bool) -> PixelSample:
    """Return a sample of a view's pixels, cached by all on which it depends."""
    scene = view.scene
    key = (
        "effect sample",
        view.corner_bytes,
        scene.pose,
        scene.lens,
        *geometry_of(scene.camera),
        scene.camera.f_number,
        scene.sensor.pixel_pitch,
        scene.transmitter.lambertian_order,
        tuple(effect.name for effect in lenses),
        in_blocks,
    )

    def make() -> PixelSample:
        plain = Optics(view.corners)
        optics = {effect.name: effect.apply(scene, plain) for effect in lenses}
        fills_region = view.sides is not None and view.is_visible
        return choose_sample(view.region, fills_region, optics, plain, in_blocks)

    return MEMORY.recall(key, make, lambda sample: sample.arrays)


class SampledLight:
    def __init__(self, view: PaperView, sample: PixelSample, columns: SimulatedColumns) -> None:
        self._scene, self._sample, self._columns = view.scene, sample, columns
        gains = {**sample.emission, **sample.transmission}
        power = 1.0 / view.scene.camera.gamma
        self.dimming = {name: fast_power(gain, power) for name, gain in gains.items()}
        """Factors of the pixels' values by each effect that dims them."""

    def expose(self, sets: Sequence[Names]) -> FloatArray:
        """Return the values with some effects, shape (sets, columns, nodes)."""
        sample, scene, camera = self._sample, self._scene, self._scene.camera
        light, places = self._columns.light_at(sets, sample.columns)
        panel = panel_values(scene, light)
        values = np.empty((len(sets), *sample.rows.shape))
        if any(cover is not None for cover in sample.covers.values()) or sample.emission:
            dark = luminance_of(surroundings_values(scene, light), camera)
            panel_light = (luminance_of(panel, camera) - dark)[places][:, :, None]
            dark = dark[places][:, :, None]
            for included, pixel_values, of_panel in zip(sets, values, panel_light, strict=True):
                cover = sample.covers[included & sample.outline]
                pixel_values[:] = of_panel if cover is None else of_panel * cover
                for name, gain in sample.emission.items():
                    if name in included:
                        pixel_values *= gain
            values += dark
            values = pixel_value(np.maximum(values, 0.0, out=values), camera, fast_power)
        else:
            values[:] = panel[places][:, :, None]
        for included, pixel_values in zip(sets, values, strict=True):
            for name in sample.transmission:
                if name in included:
                    pixel_values *= self.dimming[name]
        return values
