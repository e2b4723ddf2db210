"""What the mean of few enhanced pixels deviates by, for each effect, estimated from a sample."""

import math
from functools import cached_property

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.smoothed_curves import SmoothedCurves

SURE_DEVIATIONS = 3.5
"""Standard deviations by which the mean square of few columns may exceed its expectation."""


class SignalSampling:
    """The mean square of what a column's mean deviates by where an effect is left out.

    A pixel that moves by d passes the curve's steps in proportion to d, which noise spreads
    over the rows. Where the steps are even, a change of a whole step passes no more than one.
    """

    def __init__(self, pixels: SampledPixels, curves: SmoothedCurves) -> None:
        self._pixels = pixels
        self._rows = pixels.view.region.rows
        noise = curves.noise(pixels.names - curves.files)
        self._spread = spread = noise.spread
        curve, self._deviation, jumps = pixels.columns.enhancement(pixels.names).smoothed(
            noise.passed
        )
        self._even = pixels.table.slope(curve) ** 2
        self._uneven = np.maximum(pixels.table.slope(jumps) - self._even, 0.0)
        inside = pixels.inside([pixels.names])
        self._inside = None if inside is None else inside[0]  # beside the panel nothing is enhanced
        self._off_panel_fraction = 0.0 if inside is None else pixels.mean_of_rows(~inside[0])
        self._gain = pixels.mean_of_columns(self._of_panel(self._even) + self._off_panel_fraction)
        one = 1.0 / (self._rows**2 * pixels.view.region.columns)
        self._pixel = pixels.mean_at_whole(self._even + self._uneven) * one
        # One pixel whose noise is drawn otherwise.
        self._drawn = pixels.mean_at_whole(self._even * spread**2) * one
        self._of_columns = {**self._of_noise(), **self._of_file(), **self._of_changes()}

    def _of_panel(self, table: FloatArray) -> FloatArray:
        """Return the mean of a table over the rows, as if it were 0 beside the panel."""
        found = self._pixels.at_whole(table)
        return self._pixels.mean_of_rows(found if self._inside is None else found * self._inside)

    def of_effects(self) -> dict[str, float]:
        """Return the mean square for each effect."""
        mean = self._pixels.mean_of_columns
        return {name: mean(squares) for name, squares in self._of_columns.items()}

    def fluctuations(self) -> dict[str, float]:
        """Return the possible excess of each mean square in the columns of one picture.

        The mean square of n numbers of the variance v deviates by the root of (2 v^2 + k) / n. The
        fourth cumulant k is that of few pixels that pass large steps.
        """
        mean, n = self._pixels.mean_of_columns, self._pixels.view.region.columns
        return {
            name: SURE_DEVIATIONS * math.sqrt(2.0 * mean(v**2) / n + mean(v) * self._pixel)
            for name, v in self._of_columns.items()
        }

    def _of_mean(self, square: FloatArray, of_means: float) -> FloatArray:
        """Return the mean square of a mean, from that of its pixels and the known one of means."""
        return square / self._rows + of_means * self._gain

    def _of_noise(self) -> dict[str, FloatArray]:
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
                square = square + pixels.mean_of_rows(pixels.at_whole(own**2) * ~self._inside)
            found[name] = self._of_mean(square, of_means) + self._drawn
        return found

    def _of_file(self) -> dict[str, FloatArray]:
        file = self._pixels.file
        if file is None:
            return {}
        return {self._pixels.files[0].name: self._of_mean(self._rounded, file.own_sampling())}

    @cached_property
    def _rounded(self) -> FloatArray:
        """The mean square of what a file's rounding changes in an enhanced pixel."""
        file = self._pixels.file
        moved = 0.0 if file is None else min(math.sqrt(file.own_change), 1.0)
        part = self._even / 6.0 + self._uneven * 0.8 * moved
        return self._of_panel(part) + self._off_panel_fraction / 6.0

    @property
    def doubt_of_file(self) -> float:
        """Possible excess of the file's mean square: it rounds the rows of a block equally."""
        return 7.0 * self._pixels.mean_of_columns(self._rounded) / self._rows

    def _of_changes(self) -> dict[str, FloatArray]:
        """Return the mean squares of effects on the pixels' means."""
        pixels = self._pixels
        changes = np.abs(pixels.stack[1:] - pixels.whole)
        of_means: FloatArray = np.zeros(len(changes))
        by_file = np.zeros((len(changes), 1, 1))  # Like noise, also where it is no small one
        if pixels.file is not None:
            added, of_means, _ = (of_sets[1:] for of_sets in pixels.file.added)
            by_file = np.maximum(added, 0.0)[:, None, None]
            changes = np.sqrt(changes**2 + by_file)
        np.minimum(changes, 0.5, out=changes)
        even, uneven = pixels.at_whole(self._even), pixels.at_whole(self._uneven)
        if self._inside is not None:
            even, uneven = np.where(self._inside, even, 1.0), uneven * self._inside
        passed = np.maximum(changes, 0.8 * np.sqrt(by_file))
        squares = pixels.mean_of_rows(
            even * (changes * (1.0 - changes) + by_file) + uneven * passed
        )
        return {
            name: self._of_mean(square, own)
            for name, square, own in zip(pixels.moving, squares, of_means.tolist(), strict=True)
        }
