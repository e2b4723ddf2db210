"""The columns of a level panel with noise: which of them a decoder sees, and their means.

All rows have the same distribution, so that nothing needs pixels: the histogram of the levels is
the sum of the columns' distributions, and a mean over rows is normal.
"""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.grey_law import GreyLaw
from occ_model.receiver.signal import bright_level
from occ_model.results.decoding import Region
from occ_model.scene.scene import Scene
from occ_model.simulation.columns import Columns
from occ_model.study.drawn_region import BrightFractions

_GREYS: FloatArray = np.arange(256.0)


class NoisyColumns:
    """The columns of a level panel, with the noise and the enhancement of a picture."""

    def __init__(self, scene: Scene, columns: Columns, law: GreyLaw, span: Region) -> None:
        self._scene = scene
        self._columns = columns
        self._span = span
        self._law = law
        self._curve = columns.enhancement.curve.astype(np.float64)

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
            seen = slice(region.first_column, region.last_column)
            mean, deviation = self._law.moments(self._columns.surroundings[seen], _GREYS)
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
        return self._law.moments(self._columns.panel[columns], self._curve)

    def plain_means(self, span: Region) -> FloatArray:
        """Return the expected means of some columns' pixels before enhancement."""
        panel = self._columns.panel[span.first_column : span.last_column]
        return self._law.mean(panel, _GREYS)

    def draw_region(self, random: np.random.Generator) -> Region:
        """Draw the rectangle that a receiver finds; all that the panel fills in an even picture."""
        scene, span, columns = self._scene, self._span, self._columns
        counts = random.poisson(self._histogram())
        level = bright_level(counts, scene.receiver.bright_fraction)
        if level is None:
            return span
        before = int(np.searchsorted(columns.enhancement.curve, level))
        panel = 1.0 - self._law.fraction_below(before, columns.panel)
        around = 1.0 - self._law.fraction_below(level, columns.surroundings)
        return BrightFractions(scene.camera.rows, span, panel, around).draw_region(random)

    def _histogram(self) -> FloatArray:
        """Return the expected number of pixels of each grey level in the whole image."""
        span, columns = self._span, self._columns
        on_panel = columns.panel[span.first_column : span.last_column]
        beside = np.full(len(columns.panel), float(self._scene.camera.rows))
        beside[span.first_column : span.last_column] -= span.rows
        panel = self._law.histogram(on_panel, np.full(len(on_panel), float(span.rows)))
        curve = columns.enhancement.curve
        counts = np.asarray(np.bincount(curve, weights=panel, minlength=256), dtype=np.float64)
        counts += self._law.histogram(columns.surroundings, beside)
        return counts
