"""Pixels of a sample of a scene, with all effects and without each; columns cost microseconds."""

import math
from collections.abc import Iterable
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.enhancement import Enhancement
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import (
    FLAT,
    WHITE,
    ColumnLight,
    luminance_of,
    panel_values,
    pixel_value,
    saturate,
    surroundings_values,
)
from occ_model.camera.projection import geometry_of
from occ_model.camera.row_memory import MEMORY
from occ_model.camera.sensor import saturation_value
from occ_model.effects.effect import (
    Effect,
    FileEffect,
    LightEffect,
    NoiseEffect,
    OpticsEffect,
    PixelEffect,
)
from occ_model.effects.file_change import FileChange
from occ_model.effects.paper_view import PaperView
from occ_model.effects.sample import Sample, sample_of

_LEVELS = 129

_UNSAMPLED_RIM_PIXELS = 1.0
"""Pixels of a rim that may change and that no sample shows."""

_SEEN_SHARE = 0.003
"""Change of a pixel's light from beyond a rim that can round it otherwise."""


class _Light:
    """The columns' values with some effects on the light."""

    def __init__(self, view: PaperView, effects: Iterable[LightEffect]) -> None:
        scene, light = view.scene, view.light
        for effect in effects:
            light = effect.apply(scene, light)
        self.light: ColumnLight = light
        self.panel = view.values if light is view.light else panel_values(scene, light)
        self.surroundings = np.broadcast_to(surroundings_values(scene, light), self.panel.shape)


class SampledPixels:
    """A sample of a scene's pixels, and what they and their noise are with some of the effects."""

    def __init__(self, view: PaperView, effects: Iterable[Effect]) -> None:
        self.view = view
        self.scene = view.scene
        self.effects = tuple(effect for effect in effects if effect.is_present(view.scene))
        self.names = frozenset(effect.name for effect in self.effects)
        self.lights = [e for e in self.effects if isinstance(e, LightEffect)]
        self.lenses = [e for e in self.effects if isinstance(e, OpticsEffect)]
        self.limits = [e for e in self.effects if isinstance(e, PixelEffect)]
        self.noises = [e for e in self.effects if isinstance(e, NoiseEffect)]
        self.files = [e for e in self.effects if isinstance(e, FileEffect)]
        self.means = [*self.lights, *self.lenses, *self.limits]
        self._light_of: dict[frozenset[str], _Light] = {}
        self._values_of: dict[frozenset[str], FloatArray] = {}
        self._place_of: dict[int, tuple[FloatArray, tuple[IndexArray, FloatArray]]] = {}
        self._enhancement_of: dict[frozenset[str], Enhancement] = {}
        self.sample = self._sampled()
        power = 1.0 / self.scene.camera.gamma
        self._dimmed = {n: g**power for n, g in self.sample.transmission.items()}

    def _sampled(self) -> Sample:
        scene, view = self.scene, self.view
        transmitter = scene.transmitter
        key = (
            "effect sample",
            view.corners.tobytes(),
            scene.pose,
            scene.lens,
            *geometry_of(scene.camera),
            scene.camera.f_number,
            scene.sensor.pixel_pitch,
            transmitter.lambertian_order,
            tuple(effect.name for effect in self.lenses),
            bool(self.files),
        )

        def make() -> Sample:
            plain = Optics(view.corners)
            optics = {effect.name: effect.apply(scene, plain) for effect in self.lenses}
            level = view.sides is not None and view.is_seen
            return sample_of(view.region, level, optics, plain, bool(self.files))

        return MEMORY.recall(key, make, lambda made: made.arrays)

    def light(self, included: frozenset[str]) -> _Light:
        """Return the values of all columns of the picture with some effects on the light."""
        chosen = [effect for effect in self.lights if effect.name in included]
        key = frozenset(effect.name for effect in chosen)
        if key not in self._light_of:
            self._light_of[key] = _Light(self.view, chosen)
        return self._light_of[key]

    def values(self, included: frozenset[str]) -> FloatArray:
        """Return the pixels' mean values with some effects, shape (columns, nodes)."""
        included = included & frozenset(e.name for e in self.means)
        if included not in self._values_of:
            self._values_of[included] = self._computed(included)
        return self._values_of[included]

    def _computed(self, included: frozenset[str]) -> FloatArray:
        sample, camera = self.sample, self.scene.camera
        light = self.light(included)
        places = sample.columns
        panel = light.panel[places][:, None]
        cover = sample.covers[included & self.outline]
        emission = [gain for name, gain in sample.emission.items() if name in included]
        if cover is None and not emission:
            values = np.broadcast_to(panel, sample.rows.shape)
        else:
            surroundings = light.surroundings[places][:, None]
            dark = luminance_of(surroundings, camera)
            own = luminance_of(panel, camera) - dark
            for factor in [*emission, *([] if cover is None else [cover])]:
                own = own * factor
            values = pixel_value(np.maximum(dark + own, 0.0), camera)
        for name, gain in self._dimmed.items():
            if name in included:
                values = values * gain
        for limit in self.limits:
            if limit.name in included:
                values = limit.apply(self.scene, values)
        return np.minimum(values, WHITE)

    @cached_property
    def outline(self) -> frozenset[str]:
        """The effects that move or soften the rims of the panel."""
        return max(self.sample.covers, key=len)

    @cached_property
    def levels(self) -> FloatArray:
        """Levels from the darkest pixel of the sample to the brightest, with any effects."""
        found = [self.values(self.names), *(self.values(self.names - {e.name}) for e in self.means)]
        low = min(float(values.min()) for values in found)
        high = max(float(values.max()) for values in found)
        step = max(high - low, FLAT) / (_LEVELS - 3)
        full = saturation_value(self.scene)
        if low < full < high:  # where noise ends, a level of the table
            low -= step * (1.0 - (full - low) / step % 1.0)
        return np.asarray(low + step * np.arange(_LEVELS, dtype=np.float64), dtype=np.float64)

    @cached_property
    def variances(self) -> dict[str, FloatArray]:
        """The variance of each noise at the levels."""
        return {
            e.name: e.spread(self.scene, np.maximum(self.levels, 0.0)) ** 2 for e in self.noises
        }

    def spread(self, included: frozenset[str]) -> FloatArray:
        """Return the standard deviation of noise at the levels, with some effects."""
        own = [variance for name, variance in self.variances.items() if name in included]
        return np.sqrt(sum(own, np.zeros(_LEVELS)))

    def look(self, table: FloatArray, values: FloatArray) -> FloatArray:
        """Interpolate a table over the levels at values."""
        below, share = self._place(values)
        steps = table[1:] - table[:-1]
        return np.asarray(table[below] + share * steps[below])

    def _place(self, values: FloatArray) -> tuple[IndexArray, FloatArray]:
        """Return the level below each value, and how far the value lies towards the next one."""
        known = self._place_of.get(id(values))
        if known is not None and known[0] is values:
            return known[1]
        low, high = float(self.levels[0]), float(self.levels[-1])
        place = (values - low) * ((_LEVELS - 1) / (high - low))
        place = np.minimum(np.maximum(place, 0.0), _LEVELS - 1.001)
        below = place.astype(np.intp)
        found = below, place - below
        if any(values is kept for kept in self._values_of.values()):  # looked up again and again
            self._place_of[id(values)] = values, found
        return found

    @cached_property
    def file(self) -> FileChange | None:
        """What the file makes of the pixels, None where the scene has none."""
        if not self.files:
            return None
        sample, view = self.sample, self.view
        return FileChange(
            self.files[0].steps(self.scene),
            sample.blocks,
            sample.inner,
            self.values(self.names),
            self.noise_with(self.names),
            view.region.rows / 8.0,
            self.rim_share,
        )

    def noise_with(self, included: frozenset[str]) -> float:
        """Return the root mean square of noise on the panel with some effects."""
        whole = self.values(self.names)[:, self.sample.inner]
        return math.sqrt(float(self.look(self.spread(included) ** 2, whole).mean()))

    def noise_without(self, name: str) -> tuple[float, float]:
        """Return the root mean square of a noise, and of all the other, on the panel."""
        return self.noise_with(frozenset({name})), self.noise_with(self.names - {name})

    @property
    def rim_share(self) -> float:
        """The share of the region's pixels that lie in a file's blocks with a rim."""
        region, camera = self.view.region, self.scene.camera
        if self.view.sides is None:
            return min(1.0, 8.0 / region.rows + 8.0 / region.columns)
        ends = (region.first_row > 0) + (region.last_row < camera.rows)
        sides = (region.first_column > 0) + (region.last_column < camera.columns)
        return min(1.0, 4.0 * ends / region.rows + 4.0 * sides / region.columns)

    def moved_rims(self, name: str) -> float:
        """Return how many rims of a column, 0 to 2, an effect moves or softens in the mean."""
        covers, sample = self.sample.covers, self.sample
        whole, without = covers[self.outline], covers[self.outline - {name}]
        if whole is None or without is None:
            return 0.0
        moved = np.abs(whole - without) > _SEEN_SHARE
        middle = sample.inner.start + 2
        above, below = moved[:, :middle].any(axis=1), moved[:, middle:].any(axis=1)
        return float(((above * 1.0 + below) * sample.weights).sum())

    @property
    def contrast(self) -> float:
        """The difference of the brightest and the darkest pixel of the sample."""
        return float(self.levels[-1] - self.levels[0])

    def doubted_pixels(self, square: float) -> float:
        """Return the mean square of a few pixels of a rim, of which a sample need not show any.

        A file spreads them over their block. A panel that covers all of the picture has no rim.
        """
        if self.sample.is_covered:
            return 0.0
        doubt = _UNSAMPLED_RIM_PIXELS * square
        if self.file is not None:
            pixels = self.view.region.rows * self.view.region.columns
            doubt += self.file.added_at_rims(min(64.0 / pixels, self.rim_share), doubt)
        return doubt

    def mean_of_rows(self, seen: FloatArray) -> FloatArray:
        """Return the mean of each column over its rows."""
        return np.asarray((seen * self.sample.row_weights).sum(axis=1))

    def mean_of(self, pixels: FloatArray) -> float:
        """Return the mean over all pixels."""
        return float((self.mean_of_rows(pixels) * self.sample.weights).sum())

    def read_back(self, included: frozenset[str]) -> FloatArray:
        """Return the pixels' mean values, of a file as they are read back."""
        values = self.values(included)
        if self.file is None or self.files[0].name not in included:
            return values
        return self.file.means(values, self.noise_with(included))

    def enhancement(self, included: frozenset[str]) -> Enhancement:
        """Return the receiver's enhancement of the profile that some effects leave."""
        key = included & frozenset(e.name for e in (*self.lights, *self.limits))
        if key not in self._enhancement_of:
            profile = self.light(included).panel
            for limit in self.limits:
                if limit.name in included:
                    profile = limit.apply(self.scene, profile)
            method = self.scene.model.enhancement
            self._enhancement_of[key] = Enhancement(saturate(profile), method)
        return self._enhancement_of[key]

    def inside(self, included: frozenset[str]) -> NDArray[np.bool_] | None:
        """Return which pixels of the sample are the panel's, None where all are."""
        share = self.sample.covers[included & self.outline]
        return None if share is None else share >= 0.5

    def is_like_noise(self, name: str) -> bool:
        """Return whether what an effect changes differs from column to column."""
        return any(effect.name == name for effect in (*self.noises, *self.files))
