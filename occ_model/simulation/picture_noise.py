"""The noise of a picture's pixels: their gains, and their grey levels, drawn by bands of rows."""

from collections.abc import Callable

import numpy as np

from occ_model.arrays import ByteArray, Pixels
from occ_model.camera.grey_law import law_of_known_gains
from occ_model.camera.picture_rows import Rows
from occ_model.camera.pixel_noise import PixelNoise
from occ_model.camera.row_interpolation import find_smooth_columns
from occ_model.effects.sensor_effects import FixedPattern, SensorNoise
from occ_model.scene.scene import Scene
from occ_model.simulation.grey_table import grey_table, make_scratch
from occ_model.simulation.pixel_draw import GainPattern, PictureNumbers, dither

_TOLERANCE = 0.05  # of a level; shot noise has a deviation of 16 levels, the dither spans 1

_CHUNK = 32  # rows drawn at once: their arrays stay in the cache, and threads hardly wait


class PictureNoise:
    """Draws the pixels of some rows from their mean values; any thread may draw any rows."""

    def __init__(
        self, noise: PixelNoise, scene: Scene, brightest: float, numbers: PictureNumbers
    ) -> None:
        """Prepare for mean values up to a brightest one."""
        self.is_drawn = noise.is_drawn
        self._numbers = numbers
        self._columns = scene.camera.columns
        variation = noise.gain_variation
        power = 1.0 / noise.gamma
        if self.is_drawn:
            self._law = law_of_known_gains(noise, brightest)
            self._table = grey_table(self._law)
            power *= self._law.power
        size = (scene.camera.rows, scene.camera.columns)
        seed = scene.sensor.sensor_seed
        self._pattern = GainPattern(variation, power, seed, size) if variation > 0.0 else None

    def draw(self, mean: Rows, out: ByteArray, end_stage: Callable[[str], object]) -> None:
        """Draw the grey levels of some rows; ``end_stage`` is called with each stage's name."""
        levels = mean.change_nodes(self._law.levels_of)  # the table's levels, not grey levels
        if levels.weights is not None and not find_smooth_columns(levels.nodes, _TOLERANCE).all():
            levels = mean.expand_rows().change_nodes(self._law.levels_of)
        levels = self._scale(levels)
        numbers = self._numbers.of(mean.rows, _CHUNK)
        shape = (min(_CHUNK, len(mean.rows)), self._columns)
        scratch, buffer = make_scratch(shape), np.empty(shape, dtype=np.float32)
        for start in range(0, len(mean.rows), _CHUNK):
            part = slice(start, min(start + _CHUNK, len(mean.rows)))
            drawn = buffer[: part.stop - start]
            self._vary(levels, part, drawn)
            drawn += dither(mean.rows[part], self._columns)
            if self._law.is_whole:
                np.minimum(drawn, np.float32(self._law.last), out=drawn)
            end_stage(FixedPattern.name)
            self._table.draw(drawn, next(numbers), out[part], scratch)
            end_stage(SensorNoise.name)

    def vary(self, mean: Rows, end_stage: Callable[[str], object]) -> Pixels:
        """Return the values of some rows of pixels with their gains, shape (rows, columns)."""
        varied = np.empty((len(mean.rows), self._columns), dtype=np.float32)
        self._vary(self._scale(mean.expand_rows()), slice(0, len(varied)), varied)
        end_stage(FixedPattern.name)
        return varied

    def _scale(self, values: Rows) -> Rows:
        """Multiply values, or levels, by the step in which the pattern counts gains."""
        pattern = self._pattern
        return values if pattern is None else values.change_nodes(lambda own: own * pattern.step)

    def _vary(self, values: Rows, part: slice, out: Pixels) -> None:
        """Multiply scaled values in a part of the rows by the pixels' gains."""
        for columns, own in values.columns_of(part):
            if self._pattern is None:
                out[:, columns] = own
            else:
                self._pattern.vary(values.rows[part], own, out[:, columns], columns)
