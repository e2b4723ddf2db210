"""Pixels of a sample of a scene, with all effects and without each; columns cost microseconds."""

import math
from collections.abc import Iterable, Sequence
from functools import cached_property, lru_cache

import numpy as np

from occ_model.arrays import BoolArray, FloatArray
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import (
    WHITE,
    fast_power,
    luminance_of,
    panel_values,
    pixel_value,
    saturation_value,
    surroundings_values,
)
from occ_model.camera.projection import geometry_of
from occ_model.camera.row_memory import MEMORY
from occ_model.effects.effect import (
    Effect,
    FileEffect,
    LightEffect,
    NoiseEffect,
    OpticsEffect,
    PixelEffect,
)
from occ_model.effects.file_change import FileChange
from occ_model.effects.level_table import LevelTable, Places
from occ_model.effects.normal_noise import rounding_mean
from occ_model.effects.paper_view import PaperView
from occ_model.effects.registry import named
from occ_model.effects.rims import Rims
from occ_model.effects.sample import Sample, sample_of
from occ_model.effects.simulated_columns import Names, SimulatedColumns

_DITHERING_NOISE = 0.5  # noise in grey levels from which a pixel's rounding is nothing in the mean


class SampledPixels:
    """A sample of a scene's pixels: their values and noise with some of the effects.

    Values for many sets of effects are computed at once: the first axis of the arrays is that of
    the sets.
    """

    def __init__(self, view: PaperView, effects: Iterable[Effect]) -> None:
        self.view = view
        self.scene = view.scene
        self.effects = tuple(effect for effect in effects if effect.is_present(view.scene))
        self.names = frozenset(effect.name for effect in self.effects)
        self.lights = named(self.names, LightEffect)
        self.lenses = named(self.names, OpticsEffect)
        self.limits = named(self.names, PixelEffect)
        self.noises = named(self.names, NoiseEffect)
        self.files = named(self.names, FileEffect)
        self.moving = tuple(e.name for e in (*self.lights, *self.lenses, *self.limits))
        self._moving = frozenset(self.moving)
        self._noisy = frozenset(effect.name for effect in self.noises)
        self._spread_of: dict[Names, tuple[FloatArray, float]] = {}
        self.sample = self._sampled()
        self.columns = SimulatedColumns(view, self.lights, self.limits)
        self.rims = Rims(view, self.sample)
        gains, power = self.sample.transmission, 1.0 / self.scene.camera.gamma
        self._dimmed = {name: fast_power(gain, power) for name, gain in gains.items()}

    def _sampled(self) -> Sample:
        scene, view = self.scene, self.view
        transmitter = scene.transmitter
        key = (
            "effect sample",
            view.corner_bytes,
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

    @cached_property
    def stack(self) -> FloatArray:
        """The pixels' mean values with all effects, and without each of ``moving``."""
        return self._computed([self._moving, *(self._moving - {name} for name in self.moving)])

    @property
    def whole(self) -> FloatArray:
        """The pixels' mean values with all effects, shape (columns, nodes)."""
        return np.asarray(self.stack[0])

    def place(self, name: str) -> int:
        """Return the index in ``stack`` of the pixels without an effect."""
        return self.moving.index(name) + 1 if name in self._moving else 0

    def values(self, sets: Sequence[Names]) -> FloatArray:
        """Return the pixels' mean values with some effects, shape (sets, columns, nodes)."""
        asked = [included & self._moving for included in sets]
        missing = [self._moving - included for included in asked]
        if all(len(names) <= 1 for names in missing):
            return self.stack[[self.place(next(iter(names), "")) for names in missing]]
        return self._computed(asked)

    def _computed(self, sets: Sequence[Names]) -> FloatArray:
        sample, camera = self.sample, self.scene.camera
        light, places = self.columns.light_at(sets, sample.columns)
        panel = panel_values(self.scene, light)
        values = np.empty((len(sets), *sample.rows.shape))
        if any(cover is not None for cover in sample.covers.values()) or sample.emission:
            dark = luminance_of(surroundings_values(self.scene, light), camera)
            own = (luminance_of(panel, camera) - dark)[places][:, :, None]
            dark = dark[places][:, :, None]
            for included, one, of_panel in zip(sets, values, own, strict=True):
                cover = sample.covers[included & sample.outline]
                one[:] = of_panel if cover is None else of_panel * cover
                for name, gain in sample.emission.items():
                    if name in included:
                        one *= gain
            values += dark
            values = pixel_value(np.maximum(values, 0.0, out=values), camera, fast_power)
        else:
            values[:] = panel[places][:, :, None]
        for included, one in zip(sets, values, strict=True):
            for name, dimmed in self._dimmed.items():
                if name in included:
                    one *= dimmed
            for limit in self.limits:
                if limit.name in included:
                    one[:] = limit.apply(self.scene, one)
        return np.minimum(values, WHITE, out=values)

    @cached_property
    def table(self) -> LevelTable:
        """Levels from the darkest pixel of the sample to the brightest, with any effects."""
        low, high = float(self.stack.min()), float(self.stack.max())
        if self.sample.covers[self.sample.outline] is not None:  # beside the panel, sampled or not
            low = min(low, float(surroundings_values(self.scene, self.view.light).min()))
        return LevelTable(low, high, saturation_value(self.scene))

    @property
    def levels(self) -> FloatArray:
        return self.table.levels

    @cached_property
    def variances(self) -> dict[str, FloatArray]:
        return {
            e.name: e.spread(self.scene, np.maximum(self.levels, 0.0)) ** 2 for e in self.noises
        }

    def spread(self, included: Names) -> FloatArray:
        """Return the standard deviation of noise at the levels, with some effects."""
        return self._spread(included)[0]

    def least_noise(self, included: Names) -> float:
        """Return the smallest :meth:`spread`."""
        return self._spread(included)[1]

    def _spread(self, included: Names) -> tuple[FloatArray, float]:
        key = included & self._noisy
        if key not in self._spread_of:
            own = [variance for name, variance in self.variances.items() if name in key]
            found = np.sqrt(sum(own, np.zeros(len(self.levels))))
            self._spread_of[key] = found, float(found.min())
        return self._spread_of[key]

    def noise_at(self, included: Names, values: FloatArray) -> FloatArray:
        """Return the standard deviation of noise at some values, with some effects.

        Just below a full well it ends within less than two levels of the table.
        """
        found = self.table.look(self.spread(included), values)
        full = saturation_value(self.scene)
        ends = (values < full) & (values > full - self.table.step)
        if ends.any():
            own = (e for e in self.noises if e.name in included)
            found[ends] = np.sqrt(sum(e.spread(self.scene, values[ends]) ** 2 for e in own))
        return found

    @cached_property
    def _places(self) -> Places:
        return self.table.place(self.whole)

    def at_whole(self, table: FloatArray) -> FloatArray:
        """Interpolate a table at the pixels with all effects."""
        return self.table.at(table, self._places)

    def mean_at_whole(self, table: FloatArray) -> float:
        """Return the mean of a table at the pixels with all effects."""
        return float(table @ self._weights_of_levels)

    @cached_property
    def _weights_of_levels(self) -> FloatArray:
        return self.table.divided(self.sample.pixel_weights, self._places)

    @cached_property
    def file(self) -> FileChange | None:
        """Change of the pixels by the file, None where the scene has none."""
        if not self.files:
            return None
        return FileChange(
            self.files[0].steps(self.scene),
            self.sample,
            self.stack,
            self.noise_with(self.names),
            self.rims,
        )

    def noise_with(self, included: Names) -> float:
        """Return the root mean square of noise on the panel with some effects."""
        squares = [square for name, square in self._noise_squares.items() if name in included]
        return math.sqrt(sum(squares))

    @cached_property
    def _noise_squares(self) -> dict[str, float]:
        if not self.variances:
            return {}
        inner = self.whole[:, self.sample.inner]
        means = self.table.look(np.stack(list(self.variances.values())), inner).mean(axis=(1, 2))
        return dict(zip(self.variances, means.tolist(), strict=True))

    @cached_property
    def noise_read_back(self) -> dict[str, tuple[float, float]]:
        """The mean square of each noise as a file has it: in pixels, and in a column's mean."""
        if self.file is None or not self.variances:
            return {}
        own = np.array(list(self._noise_squares.values()))
        image, mean = self.file.of_noise(np.sqrt(own), np.sqrt(own.sum() - own))
        pairs = zip(image.tolist(), mean.tolist(), strict=True)
        return dict(zip(self.variances, pairs, strict=True))

    @property
    def contrast(self) -> float:
        """The difference of the brightest and the darkest pixel of the sample."""
        return float(self.levels[-1] - self.levels[0])

    def profile(self, included: Names, factor: FloatArray | None = None) -> FloatArray:
        """Return the values on the panel of all columns of the region, dimmed by factors."""
        region = self.view.region
        span = slice(region.first_column, region.last_column)
        if factor is None:
            return self.columns.profile(included)[span]
        return self.columns.dimmed(included, span, factor)

    @cached_property
    def unsampled(self) -> FloatArray | None:
        """The weight that each column of the region lacks in the sample, None where none does.

        A mean over the panel's columns is one over the sample and a sum over columns with these.
        """
        region, columns = self.view.region, self.sample.columns
        if len(columns) >= region.columns:
            return None
        lacking = np.full(region.columns, 1.0 / region.columns)
        np.subtract.at(lacking, columns - region.first_column, self.sample.weights)
        inside = self.inside([self.names])
        if inside is None:
            return lacking
        return np.where(self.over_columns(self.mean_of_rows(inside[0])) > 0.0, lacking, 0.0)

    def over_columns(self, sampled: FloatArray) -> FloatArray:
        """Interpolate values of the sample's columns over all columns of the region."""
        region, columns = self.view.region, self.sample.columns
        order = np.argsort(columns)
        places = np.arange(region.first_column, region.last_column)
        return np.interp(places, columns[order], sampled[order])

    def dimming(self, name: str) -> FloatArray | None:
        """Return by what a lens dims each column of the sample in the mean, None for nothing."""
        if name in self._dimmed:
            return self.mean_of_rows(self._dimmed[name])
        gain = self.sample.emission.get(name)
        power = 1.0 / self.scene.camera.gamma
        return None if gain is None else self.mean_of_rows(fast_power(gain, power))

    def mean_of_rows(self, seen: FloatArray) -> FloatArray:
        return np.asarray(np.einsum("...cn,cn->...c", seen, self.sample.row_weights))

    def mean_of_columns(self, seen: FloatArray) -> float:
        return float(seen @ self.sample.weights)

    def read_back(self, sets: Sequence[Names]) -> FloatArray:
        """Return the pixels' mean values, of a file as they are read back."""
        values = self.values(sets)
        filed = [at for at, one in enumerate(sets) if self.files and self.files[0].name in one]
        if self.file is None or not filed:
            return values
        for at in filed:  # pixels are whole levels before they are in a file
            if self.least_noise(sets[at]) < _DITHERING_NOISE:  # a full pixel has no noise
                spread = self.table.look(self.spread(sets[at]), values[at])
                values[at] += rounding_mean(values[at], spread)
        noise = np.array([self.noise_with(sets[at]) for at in filed])
        values[filed] = self.file.means(values[filed], noise)
        return values

    def inside(self, sets: Sequence[Names]) -> BoolArray | None:
        """Return which pixels of the sample are the panel's, None where all are."""
        covers = [self.sample.covers[included & self.sample.outline] for included in sets]
        if all(cover is None for cover in covers):
            return None
        shape = self.sample.rows.shape
        return np.stack([np.ones(shape, bool) if c is None else c >= 0.5 for c in covers])


@lru_cache(maxsize=2)  # a scene's picture and its signal
def sampled_pixels(view: PaperView, effects: tuple[Effect, ...]) -> SampledPixels:
    """Return the sample of a view's pixels, for the effects that are not switched off."""
    return SampledPixels(view, effects)
