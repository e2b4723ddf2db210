"""The columns of a whole picture with some of the effects; they take microseconds."""

from collections.abc import Callable, Sequence

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.enhancement import Enhancement
from occ_model.camera.grey_law import GreyLaw
from occ_model.camera.photometry import ColumnLight, fast_power, panel_values, saturate
from occ_model.effects.effect import LightEffect, NoiseEffect, PaperView
from occ_model.effects.noise import enhancement_of
from occ_model.effects.sensor_effects import FullWell

Names = frozenset[str]  # effects by name


class SimulatedColumns:
    """The light of a view's columns, their values, and the receiver's enhancement of them.

    Each result is cached by those of the effects that change it.
    """

    def __init__(
        self,
        view: PaperView,
        lights: Sequence[LightEffect],
        limits: Sequence[FullWell],
        noises: Sequence[NoiseEffect],
        law: Callable[[Names], GreyLaw | None],
    ) -> None:
        """Prepare the columns; ``law`` returns the law of grey levels with some effects."""
        self._view, self._law = view, law
        self._lights, self._limits = lights, limits
        self._of_light = frozenset(effect.name for effect in lights)
        self._of_value = self._of_light.union(effect.name for effect in limits)
        self._of_pixels = self._of_value.union(effect.name for effect in noises)
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
        lit = np.stack([light.lit[columns] for light in lights])
        ambient = [np.broadcast_to(light.ambient, light.lit.shape)[columns] for light in lights]
        return ColumnLight(lit, np.stack(ambient)), [distinct.index(key) for key in keys]

    def profile(self, included: Names) -> FloatArray:
        """Return the values of all columns after saturation, without noise."""
        key = included & self._of_value
        if key not in self._profile:
            values = self.expose(key)
            for limit in self._limits:
                if limit.name in key:
                    values = limit.apply(self._view.scene, values)
            self._profile[key] = saturate(values)
        return self._profile[key]

    def expose(self, included: Names) -> FloatArray:
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
        key = included & self._of_pixels
        if key not in self._enhancement:
            self._enhancement[key] = enhancement_of(
                self._view.scene, self.profile(key), self.expose(key), self._law(key)
            )
        return self._enhancement[key]
