"""What a file of rounded cosine coefficients does to pixels, noise and changes."""

import math
from functools import cached_property, lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.effects.normal_noise import (
    DAMPING,
    SHARP_NOISE,
    moved_steps,
    moved_steps_of_noise,
    near_half,
    rounded_noise,
    rounded_variance,
    rounding_mean,
    rounding_square,
)
from occ_model.effects.rims import Rims
from occ_model.effects.sample import Sample


@lru_cache(maxsize=1)
def _transform() -> FloatArray:
    """Return the orthonormal cosine transform of eight values."""
    place = np.arange(8.0)
    matrix = np.cos(math.pi * place[:, None] * (2.0 * place + 1.0) / 16.0) / 2.0
    matrix[0] /= math.sqrt(2.0)
    return matrix


_EDGE_SPECTRUM: FloatArray = 8.0 / math.pi / np.maximum(np.arange(8.0), 1.0)
"""Approximate coefficients of an edge of one grey level across a block."""

_NOISES: FloatArray = np.linspace(0.0, 16.0, 129) ** 2
"""Deviations of noise for which a file's are tabulated, in grey levels."""

_TINY = 1e-30

_LEAST_SPREAD = 1e-3
"""Noise in steps below which a coefficient surely stays on one side of a step's end."""

_DITHERING_NOISE = 0.25
"""Noise in steps from which it spreads a coefficient evenly over the steps (dithering)."""

_ROUNDING_VARIANCE = 1.0 / 12.0  # mean square error of rounding to whole grey levels


@lru_cache(maxsize=4)
def _read_back(steps: bytes) -> FloatArray:
    """Tabulate the deviation of noise as it is read back from the file."""
    step, q = np.split(np.frombuffer(steps), [8])
    noise = np.sqrt(_NOISES**2 + _ROUNDING_VARIANCE)[:, None]
    s = noise / step
    along = step**2 * (s * s + 1.0 / 12.0) * -np.expm1(-((s / 0.3) ** 2))
    return np.asarray(np.sqrt((along.sum(axis=1) + rounded_noise(noise / q) @ q**2) / 64.0))


class FileChange:
    """Change by a file with steps, (8, 8), of a sample's pixels with all effects and without some.

    These are the stack, (sets, columns, nodes); the spread is the root mean square of their noise.
    """

    def __init__(
        self, steps: FloatArray, sample: Sample, stack: FloatArray, spread: float, rims: Rims
    ) -> None:
        self._blocks, self._inner = sample.blocks, sample.inner
        self._step = steps[0][:, None]
        self._others = steps[1:].ravel()
        self._all = steps.ravel()
        # Full pixels are rounded equally, which is not noise.
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
        self._cut = rims.cut / rims.rows**2
        self._inside = self._in_blocks(stack) if len(self._blocks) else stack[:, None, None]
        self._x = self._coefficients(self._inside)
        contrast = float(np.ptp(stack[0]))
        along = self._spectrum_along(float(stack[0].min()), rims.is_level)
        edge = contrast * np.outer(_EDGE_SPECTRUM, along)
        self._of_rims = np.hypot(self._noise, edge).ravel() / self._all
        self._near_at_rims = near_half(self._of_rims)
        self._rim_weights = self._all**2 * self._near_at_rims / 64.0
        self._along = np.tile(along * math.sqrt(8.0), 8) / self._all
        self._white = 1.0 / self._all

    def _in_blocks(self, values: FloatArray) -> FloatArray:
        """Return the pixels between the rims, shape (sets, blocks, 8, nodes)."""
        return values[:, :, self._inner][:, self._blocks]

    def _coefficients(self, blocks: FloatArray) -> FloatArray:
        """Return coefficients without a vertical frequency, in steps: (sets, blocks, 8, nodes)."""
        if not len(self._blocks):
            return np.zeros((len(blocks), 1, 8, 1))
        found = np.matmul(_transform() * math.sqrt(8.0), blocks)
        found[:, :, 0] -= 1024.0
        found /= self._step
        return np.asarray(found)

    def means(self, values: FloatArray, spread: FloatArray) -> FloatArray:
        """Convert pixels' mean values, (sets, columns, nodes), to those that are read back.

        Each of the sets has a noise of its own.
        """
        if not len(self._blocks):
            return values
        x = self._coefficients(self._in_blocks(values))
        middle = x.mean(axis=3, keepdims=True)
        varied = np.square(x - middle).mean(axis=3, keepdims=True)
        noise = (spread * spread + _ROUNDING_VARIANCE)[:, None, None, None]
        wide = np.sqrt(noise / self._step**2 + varied)
        shift = rounding_mean(middle, wide) * (self._step / math.sqrt(8.0))
        back = np.matmul(_transform().T, shift)
        values[:, self._blocks.ravel()] += back.reshape(len(values), -1, 1)
        return values

    @cached_property
    def own_change(self) -> float:
        """Mean square of the file's own change."""
        rims = self._rims
        along = (rounding_square(self._x[0], self._s) * self._step**2).sum(axis=1)
        noise = self._noise / self._others
        others = (self._others**2 * rounding_square(np.zeros(1), noise)).sum()
        inner = float(along.mean() + others) / 64.0
        return (1.0 - rims) * inner + rims * self._rounding_at_edges + self._rounding

    @property
    def _rounding_at_edges(self) -> float:
        """Mean square of rounding in blocks with a rim."""
        return float((self._all**2 * np.minimum(self._of_rims**2, 1.0 / 12.0)).mean())

    def own_sampling(self) -> float:
        """Return the mean square of the rounding's sampling error in a column's mean."""
        square = self._step**2 * np.minimum(1.0, (self._s / _DITHERING_NOISE) ** 2) / 12.0
        return float(square.sum()) / 64.0 / self.block_rows + self._cut * self._rounding_at_edges

    @cached_property
    def added(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """What rounding adds to the mean square of a change, for each of the sets of effects.

        Pixels that change by a part of a level round to another one here and there: a change of all
        coefficients, as by noise. First what it adds to the pixels, then to the part of a column's
        mean that differs from block to block; and how much more to the pixels where coefficients
        lie a little beside the sampled ones.
        """
        moved = (self._inside - self._inside[0]).reshape(len(self._inside), -1)
        flips = np.sqrt(moved_steps(moved).mean(axis=1))
        size = np.sqrt((moved**2).mean(axis=1))
        read = self._x + rounding_mean(self._x, self._s)
        shift = read - read[0]
        by_noise = moved_steps_of_noise(flips[:, None, None] / self._step)[:, None]
        of_shift = moved_steps(shift)
        apart = self._in_pixels(np.maximum(of_shift, by_noise * self._near_half(_LEAST_SPREAD)))
        more: FloatArray = np.zeros(len(apart))
        if float(self._s.min()) < SHARP_NOISE:
            more = (
                self._in_pixels(np.maximum(of_shift, by_noise * self._near_half(SHARP_NOISE)))
                - apart
            )
        along = self._in_pixels(shift**2 - (self._x - self._x[0]) ** 2) + apart
        q = self._others
        across = moved_steps_of_noise(flips[:, None] / q) @ (q**2 * near_half(self._noise / q))
        rims = self._at_rims(np.hypot(size, flips) * self._filled, self._white)
        image = (1.0 - self._rims) * (along + across / 64.0) + self._rims * rims
        return image, apart / self.block_rows + self._cut * rims, more

    def _in_pixels(self, squares: FloatArray) -> FloatArray:
        """Return the mean square in pixels of coefficients, shape (sets,)."""
        _, blocks, _, nodes = squares.shape
        step = self._step[:, 0] ** 2 / (64.0 * blocks * nodes)
        return np.asarray(np.einsum("sbfn,f->s", squares, step))

    def _near_half(self, least: float) -> FloatArray:
        """Return how near to a step's end the coefficients are, against values spread evenly."""
        away = np.abs(self._x[0] - np.rint(self._x[0]))
        spread = np.maximum(self._s, least)
        density = np.exp(-0.5 * ((0.5 - away) / spread) ** 2) / (math.sqrt(2.0 * math.pi) * spread)
        return np.asarray(np.minimum(density, 1.0))

    def _at_rims(self, size: FloatArray, spectrum: FloatArray) -> FloatArray:
        """Return what rounding adds to changes in blocks with a rim, by their frequencies."""
        return np.asarray(moved_steps_of_noise(size[..., None] * spectrum) @ self._rim_weights)

    def _spectrum_along(self, dark: float, is_level: bool) -> FloatArray:
        """Return the fractions of the horizontal frequencies in a row of the panel, as amplitudes.

        A rim that lies along the rows has those of the stripes, any other besides its own.
        """
        values = self._x[0] * self._step
        values[:, 0] += 1024.0 - 8.0 * dark
        squares = (values**2).mean(axis=(0, 2))
        if not is_level:
            squares = np.maximum(squares, squares.sum() * (_EDGE_SPECTRUM / _EDGE_SPECTRUM[0]) ** 2)
        return np.asarray(np.sqrt(squares / max(float(squares.sum()), _TINY)))

    @property
    def undithered_fraction(self) -> float:
        """The fraction of rounding's sawtooth, 0 to 1, that noise leaves: mean over the steps."""
        return float(np.exp(-DAMPING * self._s**2).mean())

    def undithered(self) -> float:
        """Return the mean square that no sample shows: equal rounding in all blocks.

        Where noise does not spread a block's mean over the steps, the smallest change may round the
        blocks of an even picture otherwise, many at once: half of them are counted.
        """
        sharp = self._step[:2] ** 2 * np.exp(-DAMPING * self._s[:2] ** 2)
        return float(sharp.sum()) / 2.0 / 64.0

    def added_at_rims(self, fractions: FloatArray, squares: FloatArray) -> FloatArray:
        """Return what a file adds to changes that lie in some fractions of the blocks.

        The changes are given as mean squares over all of the picture.
        """
        sizes = np.sqrt(squares / np.maximum(fractions, _TINY))
        return fractions * self._at_rims(sizes, self._along)

    def added_at_a_rim(self, fraction: float, square: float) -> float:
        """Return :meth:`added_at_rims` for one change."""
        return float(self.added_at_rims(np.array(fraction), np.array(square))) if fraction else 0.0

    def spread(self, spread: FloatArray) -> FloatArray:
        """Return the deviation of a pixel's noise as it is read back."""
        return np.interp(spread, _NOISES, _read_back(self._all.tobytes()))

    def of_noise(self, own: FloatArray, left: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the mean squares of noises as they are read back: in pixels, and in column means.

        Each noise is left out while all other noise stays.
        """
        rest = np.sqrt(left**2 + _ROUNDING_VARIANCE)
        own = np.sqrt(own**2 + moved_steps_of_noise(own))
        step, q = self._step[:, 0], self._others
        spreads = np.append(rest, np.hypot(own[:1], rest[:1]))[:, None]
        x = self._x[0].mean(axis=2)
        varied = rounded_variance(x, (spreads / step)[:, None]).mean(axis=1)
        apart = (own[:, None] / step) ** 2 + moved_steps_of_noise(own[:, None] / step)
        along = np.minimum(varied[:-1] + varied[-1], apart) @ step**2 / 64.0
        varied = rounded_noise(spreads / q)
        # Coefficients across lie about 0, or anywhere where rows differ: between these two.
        near = np.sqrt(near_half(self._noise / q))
        apart = near * ((own[:, None] / q) ** 2 + moved_steps_of_noise(own[:, None] / q))
        across = np.minimum(varied[:-1] + varied[-1], apart) @ q**2 / 64.0
        rims = self._at_rims(own, self._white)
        part = self._rims * float(self._near_at_rims.mean())  # no noise is rounded away there
        image = (1.0 - part) * (along + across) + part * own**2 + self._rims * rims
        return np.asarray(image), np.asarray(along / self.block_rows + self._cut * rims)
