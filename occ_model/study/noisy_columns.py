"""The columns of a level panel with noise: which of them a decoder sees, and their means.

All rows have the same distribution, so that nothing needs pixels: the histogram of the levels is
the sum of the columns' distributions, and a mean over rows is normal.
"""

import math
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import Enhancement, byte_fractions, fraction_above
from occ_model.camera.photometry import WHITE, saturate
from occ_model.effects.effect import NoiseEffect, PixelEffect
from occ_model.effects.registry import effects_planned
from occ_model.receiver.signal import bright_level
from occ_model.results.decoding import Region
from occ_model.results.frame import Plan
from occ_model.scene.scene import Camera, Scene, Sensor
from occ_model.simulation.columns import Columns
from occ_model.simulation.noise import NoiseSpread
from occ_model.study.drawn_region import BrightFractions

_LEVELS = 512  # column values at which means are computed where there are more; linear between
_BINS = 128  # column values of which the histogram of the pixels is made
_NO_SPREAD = 1e-9  # standard deviation in grey levels below which there is no noise


@lru_cache(maxsize=8)
def _noise_of(effects: tuple[NoiseEffect, ...], camera: Camera, sensor: Sensor) -> NoiseSpread:
    """Return the deviation of pixels, cached for the images of a point and the points of a line."""
    return NoiseSpread(effects, Scene(camera=camera, sensor=sensor))


class NoisyColumns:
    """The columns of a level panel, with noise and enhancement by a plan."""

    def __init__(
        self, scene: Scene, columns: Columns, plan: Plan, span: Region, enhancement: Enhancement
    ) -> None:
        self._scene = scene
        self._columns = columns
        self._span = span
        self._enhancement = enhancement
        self._noise = _noise_of(effects_planned(plan, NoiseEffect), scene.camera, scene.sensor)
        self._limits = effects_planned(plan, PixelEffect)

    def _distribution(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return mean and standard deviation of pixels with some values before saturation."""
        spread = self._noise(values[:, None].astype(np.float32))[:, 0]
        for limit in self._limits:
            values = limit.apply(self._scene, values)
        return saturate(values), spread.astype(np.float64)

    def means(self, region: Region, random: np.random.Generator) -> FloatArray:
        """Return the means of a rectangle's columns with their sampling error."""
        span = self._span
        crossed = min(region.last_row, span.last_row) - max(region.first_row, span.first_row)
        first = max(region.first_column, span.first_column)
        last = min(region.last_column, span.last_column)
        if crossed == region.rows and last - first == region.columns:
            mean, deviation = self._on_panel(slice(first, last))
            variance = deviation**2
        else:
            mean, deviation = self._beside(slice(region.first_column, region.last_column))
            variance = deviation**2
            if crossed > 0 and last > first:
                panel, deviation = self._on_panel(slice(first, last))
                seen = slice(first - region.first_column, last - region.first_column)
                fraction = crossed / region.rows
                mean[seen] = fraction * panel + (1.0 - fraction) * mean[seen]
                variance[seen] = fraction * deviation**2 + (1.0 - fraction) * variance[seen]
        spread = np.sqrt(variance / region.rows)
        return np.asarray(mean + spread * random.standard_normal(len(mean)))

    def _on_panel(self, columns: slice) -> tuple[FloatArray, FloatArray]:
        """Return mean and standard deviation of the panel's enhanced pixels in some columns."""
        panel = self._columns.panel[columns]
        low, high = float(panel.min()), float(panel.max())
        levels = panel if len(panel) <= _LEVELS else np.linspace(low, high, _LEVELS)
        value, spread = self._distribution(levels)
        if levels is not panel and spread.min() < (high - low) / _LEVELS:
            # Steps of the enhancement would show between the levels.
            levels = panel
            value, spread = self._distribution(levels)
        mean, deviation = self._enhancement.moments(value, spread)
        if levels is not panel:
            return np.interp(panel, levels, mean), np.interp(panel, levels, deviation)
        return mean, deviation

    def _beside(self, columns: slice) -> tuple[FloatArray, FloatArray]:
        """Return mean and standard deviation of pixels beside the panel in some columns."""
        values = self._columns.surroundings[columns]
        # All equal where the surroundings do not flicker.
        levels = values[:1] if np.ptp(values) == 0.0 else values
        plain = Enhancement(levels, "none")
        mean, deviation = plain.moments(*self._distribution(levels))
        return mean + np.zeros(len(values)), deviation + np.zeros(len(values))

    def plain_means(self, span: Region) -> FloatArray:
        """Return the expected means of some columns' pixels before enhancement and rounding.

        Noise is cut off at black and at white, and so moves the mean of columns near them: by s
        (phi(u) - u Q(u)), u being the distance to the limit in standard deviations s, phi the
        density of the normal distribution and Q its tail.
        """
        panel = self._columns.panel[span.first_column : span.last_column]
        value, spread = self._distribution(panel)
        return value + _lost_beyond(value, spread) - _lost_beyond(WHITE - value, spread)

    def draw_region(self, random: np.random.Generator) -> Region:
        """Draw the rectangle that a receiver finds; all that the panel fills in an even picture."""
        scene, span = self._scene, self._span
        counts = random.poisson(self._histogram())
        level = bright_level(counts, scene.receiver.bright_fraction)
        if level is None:
            return span
        panel, around = (
            fraction_above(limit - 0.5, *self._distribution(values))
            for limit, values in (
                (int(np.searchsorted(self._enhancement.curve, level)), self._columns.panel),
                (level, self._columns.surroundings),
            )
        )
        return BrightFractions(scene.camera.rows, span, panel, around).draw_region(random)

    def _histogram(self) -> FloatArray:
        """Return the expected number of pixels of each grey level in the whole image."""
        span, rows = self._span, self._scene.camera.rows
        on_panel = self._columns.panel[span.first_column : span.last_column]
        beside = np.full(len(self._columns.panel), float(rows))
        beside[span.first_column : span.last_column] -= span.rows
        panel = self._fractions(on_panel, np.full(len(on_panel), float(span.rows)))
        curve = self._enhancement.curve
        counts = np.asarray(np.bincount(curve, weights=panel, minlength=256), dtype=np.float64)
        counts += self._fractions(self._columns.surroundings, beside)
        return np.maximum(counts, 0.0)

    def _fractions(self, values: FloatArray, pixels: FloatArray) -> FloatArray:
        """Return the expected number of columns' pixels of each grey level before enhancement."""
        low, high = float(values.min()), float(values.max())
        bins = _BINS if high > low else 1
        step = (high - low) / bins or 1.0
        place = np.minimum(((values - low) / step).astype(np.int64), bins - 1)
        middles = np.asarray(low + step * (np.arange(bins) + 0.5), dtype=np.float64)
        value, spread = self._distribution(middles)
        weights = np.bincount(place, weights=pixels, minlength=bins)
        return byte_fractions(value, spread, np.asarray(weights, dtype=np.float64))


def _lost_beyond(distance: FloatArray, spread: FloatArray) -> FloatArray:
    """Return the mean of what noise of some spread would reach beyond a limit at some distance."""
    deviations = distance / np.maximum(spread, _NO_SPREAD)
    density = np.exp(-0.5 * deviations**2) / math.sqrt(2.0 * math.pi)
    beyond = density - deviations * fraction_above(0.0, -deviations, np.ones_like(deviations))
    return np.asarray(spread * np.maximum(beyond, 0.0))
