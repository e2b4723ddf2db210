"""The values of a sample's pixels, with all effects and without some of them."""

import math
from collections.abc import Iterable, Sequence
from functools import cached_property, lru_cache

import numpy as np

from occ_model.arrays import BoolArray, FloatArray
from occ_model.camera.interpolation import Places, divide_weights, interpolate_at
from occ_model.camera.photometry import saturation_value, surroundings_values
from occ_model.camera.pixel_noise import GREY_LEVELS
from occ_model.effects.effect import (
    Effect,
    LightEffect,
    NoiseEffect,
    OpticsEffect,
    PaperView,
)
from occ_model.effects.file_change import FileChange
from occ_model.effects.level_table import LevelTable
from occ_model.effects.noisy_pixels import NoisyPixels
from occ_model.effects.normal_noise import rounding_growth_by_noise, rounding_mean
from occ_model.effects.observed import RandomSquare
from occ_model.effects.registry import effects_named
from occ_model.effects.rims import Rims
from occ_model.effects.sampled_light import SampledLight, sample_of
from occ_model.effects.sensor_effects import FullWell, Jpeg, quantization_steps
from occ_model.effects.simulated_columns import Names, SimulatedColumns

_DITHERING_NOISE = 0.5  # noise in grey levels above which rounding does not change a pixel's mean


class SampledPixels:
    """Values and noise of a sample of a scene's pixels, with any of the effects.

    Values for many sets of effects are computed at once, along the first axis of the arrays.
    """

    def __init__(self, view: PaperView, effects: Iterable[Effect]) -> None:
        self.view = view
        self.scene = view.scene
        self.effects = tuple(effect for effect in effects if effect.is_present(view.scene))
        self.names = frozenset(effect.name for effect in self.effects)
        self.lights = effects_named(self.names, LightEffect)
        self.lenses = effects_named(self.names, OpticsEffect)
        self.limits = effects_named(self.names, FullWell)
        self.noises = effects_named(self.names, NoiseEffect)
        self.files = effects_named(self.names, Jpeg)
        self.moving = tuple(e.name for e in (*self.lights, *self.lenses, *self.limits))
        self._moving = frozenset(self.moving)
        self._sets = [self.names, *(self.names - {name} for name in self.moving)]
        self._noisy = frozenset(effect.name for effect in self.noises)
        self._spread_of: dict[Names, tuple[FloatArray, float]] = {}
        self.sample = sample_of(view, self.lenses, in_blocks=bool(self.files))
        self.noisy = NoisyPixels(self.scene, self.names)
        self.columns = SimulatedColumns(view, self.lights, self.limits, self.noises, self.noisy.law)
        self.rims = Rims(view, self.sample)
        self.light = SampledLight(view, self.sample, self.columns)

    @cached_property
    def _exposed(self) -> FloatArray:
        """The pixels' values before saturation with all effects, and without each of ``moving``."""
        exposed = self.light.expose(
            [self._moving, *(self._moving - {name} for name in self.moving)]
        )
        around = surroundings_values(self.scene, self.view.light)
        others = (self.view.values, self.columns.expose(self.names), around)
        self.noisy.brightest = max(float(each.max()) for each in (exposed, *others))
        return exposed

    @cached_property
    def stack(self) -> FloatArray:
        """The pixels' mean values with all effects, and without each of ``moving``."""
        return self.values(self._sets)

    @property
    def complete_values(self) -> FloatArray:
        """The pixels' mean values with all effects, shape (columns, nodes)."""
        return np.asarray(self.stack[0])

    def stack_index(self, name: str) -> int:
        """Return the index in ``stack`` of the pixels without an effect; 0 if it changes none."""
        return self.moving.index(name) + 1 if name in self._moving else 0

    def values(self, sets: Sequence[Names]) -> FloatArray:
        """Return the pixels' mean values with some effects, shape (sets, columns, nodes)."""
        exposed = self._expose(sets)
        pairs = zip(sets, exposed, strict=True)
        return np.stack([self.noisy.means(included, values) for included, values in pairs])

    def _expose(self, sets: Sequence[Names]) -> FloatArray:
        wanted = [included & self._moving for included in sets]
        missing = [self._moving - included for included in wanted]
        if all(len(names) <= 1 for names in missing):
            return self._exposed[[self.stack_index(next(iter(names), "")) for names in missing]]
        return self.light.expose(wanted)

    @cached_property
    def table(self) -> LevelTable:
        """Levels from the darkest to the brightest pixel of the sample with any effects."""
        ends = [self.stack, self.noisy.means(frozenset(), self._exposed)]
        low, high = min(float(e.min()) for e in ends), max(float(e.max()) for e in ends)
        if self.sample.covers[self.sample.outline] is not None:  # include pixels beside the panel
            around = surroundings_values(self.scene, self.view.light)
            low = min(low, float(around.min()), float(self._around.min()))
        return LevelTable(low, high, saturation_value(self.scene))

    @cached_property
    def _around(self) -> FloatArray:
        """The mean values of pixels beside the panel."""
        return self.noisy.means(self.names, surroundings_values(self.scene, self.view.light))

    @cached_property
    def variances(self) -> dict[str, FloatArray]:
        """What each noise adds to a pixel's variance, at each level."""
        return {e.name: self.noisy.variance_by(e.name, self.table.levels) for e in self.noises}

    def spread(self, included: Names) -> FloatArray:
        """Return the noise's standard deviation at each level, with some effects."""
        return self._cached_spread(included)[0]

    def least_noise(self, included: Names) -> float:
        """Return the smallest value of :meth:`spread`."""
        return self._cached_spread(included)[1]

    def _cached_spread(self, included: Names) -> tuple[FloatArray, float]:
        key = included & self._noisy
        if key not in self._spread_of:
            variances = [variance for name, variance in self.variances.items() if name in key]
            spread = np.sqrt(sum(variances, np.zeros(len(self.table.levels))))
            self._spread_of[key] = spread, float(spread.min())
        return self._spread_of[key]

    def noise_at(self, included: Names, values: FloatArray) -> FloatArray:
        """Return the noise's standard deviation at some values, with some effects."""
        return self.table.interpolate(self.spread(included), values)

    @cached_property
    def _places(self) -> Places:
        return self.table.place(self.complete_values)

    def interpolate_at_pixels(self, table: FloatArray) -> FloatArray:
        """Interpolate a table at the pixels with all effects."""
        return interpolate_at(table, self._places)

    def mean_over_pixels(self, table: FloatArray) -> float:
        """Return the mean of a table at the pixels with all effects."""
        return float(table @ self._weights_of_levels)

    @cached_property
    def _weights_of_levels(self) -> FloatArray:
        weights = self.sample.pixel_weights
        return divide_weights(weights, self._places, len(self.table.levels))

    @cached_property
    def file(self) -> FileChange | None:
        """How the file changes the pixels; None if the scene has no file effect."""
        if not self.files:
            return None
        moved = [RandomSquare(), *(self.drawn_changes[name] for name in self.moving)]
        return FileChange(
            quantization_steps(self.scene.camera.jpeg_quality),
            self.sample,
            self.stack,
            self.noise_rms(self.names),
            self.rims,
            around=np.zeros(0) if self.sample.is_covered else self._around,
            moved=np.array([(each.mean, each.mean_of_squares) for each in moved]).T,
        )

    @cached_property
    def drawn_changes(self) -> dict[str, RandomSquare]:
        """What drawing whole grey levels adds to the mean square change of pixels, by effect."""
        return self.random_squares()

    def random_squares(
        self, enhancing: FloatArray | None = None, inside: BoolArray | None = None
    ) -> dict[str, RandomSquare]:
        """Return what differs from pixel to pixel in the change without each effect.

        ``enhancing`` is the enhancement's curve for the pixels ``inside`` the panel, or for all;
        None for pixels that are not enhanced.
        """
        names = (*self.moving, *self.variances)
        if not self.noisy.is_drawn(self.names):
            squares = np.zeros((len(names), *self.sample.rows.shape))
            for place, variance in enumerate(self.variances.values(), len(self.moving)):
                squares[place] = self.interpolate_at_pixels(variance)
            steps = np.ones(1)
            if self.files:
                squares += rounding_growth_by_noise(np.sqrt(squares))
        else:
            squares, steps = self._drawn_squares(enhancing)
            if inside is not None:
                squares, steps = np.where(inside, (squares, steps), self._drawn_squares(None))
        parts = np.stack([squares, squares**2, squares * steps**2])
        means = np.einsum("pecn,cn->ep", parts, self.sample.pixel_weights)
        return {name: RandomSquare(*own) for name, own in zip(names, means.tolist(), strict=True)}

    def _drawn_squares(self, enhancing: FloatArray | None) -> tuple[FloatArray, FloatArray]:
        return self.noisy.drawn_squares(
            self._sets,
            self._exposed_places,
            self.variances,
            GREY_LEVELS if enhancing is None else enhancing,
            is_rounded=enhancing is not None or bool(self.files),
        )

    @cached_property
    def _exposed_places(self) -> list[Places]:
        exposed = self._exposed  # before the law, which depends on the brightest of them
        return self.noisy.places(self._sets, exposed)

    def noise_rms(self, included: Names) -> float:
        """Return the RMS of the noise on the panel with some effects."""
        squares = [square for name, square in self._noise_squares.items() if name in included]
        return math.sqrt(sum(squares))

    @cached_property
    def _noise_squares(self) -> dict[str, float]:
        """The mean variance by each noise between the panel's rims."""
        inner = self.sample.inner
        return {n: float(each[:, inner].mean()) for n, each in self._variances_at_pixels.items()}

    @cached_property
    def _variances_at_pixels(self) -> dict[str, FloatArray]:
        if self.noisy.is_drawn(self.names):
            return {n: self.noisy.variance_at(n, self._exposed_places[0]) for n in self.variances}
        return {n: self.interpolate_at_pixels(each) for n, each in self.variances.items()}

    @cached_property
    def noise_read_back(self) -> dict[str, tuple[float, float]]:
        """The mean square of each noise after the file, in pixels and in a column's mean."""
        if self.file is None or not self.variances:
            return {}
        own = np.array([self.drawn_changes[name].mean for name in self.variances])
        at_pixels = np.stack(list(self._variances_at_pixels.values()))
        variances = np.einsum("ecn,cn->e", at_pixels, self.sample.pixel_weights)
        image, mean = self.file.noise_squares(own, variances)
        pairs = zip(image.tolist(), mean.tolist(), strict=True)
        return dict(zip(self.variances, pairs, strict=True))

    def profile(self, included: Names, factor: FloatArray | None = None) -> FloatArray:
        """Return the mean on the panel of each column of the region, dimmed by a factor each."""
        region = self.view.region
        span = slice(region.first_column, region.last_column)
        exposed = self.columns.expose(included)[span]
        return self.noisy.means(included, exposed if factor is None else exposed * factor)

    @cached_property
    def unsampled(self) -> FloatArray | None:
        """Each column's weight in the region minus that in the sample; None if all are in it.

        The mean over all columns is the sample's mean plus the sum over columns with these weights.
        """
        region, columns = self.view.region, self.sample.columns
        if len(columns) >= region.columns:
            return None
        weights = np.full(region.columns, 1.0 / region.columns)
        np.subtract.at(weights, columns - region.first_column, self.sample.weights)
        inside = self.panel_mask([self.names])
        if inside is None:
            return weights
        return np.where(self.interpolate_columns(self.mean_of_rows(inside[0])) > 0.0, weights, 0.0)

    def interpolate_columns(self, sampled: FloatArray) -> FloatArray:
        """Interpolate values at the sample's columns over all columns of the region."""
        region, columns = self.view.region, self.sample.columns
        order = np.argsort(columns)
        places = np.arange(region.first_column, region.last_column)
        return np.interp(places, columns[order], sampled[order])

    def mean_of_rows(self, values: FloatArray) -> FloatArray:
        return np.asarray(np.einsum("...cn,cn->...c", values, self.sample.row_weights))

    def mean_of_columns(self, values: FloatArray) -> float:
        return float(values @ self.sample.weights)

    def stored_values(self, sets: Sequence[Names]) -> FloatArray:
        """Return the pixels' mean values, of whole levels where a set has the file."""
        values = self.values(sets)
        for included, own in zip(sets, values, strict=True):
            is_stored = any(file.name in included for file in self.files)
            is_rounded = is_stored and not self.noisy.is_drawn(included)
            if is_rounded and self.least_noise(included) < _DITHERING_NOISE:
                own += rounding_mean(own, self.table.interpolate(self.spread(included), own))
        return values

    def values_read_back(self, sets: Sequence[Names]) -> FloatArray:
        """Return the pixels' mean values, after the file where a set has it."""
        values = self.stored_values(sets)
        with_file = [
            at for at, included in enumerate(sets) if self.files and self.files[0].name in included
        ]
        if self.file is None or not with_file:
            return values
        noise = np.array([self.noise_rms(sets[at]) for at in with_file])
        values[with_file] = self.file.read_back_means(values[with_file], noise)
        return values

    def panel_mask(self, sets: Sequence[Names]) -> BoolArray | None:
        """Return which pixels of the sample show the panel; None if all do."""
        covers = [self.sample.covers[included & self.sample.outline] for included in sets]
        if all(cover is None for cover in covers):
            return None
        shape = self.sample.rows.shape
        return np.stack([np.ones(shape, bool) if c is None else c >= 0.5 for c in covers])


@lru_cache(maxsize=2)  # for a scene's picture and for its signal
def sample_pixels(view: PaperView, effects: tuple[Effect, ...]) -> SampledPixels:
    """Sample a view's pixels with some effects."""
    return SampledPixels(view, effects)
