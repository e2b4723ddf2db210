"""The columns of a whole picture with some of the effects; they take microseconds."""

from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.enhancement import Enhancement
from occ_model.camera.photometry import ColumnLight, fast_power, panel_values, saturate
from occ_model.effects.effect import LightEffect, PaperView, PixelEffect

Names = frozenset[str]  # effects by name


class SimulatedColumns:
    """The light of a view's columns, their values, and the receiver's enhancement of them.

    Each result is cached by those of the effects that change it.
    """

    def __init__(
        self, view: PaperView, lights: Sequence[LightEffect], limits: Sequence[PixelEffect]
    ) -> None:
        self._view = view
        self._lights, self._limits = lights, limits
        self._of_light = frozenset(effect.name for effect in lights)
        self._of_value = self._of_light.union(effect.name for effect in limits)
        self._light: dict[Names, ColumnLight] = {}
        self._exposed: dict[Names, FloatArray] = {}
        self._profile: dict[Names, FloatArray] = {}
        self._enhancement: dict[Names, Enhancement] = {}

    def light(self, included: Names) -> ColumnLight:
        key = included & self._of_light
        if key not in self._light:
            light = self._view.light
            for effect in self._lights:
                if effect.name in key:
                    light = effect.apply(self._view.scene, light)
            self._light[key] = light
        return self._light[key]

    def light_at(self, sets: Sequence[Names], columns: IndexArray) -> tuple[ColumnLight, list[int]]:
        """Return the distinct lights at some columns, (lights, columns), and each set's index."""
        keys = [included & self._of_light for included in sets]
        distinct = list(dict.fromkeys(keys))
        lights = [self.light(key) for key in distinct]
        ambient = [
            light.ambient[columns]
            if len(light.ambient) > 1
            else np.repeat(light.ambient, len(columns))
            for light in lights
        ]
        light_of_sets = ColumnLight(
            np.stack([light.lit[columns] for light in lights]), np.stack(ambient)
        )
        return light_of_sets, [distinct.index(key) for key in keys]

    def profile(self, included: Names) -> FloatArray:
        key = included & self._of_value
        if key not in self._profile:
            self._profile[key] = self.dim_values(key, slice(None), 1.0)
        return self._profile[key]

    def dim_values(self, included: Names, columns: slice, factor: FloatArray | float) -> FloatArray:
        """Return the values of some columns after dimming by a lens and saturation."""
        values = self._expose(included)[columns] * factor
        for limit in self._limits:
            if limit.name in included:
                values = limit.apply(self._view.scene, values)
        return saturate(values)

    def _expose(self, included: Names) -> FloatArray:
        """Return the unsaturated values of all columns from their light alone."""
        key = included & self._of_light
        if key not in self._exposed:
            light, view = self.light(key), self._view
            is_known = light is view.light
            self._exposed[key] = (
                view.values if is_known else panel_values(view.scene, light, fast_power)
            )
        return self._exposed[key]

    def enhancement(self, included: Names) -> Enhancement:
        key = included & self._of_value
        if key not in self._enhancement:
            method = self._view.scene.model.enhancement
            self._enhancement[key] = Enhancement(self.profile(included), method)
        return self._enhancement[key]
