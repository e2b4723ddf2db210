"""The columns' pixel values of many images, and their places in tables of grey levels."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any

import numpy as np

from occ_model.arrays import FloatArray, IndexArray, Pixels
from occ_model.camera.enhancement import to_bytes
from occ_model.camera.exposure import lit_fractions
from occ_model.camera.grey_law import GreyLaw
from occ_model.camera.interpolation import Places, divide_weights
from occ_model.camera.photometry import ColumnLight, panel_values, surroundings_values
from occ_model.effects.effect import LightEffect
from occ_model.effects.registry import effects_named
from occ_model.results.frame import Plan
from occ_model.scene.scene import Scene
from occ_model.study.signals.grey_tables import (
    GreyDistribution,
    split,
    table_of_law,
    table_without_noise,
)


@dataclass(frozen=True, eq=False, slots=True)
class Image:
    """One picture of a scene, whose own start time and flicker's phase are not used."""

    scene: Scene
    plan: Plan  # The simulated effects
    start_time: float
    flicker_phase: float
    random: np.random.Generator

    @property
    def included(self) -> frozenset[str]:
        """Names of the effects."""
        return frozenset(self.plan.included)


def expose(images: Sequence[Image]) -> tuple[FloatArray, FloatArray]:
    """Return pixel values on the panel, (images, columns), and beside it, perhaps in one column."""
    panels, arounds = [], []
    for _, group in groupby(images, lambda image: id(image.scene)):
        of_scene = list(group)
        scene = of_scene[0].scene
        starts = [image.start_time for image in of_scene]
        phases = [image.flicker_phase for image in of_scene]
        light = ColumnLight(np.ones((1, 1)), np.ones((len(starts), 1)))
        effects = effects_named(of_scene[0].included, LightEffect)
        if not any(effect.sets_panel_light(scene) for effect in effects):
            light = replace(light, lit=lit_fractions(scene, starts))
        for effect in effects:
            light = effect.apply_to_images(scene, light, starts, phases)
        panels.append(panel_values(scene, light))
        arounds.append(surroundings_values(scene, light))
    width = max(around.shape[1] for around in arounds)
    wide = [np.broadcast_to(around, (len(around), width)) for around in arounds]
    return np.concatenate(panels), np.concatenate(wide)


def even_out(panel: FloatArray) -> FloatArray:
    """Make values equal that differ only by rounding, since they could round to two levels."""
    low = panel.min(axis=1, keepdims=True)
    return np.where(panel.max(axis=1, keepdims=True) - low < 1e-9, low, panel)


class PixelLevels:
    """The law of a pixel's grey level by its mean value, for many pictures at once."""

    def __init__(self, law: GreyLaw | None) -> None:
        self.law = law
        self.table = table_without_noise() if law is None else table_of_law(law)

    def places(self, values: Pixels | FloatArray) -> Places:
        """Return the places of pixel values in the table."""
        if self.law is None:
            return to_bytes(values).astype(np.intp), np.zeros(values.shape, dtype=np.float32)
        return split(self.law.levels_of(values.astype(np.float32)), len(self.table.below))


def as_one_band(places: Places, columns: slice) -> Places:
    """Return the places of some columns as those of one band."""
    return places[0][:, None, columns], places[1][:, None, columns]


_SOME_BANDS = 4  # bands that suffice to find the panel, and to measure the noise


def some_bands(places: Places) -> Places:
    return some_bands_of(places[0]), some_bands_of(places[1])


def some_bands_of(values: Any) -> Any:
    """Return some of the bands, evenly from the first to the last: shape (images, bands, ...)."""
    count = values.shape[1]
    if count <= _SOME_BANDS:
        return values
    return values[:, np.linspace(0, count - 1, _SOME_BANDS).round().astype(int)]


def columns_of(places: Places, columns: IndexArray) -> Places:
    if places[0].shape[-1] == 1:
        return places
    return places[0][..., columns], places[1][..., columns]


def weights_of_levels(places: Places, weights: Pixels, table: GreyDistribution) -> FloatArray:
    """Return the sums of weights at each level of a table, for each picture: (images, levels)."""
    below, fraction = places
    count, levels = len(below), len(table.below)
    offset = (np.arange(count) * levels).reshape(-1, *(1,) * (below.ndim - 1))
    sums = divide_weights(np.asarray(weights, float), (below + offset, fraction), count * levels)
    return sums.reshape(count, levels)


def interpolate_each(tables: FloatArray, places: Places) -> Pixels:
    """Interpolate a table of its own, (images, levels), for each picture, in single precision."""
    below, fraction = places
    values = tables.astype(np.float32)
    steps = np.zeros_like(values)
    np.subtract(values[:, 1:], values[:, :-1], out=steps[:, :-1])
    at = below + (np.arange(len(tables)) * tables.shape[1]).reshape(-1, *(1,) * (below.ndim - 1))
    found = steps.ravel().take(at)
    found *= fraction
    found += values.ravel().take(at)
    return np.asarray(found)
