"""What a file that rounds cosine coefficients does to pixels, to noise and to changes."""

import math
from functools import cached_property, lru_cache

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.effects.normal_noise import (
    DAMPING,
    SHARP_NOISE,
    density_at_boundaries,
    rounding_growth,
    rounding_growth_by_noise,
    rounding_mean,
    rounding_square,
    square_of_rounded_noise,
    variance_after_rounding,
)
from occ_model.effects.rims import Rims
from occ_model.effects.sample import PixelSample


@lru_cache(maxsize=1)
def cosine_transform() -> FloatArray:
    """Return the matrix of the orthonormal cosine transform of eight values."""
    return np.asarray(cv2.dct(np.eye(8), flags=cv2.DCT_ROWS).T, dtype=np.float64)


_EDGE_SPECTRUM: FloatArray = 8.0 / math.pi / np.maximum(np.arange(8.0), 1.0)
"""Approximate coefficients of an edge of one grey level in a block."""

_NOISES: FloatArray = np.linspace(0.0, 16.0, 129) ** 2
"""Standard deviations of noise, in grey levels, for which the noise after the file is tabulated."""

_TINY = 1e-30

_LEAST_SPREAD = 1e-3
"""Noise in steps so small that a coefficient stays on one side of a rounding boundary."""

_DITHERING_NOISE = 0.25
"""Noise in steps above which a coefficient is spread evenly over the steps (dithered)."""

_ROUNDING_VARIANCE = 1.0 / 12.0  # mean square error of rounding to whole grey levels


@lru_cache(maxsize=4)
def _tabulate_spread_read_back(steps: bytes) -> FloatArray:
    """Tabulate the standard deviation of noise after storage in the file."""
    step, q = np.split(np.frombuffer(steps), [8])
    noise = np.sqrt(_NOISES**2 + _ROUNDING_VARIANCE)[:, None]
    s = noise / step
    along = step**2 * (s * s + 1.0 / 12.0) * -np.expm1(-((s / 0.3) ** 2))
    return np.asarray(
        np.sqrt((along.sum(axis=1) + square_of_rounded_noise(noise / q) @ q**2) / 64.0)
    )


class FileChange:
    """How a file changes a sample's pixels, with all effects and without some.

    The file rounds to ``steps``, (8, 8). ``stack``, (sets, columns, nodes), holds the pixels,
    ``around`` those beside the panel, and ``spread`` is the RMS of their noise. ``moved``, (2,
    sets), holds what drawing whole levels adds to the change of each set's pixels: the mean over
    the pixels of each one's mean square, and of the square of that.
    """

    def __init__(
        self,
        steps: FloatArray,
        sample: PixelSample,
        stack: FloatArray,
        spread: float,
        rims: Rims,
        *,
        around: FloatArray,
        moved: FloatArray,
    ) -> None:
        self._blocks, self._inner = sample.blocks, sample.inner
        self._step = steps[0][:, None]
        self._others = steps[1:].ravel()
        self._all = steps.ravel()
        # Saturated pixels all round alike, which does not act as noise.
        inner = stack[0][:, sample.inner]
        full = float(inner.max())
        fraction = float((inner == full).mean())
        rounding = _ROUNDING_VARIANCE * (1.0 - fraction)
        self._noise = math.sqrt(spread**2 + rounding)
        self._rounding = rounding + fraction * (full - round(full)) ** 2
        self._s = self._noise / self._step
        self.block_rows = max(rims.rows / 8.0, 1.0)
        self._rims = rims.fraction
        self._filled = math.sqrt(rims.rows / (8.0 * rims.blocks))
        self._cut = rims.cut_variance / rims.rows**2
        self._inside = (
            self._blocks_between_rims(stack) if len(self._blocks) else stack[:, None, None]
        )
        self._moved = moved
        self._x = self._coefficients(self._inside)
        seen = np.append(stack[0], around)
        along = self._spectrum_along(float(seen.min()), rims.is_upright)
        edge = np.ptp(seen) * np.outer(_EDGE_SPECTRUM, along)
        self._of_rims = np.hypot(self._noise, edge).ravel() / self._all
        self._density_at_rims = density_at_boundaries(self._of_rims)
        self._rim_weights = self._all**2 * self._density_at_rims / 64.0
        self._along = np.tile(along * math.sqrt(8.0), 8) / self._all
        self._white = 1.0 / self._all

    def _blocks_between_rims(self, values: FloatArray) -> FloatArray:
        """Return the pixels between the rims by blocks, shape (sets, blocks, 8, nodes)."""
        return values[:, :, self._inner][:, self._blocks]

    def _coefficients(self, blocks: FloatArray) -> FloatArray:
        """Return the coefficients of vertical frequency 0, in steps: (sets, blocks, 8, nodes)."""
        if not len(self._blocks):
            return np.zeros((len(blocks), 1, 8, 1))
        coefficients = np.matmul(cosine_transform() * math.sqrt(8.0), blocks)
        coefficients[:, :, 0] -= 1024.0
        coefficients /= self._step
        return np.asarray(coefficients)

    def read_back_means(self, values: FloatArray, spread: FloatArray) -> FloatArray:
        """Replace pixels' mean values, (sets, columns, nodes), by those after the file.

        ``spread`` is the noise of each of the sets.
        """
        if not len(self._blocks):
            return values
        x = self._coefficients(self._blocks_between_rims(values))
        middle = x.mean(axis=3, keepdims=True)
        variance = np.square(x - middle).mean(axis=3, keepdims=True)
        noise = (spread * spread + _ROUNDING_VARIANCE)[:, None, None, None]
        spreads = np.sqrt(noise / self._step**2 + variance)
        shift = rounding_mean(middle, spreads) * (self._step / math.sqrt(8.0))
        change = np.matmul(cosine_transform().T, shift)
        values[:, self._blocks.ravel()] += change.reshape(len(values), -1, 1)
        return values

    @cached_property
    def own_change(self) -> float:
        """Mean square change of a pixel by the file itself."""
        rims = self._rims
        along = (rounding_square(self._x[0], self._s) * self._step**2).sum(axis=1)
        noise = self._noise / self._others
        others = (self._others**2 * rounding_square(np.zeros(1), noise)).sum()
        inner = float(along.mean() + others) / 64.0
        return (1.0 - rims) * inner + rims * self._rounding_at_edges + self._rounding

    @property
    def _rounding_at_edges(self) -> float:
        """Mean square of the rounding in blocks at a rim."""
        return float((self._all**2 * np.minimum(self._of_rims**2, 1.0 / 12.0)).mean())

    def own_sampling_square(self) -> float:
        """Return the mean square that the rounding leaves in a column's mean."""
        square = self._step**2 * np.minimum(1.0, (self._s / _DITHERING_NOISE) ** 2) / 12.0
        return float(square.sum()) / 64.0 / self.block_rows + self._cut * self._rounding_at_edges

    @cached_property
    def growth(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """What rounding adds to the mean square of a change, for each of the sets.

        A change by a fraction of a level moves some pixels to another level, which changes all
        coefficients as noise does. The three arrays are the addition to the pixels; the addition to
        a column's mean by what differs between blocks; and the largest further addition to the
        pixels if other coefficients differ a little from the sampled ones.
        """
        changes = (self._inside - self._inside[0]).reshape(len(self._inside), -1)
        moved, squares = self._moved
        # The fraction of the pixels that may move, and by how much they do.
        part = moved**2 / np.maximum(squares, _TINY)
        flips = np.sqrt(squares / np.maximum(moved, _TINY))
        size = np.sqrt((changes**2).mean(axis=1))
        read_back = self._x + rounding_mean(self._x, self._s)
        shift = read_back - read_back[0]
        by_noise = rounding_growth_by_noise(flips[:, None, None] / self._step)
        by_noise = (part[:, None, None] * by_noise)[:, None]
        of_shift = rounding_growth(shift)

        def grow(least: float) -> FloatArray:
            density = self._density_at_boundaries(least)
            return self._square_in_pixels(np.maximum(of_shift, by_noise * density))

        varying, extra = grow(_LEAST_SPREAD), np.zeros(len(moved))
        if float(self._s.min()) < SHARP_NOISE:
            extra = grow(SHARP_NOISE) - varying
        along = self._square_in_pixels(shift**2 - (self._x - self._x[0]) ** 2) + varying
        q = self._others
        density = q**2 * density_at_boundaries(self._noise / q)
        across = part * (rounding_growth_by_noise(flips[:, None] / q) @ density)
        rims = self._growth_at_rims(np.hypot(size, np.sqrt(moved)) * self._filled, self._white)
        image = (1.0 - self._rims) * (along + across / 64.0) + self._rims * rims + moved
        return image, (varying + moved / 8.0) / self.block_rows + self._cut * rims, extra

    def _square_in_pixels(self, squares: FloatArray) -> FloatArray:
        """Return the mean square over the pixels of the squares of coefficients, shape (sets,)."""
        _, blocks, _, nodes = squares.shape
        step = self._step[:, 0] ** 2 / (64.0 * blocks * nodes)
        return np.asarray(np.einsum("sbfn,f->s", squares, step))

    def _density_at_boundaries(self, least: float) -> FloatArray:
        """Return the density of the coefficients at rounding boundaries, at most 1."""
        distance = np.abs(self._x[0] - np.rint(self._x[0]))
        spread = np.maximum(self._s, least)
        density = np.exp(-0.5 * ((0.5 - distance) / spread) ** 2) / (
            math.sqrt(2.0 * math.pi) * spread
        )
        return np.asarray(np.minimum(density, 1.0))

    def _growth_at_rims(self, size: FloatArray, spectrum: FloatArray) -> FloatArray:
        """Return what rounding adds to changes of some RMS in blocks at a rim.

        ``spectrum`` is the relative amplitude of each coefficient, in steps.
        """
        return np.asarray(rounding_growth_by_noise(size[..., None] * spectrum) @ self._rim_weights)

    def _spectrum_along(self, dark: float, is_upright: bool) -> FloatArray:
        """Return the relative amplitude of each horizontal frequency in a row of the panel.

        Blocks at a horizontal rim have the frequencies of the stripes; any other rim adds its own.
        """
        values = self._x[0] * self._step
        values[:, 0] += 1024.0 - 8.0 * dark
        squares = (values**2).mean(axis=(0, 2))
        if not is_upright:
            squares = np.maximum(squares, squares.sum() * (_EDGE_SPECTRUM / _EDGE_SPECTRUM[0]) ** 2)
        return np.asarray(np.sqrt(squares / max(float(squares.sum()), _TINY)))

    @property
    def undithered_fraction(self) -> float:
        """Mean over the steps of the fraction of the rounding's sawtooth that noise leaves."""
        return float(np.exp(-DAMPING * self._s**2).mean())

    def undithered_square(self) -> float:
        """Return the mean square that a sample may miss because all blocks may round alike.

        Where noise does not spread a block's mean over the steps, the smallest change may round
        many blocks of a uniform picture to other values at once. Half of them are counted.
        """
        sharp = self._step[:2] ** 2 * np.exp(-DAMPING * self._s[:2] ** 2)
        return float(sharp.sum()) / 2.0 / 64.0

    def growth_at_rims(
        self, fractions: FloatArray | float, squares: FloatArray | float
    ) -> FloatArray:
        """Return how much rounding adds to changes in given fractions of the blocks.

        ``squares`` are the changes' mean squares over the whole picture.
        """
        sizes = np.sqrt(np.asarray(squares) / np.maximum(fractions, _TINY))
        return fractions * self._growth_at_rims(sizes, self._along)

    def spread_read_back(self, spread: FloatArray) -> FloatArray:
        """Return the standard deviation of pixels' noise after the file, from that before it."""
        return np.interp(spread, _NOISES, _tabulate_spread_read_back(self._all.tobytes()))

    def noise_squares(
        self, squares: FloatArray, variances: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the mean square of each noise after the file, in pixels and in column means.

        ``squares`` are the mean square changes before it when each noise alone is removed,
        ``variances`` what each adds to the variance of pixels.
        """
        own, step, q = np.sqrt(squares), self._step[:, 0], self._others
        total = float(variances.sum())
        spreads = np.sqrt(np.append(total - variances, total) + _ROUNDING_VARIANCE)[:, None]
        x = self._x[0].mean(axis=2)
        variances = variance_after_rounding(x, (spreads / step)[:, None]).mean(axis=1)
        most = (own[:, None] / step) ** 2 + rounding_growth_by_noise(own[:, None] / step)
        along = np.minimum(variances[:-1] + variances[-1], most) @ step**2 / 64.0
        variances = square_of_rounded_noise(spreads / q)
        # Coefficients of other vertical frequencies lie near 0, or anywhere if the rows differ; the
        # geometric mean is between the two.
        density_factor = np.sqrt(density_at_boundaries(self._noise / q))
        most = density_factor * (
            (own[:, None] / q) ** 2 + rounding_growth_by_noise(own[:, None] / q)
        )
        across = np.minimum(variances[:-1] + variances[-1], most) @ q**2 / 64.0
        rims = self._growth_at_rims(own, self._white)
        part = self._rims * float(self._density_at_rims.mean())  # noise is not rounded away there
        image = (1.0 - part) * (along + across) + part * own**2 + self._rims * rims
        return np.asarray(image), np.asarray(along / self.block_rows + self._cut * rims)
