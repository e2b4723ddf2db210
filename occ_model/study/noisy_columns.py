"""The columns of a level panel with noise: which of them a decoder sees, and their means.

All rows have the same distribution, so that nothing needs pixels: the histogram of the levels is
the sum of the columns' distributions, and a mean over rows is normal.
"""

import math
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.enhancement import Enhancement, byte_shares, share_above
from occ_model.camera.photometry import WHITE, saturate
from occ_model.effects.effect import NoiseEffect, PixelEffect
from occ_model.effects.noise_spread import NoiseSpread
from occ_model.effects.registry import planned
from occ_model.receiver.locate import bright_level, cell_size, least_bright_share
from occ_model.results import Plan, Region
from occ_model.scene.scene import Camera, Scene, Sensor
from occ_model.simulation.columns import Columns

_LEVELS = 512
"""Column values at which means are computed where there are more columns; between them linearly."""

_BINS = 128
"""Column values of which the histogram of the pixels is made."""

_NO_SPREAD = 1e-9
"""Standard deviation in grey levels below which there is no noise."""


@lru_cache(maxsize=8)
def _noise_of(effects: tuple[NoiseEffect, ...], camera: Camera, sensor: Sensor) -> NoiseSpread:
    """Return the deviation of pixels; the images of a point and the points of a line share it."""
    return NoiseSpread(effects, Scene(camera=camera, sensor=sensor))


class NoisyColumns:
    """The columns of a level panel, their pixels noisy and enhanced.

    Parameters
    ----------
    scene
        The scene.
    columns
        Its columns.
    plan
        Its noise, and its limits of a pixel's value, are simulated.
    span
        The rectangle that the panel fills.
    enhancement
        The receiver's.
    """

    def __init__(
        self, scene: Scene, columns: Columns, plan: Plan, span: Region, enhancement: Enhancement
    ) -> None:
        self._scene = scene
        self._columns = columns
        self._span = span
        self._enhancement = enhancement
        self._noise = _noise_of(planned(plan, NoiseEffect), scene.camera, scene.sensor)
        self._limits = planned(plan, PixelEffect)

    def _distribution(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return mean and standard deviation of pixels with some values before saturation."""
        spread = self._noise(values[:, None].astype(np.float32))[:, 0]
        for limit in self._limits:
            values = limit.apply(self._scene, values)
        return saturate(values), spread.astype(np.float64)

    def means(self, span: Region, random: np.random.Generator) -> FloatArray:
        """Return the means of the enhanced pixels of some columns, with their sampling error."""
        panel = self._columns.panel[span.first_column : span.last_column]
        low, high = float(panel.min()), float(panel.max())
        levels = panel if len(panel) <= _LEVELS else np.linspace(low, high, _LEVELS)
        value, spread = self._distribution(levels)
        if levels is not panel and spread.min() < (high - low) / _LEVELS:
            # Steps of the enhancement would show between the levels.
            levels = panel
            value, spread = self._distribution(levels)
        mean, deviation = self._enhancement.moments(value, spread)
        deviation /= math.sqrt(span.rows)
        if levels is not panel:
            mean, deviation = np.interp(panel, levels, mean), np.interp(panel, levels, deviation)
        return np.asarray(mean + deviation * random.standard_normal(len(panel)))

    def plain_means(self, span: Region) -> FloatArray:
        """Return the expected means of some columns' pixels before enhancement and rounding.

        Noise is cut off at black and at white, and so moves the mean of columns near them: by
        s (phi(u) - u Q(u)), u being the distance to the limit in standard deviations s, phi the
        density of the normal distribution and Q its tail.
        """
        panel = self._columns.panel[span.first_column : span.last_column]
        value, spread = self._distribution(panel)
        return value + _lost_beyond(value, spread) - _lost_beyond(WHITE - value, spread)

    def bright_span(self, random: np.random.Generator) -> slice | None:
        """Draw the columns from the first bright one to the last, as they are found in an image."""
        scene, span = self._scene, self._span
        level = bright_level(self._histogram(), scene.receiver.bright_fraction)
        if level is None:
            return None
        panel = self._columns.panel[span.first_column : span.last_column]
        value, spread = self._distribution(panel)
        brightest = int(np.searchsorted(self._enhancement.curve, level))
        bright = share_above(brightest - 0.5, value, spread)
        cell = cell_size(scene.camera.rows, scene.camera.columns)
        seen = random.random(len(panel)) < _any_of(bright, span.rows)
        columns = np.flatnonzero(seen & _near_cells(bright, cell, span, random))
        if columns.size == 0:
            return None
        return slice(span.first_column + int(columns[0]), span.first_column + int(columns[-1]) + 1)

    def _histogram(self) -> IndexArray:
        """Return the expected number of pixels of each grey level in the whole image."""
        span, rows = self._span, self._scene.camera.rows
        on_panel = self._columns.panel[span.first_column : span.last_column]
        beside = np.full(len(self._columns.panel), float(rows))
        beside[span.first_column : span.last_column] -= span.rows
        panel = self._shares(on_panel, np.full(len(on_panel), float(span.rows)))
        curve = self._enhancement.curve
        counts = np.asarray(np.bincount(curve, weights=panel, minlength=256), dtype=np.float64)
        counts += self._shares(self._columns.surroundings, beside)
        return np.rint(counts).astype(np.int64)

    def _shares(self, values: FloatArray, pixels: FloatArray) -> FloatArray:
        """Return the expected number of columns' pixels of each grey level before enhancement."""
        low, high = float(values.min()), float(values.max())
        bins = _BINS if high > low else 1
        step = (high - low) / bins or 1.0
        place = np.minimum(((values - low) / step).astype(np.int64), bins - 1)
        middles = np.asarray(low + step * (np.arange(bins) + 0.5), dtype=np.float64)
        value, spread = self._distribution(middles)
        weights = np.bincount(place, weights=pixels, minlength=bins)
        return byte_shares(value, spread, np.asarray(weights, dtype=np.float64))


def _lost_beyond(distance: FloatArray, spread: FloatArray) -> FloatArray:
    """Return the mean of what noise of some spread would reach beyond a limit at some distance."""
    deviations = distance / np.maximum(spread, _NO_SPREAD)
    density = np.exp(-0.5 * deviations**2) / math.sqrt(2.0 * math.pi)
    beyond = density - deviations * share_above(0.0, -deviations, np.ones_like(deviations))
    return np.asarray(spread * np.maximum(beyond, 0.0))


def _any_of(share: FloatArray, count: int) -> FloatArray:
    """Return the probability that any of some pixels is bright."""
    return np.asarray(-np.expm1(count * np.log1p(-np.minimum(share, 1.0 - 1e-12))))


def _near_cells(
    bright: FloatArray, cell: int, span: Region, random: np.random.Generator
) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Draw which columns lie in or beside a cell that is bright enough in any of its rows."""
    columns = len(bright)
    cells = -(-columns // cell)
    share = np.add.reduceat(bright, np.arange(0, columns, cell)) / cell
    pixels = cell * cell
    least = math.floor(least_bright_share() * pixels) + 1
    too_few = np.zeros(cells)
    for count in range(least):
        ways = math.comb(pixels, count)
        too_few += ways * share**count * (1.0 - share) ** (pixels - count)
    marked = random.random(cells) < _any_of(
        np.clip(1.0 - too_few, 0.0, 1.0), span.rows // cell or 1
    )
    if not marked.any():
        return np.ones(columns, dtype=bool)
    first, last = np.flatnonzero(marked)[[0, -1]].tolist()
    near = np.zeros(columns, dtype=bool)
    near[max(0, (first - 1) * cell) : (last + 2) * cell] = True
    return near
