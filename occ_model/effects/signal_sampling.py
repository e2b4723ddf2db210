"""How far the mean of a few enhanced pixels changes without each effect, from a sample."""

import math
from functools import cached_property

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.effects.observed import SURE_DEVIATIONS
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.smoothed_curves import SmoothedCurves


class SignalSampling:
    """The mean square deviation of a column's mean without each effect.

    The pixels are those of a file, or are not drawn.

    A pixel that changes by d crosses a step of the curve with a probability in proportion to d, as
    noise spreads the pixels of a column.
    """

    def __init__(self, pixels: SampledPixels, curves: SmoothedCurves) -> None:
        self._pixels = pixels
        self._rows = pixels.view.region.rows
        noises = pixels.names - curves.files
        self._spread = spread = pixels.spread(noises)
        greys = pixels.columns.enhancement(pixels.names).curve.astype(np.float64)
        steps = np.concatenate([[0.0], np.cumsum(np.diff(greys) ** 2)])
        curve, square, jumps = (curves.tabulate(noises, each) for each in (greys, greys**2, steps))
        self._deviation = np.sqrt(np.maximum(square - curve**2, 0.0))
        self._even = pixels.table.slope(curve) ** 2
        self._uneven = np.maximum(pixels.table.slope(jumps) - self._even, 0.0)
        inside = pixels.panel_mask([pixels.names])
        self._inside = None if inside is None else inside[0]  # beside the panel nothing is enhanced
        self._off_panel_fraction = 0.0 if inside is None else pixels.mean_of_rows(~inside[0])
        self._gain = pixels.mean_of_columns(
            self._panel_means(self._even) + self._off_panel_fraction
        )
        pixel_weight = 1.0 / (self._rows**2 * pixels.view.region.columns)
        moved = self._even + self._uneven
        self._pixel = pixels.mean_over_pixels(moved) * pixel_weight
        # One pixel with another random value of its noise.
        self._drawn = pixels.mean_over_pixels(self._even * spread**2) * pixel_weight
        self._column_squares = {
            **self._noise_squares(),
            **self._file_squares(),
            **self._change_squares(),
        }

    def _panel_means(self, table: FloatArray) -> FloatArray:
        """Return each column's mean of a table over its pixels, counted as 0 beside the panel."""
        values = self._pixels.interpolate_at_pixels(table)
        return self._pixels.mean_of_rows(values if self._inside is None else values * self._inside)

    def effect_squares(self) -> dict[str, float]:
        """Return the mean square for each effect, over the columns."""
        mean = self._pixels.mean_of_columns
        return {name: mean(squares) for name, squares in self._column_squares.items()}

    def fluctuations(self) -> dict[str, float]:
        """Return how far the mean square over one picture's columns may exceed each of these.

        The mean square of n numbers of variance v and fourth cumulant k has the standard deviation
        sqrt((2 v^2 + k) / n). Here k is that of a few pixels that cross large steps.
        """
        pixels, region = self._pixels, self._pixels.view.region
        mean, n = pixels.mean_of_columns, region.columns
        doubts = {
            name: SURE_DEVIATIONS * math.sqrt(2.0 * mean(v**2) / n + mean(v) * self._pixel)
            for name, v in self._column_squares.items()
        }
        for name in pixels.moving if pixels.files else ():  # a file spreads what drawing moves
            few = pixels.drawn_changes[name].relative_doubt(region.rows * n)
            doubts[name] += mean(self._column_squares[name]) * few
        return doubts

    def _square_of_mean(self, square: FloatArray, of_means: float) -> FloatArray:
        """Return the mean square of a column's mean, from that of its pixels."""
        return square / self._rows + of_means * self._gain

    def _noise_squares(self) -> dict[str, FloatArray]:
        pixels, total = self._pixels, self._spread**2
        squares = {}
        for name, variance in pixels.variances.items():
            square_read_back, of_means = pixels.noise_read_back.get(name, (0.0, 0.0))
            deviation = np.maximum(np.sqrt(variance), math.sqrt(square_read_back))
            known_square = self._even * total if pixels.files else 0.0  # the file already rounds it
            largest = np.maximum(self._deviation**2 - known_square, 0.0)
            flips = np.tanh(4.8 * deviation) / 6.0
            part = self._even * flips + self._uneven * 0.8 * deviation
            if not pixels.files:
                part = part + self._even * deviation**2
            part = np.where(deviation**2 > 0.7 * total, largest, np.minimum(part, largest))
            square = self._panel_means(part)
            if self._inside is not None and not pixels.files:
                square = square + pixels.mean_of_rows(
                    pixels.interpolate_at_pixels(deviation**2) * ~self._inside
                )
            squares[name] = self._square_of_mean(square, of_means) + self._drawn
        return squares

    def _file_squares(self) -> dict[str, FloatArray]:
        file = self._pixels.file
        if file is None:
            return {}
        return {
            self._pixels.files[0].name: self._square_of_mean(
                self._rounding_square, file.own_sampling_square()
            )
        }

    @cached_property
    def _rounding_square(self) -> FloatArray:
        """The mean square change of an enhanced pixel by JPEG's rounding."""
        file = self._pixels.file
        change = 0.0 if file is None else min(math.sqrt(file.own_change), 1.0)
        part = self._even / 6.0 + self._uneven * 0.8 * change
        return self._panel_means(part) + self._off_panel_fraction / 6.0

    @property
    def doubt_of_file(self) -> float:
        """Possible excess of the file's mean square, as it rounds the rows of a block alike."""
        return 7.0 * self._pixels.mean_of_columns(self._rounding_square) / self._rows

    def _change_squares(self) -> dict[str, FloatArray]:
        """Return the mean squares for effects on the pixels' means."""
        pixels = self._pixels
        changes = np.abs(pixels.stack[1:] - pixels.complete_values)
        of_means: FloatArray = np.zeros(len(changes))
        by_file = np.zeros((len(changes), 1, 1))  # Acts like noise, even if large
        if pixels.file is not None:
            added, of_means, _ = (of_sets[1:] for of_sets in pixels.file.growth)
            by_file = np.maximum(added, 0.0)[:, None, None]
            changes = np.sqrt(changes**2 + by_file)
        even, uneven = map(pixels.interpolate_at_pixels, (self._even, self._uneven))
        np.minimum(changes, 0.5, out=changes)
        flips = changes * (1.0 - changes)
        if self._inside is not None:
            even, uneven = np.where(self._inside, even, 1.0), uneven * self._inside
        crossings = np.maximum(changes, 0.8 * np.sqrt(by_file))
        squares = pixels.mean_of_rows(even * (flips + by_file) + uneven * crossings)
        return {
            name: self._square_of_mean(square, own)
            for name, square, own in zip(pixels.moving, squares, of_means.tolist(), strict=True)
        }
