"""What the mean of few enhanced pixels deviates by, for each effect, estimated from a sample."""

import math
from functools import cached_property

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import PassedSteps
from occ_model.camera.photometry import WHITE
from occ_model.effects.sampled_pixels import SampledPixels

_FLUCTUATION = 4.0
"""Standard deviations by which few pixels that are rounded otherwise may exceed their mean."""


class SignalSampling:
    """The mean square of what a column's mean deviates by where an effect is left out.

    A pixel that moves by d passes the curve's steps in proportion to d, which noise spreads
    over the rows. Where the steps are even, a change of a whole step passes no more than one.
    """

    def __init__(self, pixels: SampledPixels) -> None:
        self._pixels = pixels
        self._rows = pixels.view.region.rows
        self._spread = spread = pixels.spread(pixels.names)
        passed = PassedSteps.of(np.clip(pixels.levels, 0.0, WHITE), spread)
        curve, self._deviation, jumps = pixels.enhancement(pixels.names).smoothed(passed)
        self._even = pixels.slope(curve) ** 2
        self._uneven = np.maximum(pixels.slope(jumps) - self._even, 0.0)
        inside = pixels.inside([pixels.names])
        self._inside = None if inside is None else inside[0]  # beside the panel nothing is enhanced
        self._beside = 0.0 if inside is None else float(pixels.mean_of(~inside[0]))
        self._gain = self._of_panel(self._even) + self._beside
        one = 1.0 / (self._rows**2 * pixels.view.region.columns)
        self._pixel = float(pixels.mean_at_whole(self._even + self._uneven)) * one
        # One pixel whose noise is drawn otherwise.
        self._drawn = float(pixels.mean_at_whole(self._even * spread**2)) * one

    def _of_panel(self, table: FloatArray) -> float:
        """Return the mean of a table over all pixels, as if it were 0 beside the panel."""
        return float(self._pixels.mean_at_whole(table, self._inside))

    def of_effects(self) -> dict[str, float]:
        """Return it for each effect, by name."""
        return {**self._of_noise, **self._of_file(), **self._of_changes}

    def fluctuations(self) -> dict[str, float]:
        """Return by how much it may be larger for effects that move few pixels, by name."""
        total = 0.25 * float((self._spread**2).max())
        few = {n: v for n, v in self._of_noise.items() if self._variance_of(n) < total}
        found = {**few, **self._of_changes}
        return {n: _FLUCTUATION * math.sqrt(v * self._pixel) for n, v in found.items()}

    def _variance_of(self, name: str) -> float:
        return float(self._pixels.variances[name].max())

    def _of_mean(self, square: float, of_means: float) -> float:
        """Return that of a mean: of its pixels' deviations, and what is known of means."""
        return square / self._rows + of_means * self._gain

    @cached_property
    def _of_noise(self) -> dict[str, float]:
        pixels, total = self._pixels, self._spread**2
        found = {}
        for name, variance in pixels.variances.items():
            read, of_means = pixels.noise_read_back.get(name, (0.0, 0.0))
            own = np.maximum(np.sqrt(variance), math.sqrt(read))
            known = self._even * total if pixels.files else 0.0  # the file has rounded it already
            most = np.maximum(self._deviation**2 - known, 0.0)
            part = self._even * np.tanh(4.8 * own) / 6.0 + self._uneven * 0.8 * own
            if not pixels.files:
                part = part + self._even * own**2
            part = np.where(own**2 > 0.7 * total, most, np.minimum(part, most))
            square = self._of_panel(part)
            if self._inside is not None and not pixels.files:
                square += float(pixels.mean_at_whole(own**2, ~self._inside))
            found[name] = self._of_mean(square, of_means) + self._drawn
        return found

    def _of_file(self) -> dict[str, float]:
        file = self._pixels.file
        if file is None:
            return {}
        found = self._of_mean(self._rounded, file.own_sampling())
        return {self._pixels.files[0].name: found}

    @cached_property
    def _rounded(self) -> float:
        """The mean square of what a file's rounding changes in an enhanced pixel."""
        file = self._pixels.file
        moved = 0.0 if file is None else min(math.sqrt(file.own_change), 1.0)
        part = self._even / 6.0 + self._uneven * 0.8 * moved
        return self._of_panel(part) + self._beside / 6.0

    @property
    def doubt_of_file(self) -> float:
        """How much more that of a file may be, whose rounding is alike in the rows of a block."""
        return 7.0 * self._rounded / self._rows if self._pixels.files else 0.0

    @cached_property
    def _of_changes(self) -> dict[str, float]:
        """Return it for effects that move the pixels' means."""
        pixels = self._pixels
        changes = np.abs(pixels.stack[1:] - pixels.whole)
        of_means: FloatArray = np.zeros(len(changes))
        if pixels.file is not None:
            added, of_means, _ = (of_sets[1:] for of_sets in pixels.file.added)
            changes = np.sqrt(changes**2 + np.maximum(added, 0.0)[:, None, None])
        np.minimum(changes, 0.5, out=changes)
        even, uneven = pixels.at_whole(self._even), pixels.at_whole(self._uneven)
        if self._inside is not None:
            even, uneven = np.where(self._inside, even, 1.0), uneven * self._inside
        squares = pixels.mean_of(changes * (even * (1.0 - changes) + uneven)).tolist()
        return {
            name: self._of_mean(square, own)
            for name, square, own in zip(pixels.moving, squares, of_means.tolist(), strict=True)
        }
