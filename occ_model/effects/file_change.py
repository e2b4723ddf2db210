"""What a file of rounded cosine coefficients makes of pixels, of noise and of changes.

A coefficient x, in its steps, with noise of the deviation s in steps, is rounded. What rounding
adds, round(x) - x, is a sawtooth; noise damps the n-th harmonic of its Fourier series by
exp(-2 pi^2 n^2 s^2).
"""

import math
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.effects.normal import normal_share

_HARMONICS = np.arange(1.0, 7.0)
_SIGNS = (-1.0) ** _HARMONICS
_DAMPING = 2.0 * math.pi**2 * _HARMONICS**2


@lru_cache(maxsize=1)
def _transform() -> FloatArray:
    """Return the orthonormal cosine transform of eight values."""
    place = np.arange(8.0)
    matrix = np.cos(math.pi * place[:, None] * (2.0 * place + 1.0) / 16.0) / 2.0
    matrix[0] /= math.sqrt(2.0)
    return matrix


def _rounding_square(x: FloatArray, s: FloatArray) -> FloatArray:
    """Return the mean square error of rounding, in steps."""
    found = np.full(np.broadcast_shapes(x.shape, s.shape), 1.0 / 12.0)
    for n, sign, damping in zip(_HARMONICS, _SIGNS, _DAMPING, strict=True):
        found += (
            sign / (math.pi * n) ** 2 * np.cos(2.0 * math.pi * n * x) * np.exp(-damping * s * s)
        )
    return np.asarray(np.maximum(found, 0.0))


def _rounding_mean(x: FloatArray, s: FloatArray) -> FloatArray:
    """Return the mean of round(x) - x, in steps."""
    found = np.zeros(np.broadcast_shapes(x.shape, s.shape))
    for n, sign, damping in zip(_HARMONICS, _SIGNS, _DAMPING, strict=True):
        found += sign / (math.pi * n) * np.sin(2.0 * math.pi * n * x) * np.exp(-damping * s * s)
    sharp = np.rint(x) - x
    return np.where(s < 0.08, sharp, found)


def _moved_steps(change: FloatArray) -> FloatArray:
    """Return by how much the mean square of a change grows when both values are rounded."""
    share = np.abs(change) % 1.0
    return share * (1.0 - share)


def _moved_steps_of_noise(s: FloatArray) -> FloatArray:
    """Return the same for a change by noise: by |d| - d^2 where that stays within a step."""
    found = np.full(s.shape, 1.0 / 6.0)
    for n, damping in zip(_HARMONICS[:2], _DAMPING[:2], strict=True):
        found -= np.exp(-damping * s * s) / (math.pi * n) ** 2
    return np.asarray(np.where(s < 0.3, math.sqrt(2.0 / math.pi) * s - s * s, found))


_FINEST = 2.0
"""Noise in steps from which it is rounded like a value that lies anywhere."""


@lru_cache(maxsize=1)
def _rounded_noises() -> tuple[FloatArray, FloatArray]:
    """Tabulate the mean square of rounded noise about 0, in steps."""
    s = np.linspace(1e-3, _FINEST, 401)
    ends = (np.arange(1.0, 17.0) - 0.5)[:, None] / s
    passed = 1.0 - normal_share(ends)
    return s, 2.0 * ((2.0 * np.arange(1.0, 17.0) - 1.0)[:, None] * passed).sum(axis=0)


def _rounded_noise(s: FloatArray) -> FloatArray:
    """Return the mean square of rounded noise about 0, in steps."""
    return np.where(s > _FINEST, s * s + 1.0 / 12.0, np.interp(s, *_rounded_noises()))


_DITHERED = 0.25
"""Noise in steps from which it spreads a coefficient evenly over the steps (dithering)."""

_SHARPEST = 0.5
"""Noise in grey levels from which a pixel's rounding is nothing in the mean."""

_ROUNDING = 1.0 / 12.0
"""Mean square error of rounding to whole grey levels."""


class FileChange:
    """A file's effect on the pixels of a sample.

    Parameters
    ----------
    steps : ndarray of float64, shape (8, 8)
        Of the coefficients.
    blocks : ndarray of int64, shape (blocks, 8)
        The places of its blocks in the sample's columns.
    inner
        The sample's nodes between the rims.
    whole : ndarray of float64, shape (columns, nodes)
        The sample's pixels with all effects.
    spread
        Root mean square of a pixel's noise in grey levels.
    block_rows
        Rows of blocks that the panel spans.
    rims
        Share of the pixels that lie in blocks with a rim of the panel.
    """

    def __init__(  # noqa: PLR0917 - what a file and a sample are
        self,
        steps: FloatArray,
        blocks: IndexArray,
        inner: slice,
        whole: FloatArray,
        spread: float,
        block_rows: float,
        rims: float,
    ) -> None:
        self._blocks, self._inner = blocks, inner
        self._step = steps[0][None, :, None]
        self._others = steps[1:].ravel()
        self._all = steps
        self._noise = math.sqrt(spread**2 + _ROUNDING)
        self.block_rows = max(block_rows, 1.0)
        self._rims = rims
        self._whole = whole
        self._contrast = float(np.ptp(whole))
        self._x = self._coefficients(whole)

    def _coefficients(self, values: FloatArray) -> FloatArray:
        """Return those without a vertical frequency, in their steps: (blocks, 8, nodes)."""
        if not len(self._blocks):
            return np.zeros((1, 8, 1))
        blocks = values[self._blocks][:, :, self._inner]
        found = np.einsum("kc,bcr->bkr", _transform(), blocks) * math.sqrt(8.0)
        found[:, 0] -= 1024.0
        return np.asarray(found / self._step)

    def means(self, values: FloatArray, spread: float) -> FloatArray:
        """Return the pixels' mean values as they are read back, with some noise."""
        if not len(self._blocks):
            return values
        if spread < _SHARPEST:  # pixels are whole levels before they are in a file
            values = values + _rounding_mean(values, np.full(1, spread))
        x = self._coefficients(values)
        own = math.sqrt(spread**2 + _ROUNDING) / self._step
        wide = np.sqrt(own * own + x.var(axis=2, keepdims=True))
        shift = _rounding_mean(x.mean(axis=2, keepdims=True), wide) * self._step / math.sqrt(8.0)
        back = np.einsum("kc,bkr->bcr", _transform(), shift)
        out = values.copy()
        out[self._blocks.ravel()] += back.reshape(-1, 1)
        return out

    def own_change(self) -> float:
        """Return the mean square of what the file changes."""
        rims = self._rims
        own = np.broadcast_to(self._noise / self._step, self._x.shape)
        along = (_rounding_square(self._x, own) * self._step**2).sum(axis=1).mean()
        noise = self._noise / self._others
        others = (self._others**2 * _rounding_square(np.zeros(1), noise)).sum()
        edges = min(float((self._all**2).mean()) / 12.0, self._contrast**2 / 4.0)
        return (1.0 - rims) * float(along + others) / 64.0 + rims * edges + _ROUNDING

    def own_sampling(self) -> float:
        """Return the mean square of the rounding's sampling error in a column's mean."""
        own = self._noise / self._step[0, :, 0]
        square = self._step[0, :, 0] ** 2 * np.minimum(1.0, (own / _DITHERED) ** 2) / 12.0
        rims = self._rims * min(float((self._all**2).mean()) / 12.0, self._contrast**2 / 4.0)
        return (float(square.sum()) / 64.0 + rims) / self.block_rows

    def added(self, values: FloatArray) -> tuple[float, float]:
        """Return what rounding adds to the mean square of a change.

        Pixels that change by a part of a level round to another one here and there: a change of all
        coefficients, as by noise.

        Returns
        -------
        image, sampling
            To that of the pixels, and of the part of a column's mean that differs from block to
            block.
        """
        x = self._coefficients(values)
        change = x - self._x
        moved = (values - self._whole)[self._blocks][:, :, self._inner]
        if not moved.size:
            moved = values - self._whole
        flips = math.sqrt(float(_moved_steps(moved).mean()))
        size = math.sqrt(float((moved**2).mean()))
        step = self._step
        own = self._noise / step
        spread = np.maximum(_moved_steps(change), _moved_steps_of_noise(flips / step))
        sharp = (np.rint(x) - np.rint(self._x)) ** 2 - change**2
        steps = np.where(own < _DITHERED, sharp, spread) * step**2
        along = float(steps.sum(axis=1).mean())
        q = self._others
        across = (q**2 * _moved_steps_of_noise(flips / q) * _near_half(self._noise / q)).sum()
        rims = self._rims * self._at_rims(math.hypot(size, flips))
        image = (1.0 - self._rims) * (along + float(across)) / 64.0 + rims
        return image, (max(along, 0.0) / 64.0 + rims) / self.block_rows

    def _at_rims(self, size: float) -> float:
        """Return what rounding adds to a change where a rim spreads all coefficients."""
        return float((self._all**2 * _moved_steps_of_noise(size / self._all)).mean())

    @property
    def undithered_share(self) -> float:
        """The share of rounding's sawtooth, 0 to 1, that noise leaves: mean over the steps."""
        sharp = np.exp(-_DAMPING[0] * (self._noise / self._step) ** 2)
        return float(sharp.mean())

    def undithered(self) -> float:
        """Return the mean square of what no sample can tell: rounding alike in all blocks.

        Where noise does not spread a block's mean over the steps, the smallest change may round
        the blocks of an even picture otherwise, all at once.
        """
        step = self._step[0, :2, 0]
        sharp = np.exp(-_DAMPING[0] * (self._noise / step) ** 2)
        return float((step**2 * sharp).sum()) / 6.0 / 64.0

    def added_at_rims(self, share: float, square: float) -> float:
        """Return what a file adds to a change that lies in some share of the blocks.

        Parameters
        ----------
        share
            Of the blocks.
        square
            Mean square of the change over all of the picture.
        """
        return share * self._at_rims(math.sqrt(square / share)) if share else 0.0

    def spread(self, spread: FloatArray) -> FloatArray:
        """Return the deviation of a pixel's noise as it is read back, for some before."""
        few = np.linspace(0.0, float(spread.max()) + 1e-6, 9)
        step, q = self._step[0, :, 0], self._others
        noise = np.sqrt(few**2 + _ROUNDING)[:, None]
        s = noise / step
        along = step**2 * (s * s + 1.0 / 12.0) * -np.expm1(-((s / 0.3) ** 2))
        across = q**2 * _rounded_noise(noise / q)
        return np.asarray(
            np.interp(spread, few, np.sqrt((along.sum(axis=1) + across.sum(axis=1)) / 64.0))
        )

    def of_noise(self, own: float, left: float) -> tuple[float, float]:
        """Return the mean square of noise as it is read back: in pixels, and in a column's mean.

        Parameters
        ----------
        own, left
            Root mean square of the noise that is left out, and of all other.
        """
        rest = math.sqrt(left**2 + _ROUNDING)
        own = math.sqrt(own**2 + float(_moved_steps_of_noise(np.asarray(own))))
        step, q = self._step[0, :, 0], self._others
        along = (own * own + step**2 * _moved_steps_of_noise(own / step)).sum()
        both = _rounded_noise(math.hypot(own, rest) / q) + _rounded_noise(rest / q)
        apart = (own / q) ** 2 + _moved_steps_of_noise(own / q)
        across = (q**2 * np.minimum(both, apart)).sum()
        rims = self._rims * self._at_rims(own)
        image = float(along + across) / 64.0 + rims
        return image, (float(along) / 64.0 + rims) / self.block_rows


def _near_half(s: FloatArray) -> FloatArray:
    """Return how near to a step's end noise about 0 is, against values spread evenly; at most 1."""
    least = np.maximum(s, 1e-3)
    halves = np.arange(0.5, 6.0)[:, None] / least
    density = 2.0 * (np.exp(-0.5 * halves**2) / (math.sqrt(2.0 * math.pi) * least)).sum(axis=0)
    return np.asarray(np.where(s > 2.0, 1.0, np.minimum(density, 1.0)))
