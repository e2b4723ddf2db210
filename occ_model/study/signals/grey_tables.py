"""The grey levels of many pictures' pixels, by tables over their mean values.

A table has the probability of each grey level for pixels at each of some levels of the mean value.
The mean of any curve over the pixels of all pictures, such as the receiver's enhancement, is then a
product of matrices, and its value in each column an interpolation.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.grey_law import GreyLaw
from occ_model.camera.interpolation import Places
from occ_model.camera.photometry import WHITE
from occ_model.camera.pixel_noise import GREYS
from occ_model.effects.file_change import cosine_transform
from occ_model.effects.normal_noise import density_at_boundaries, square_of_rounded_noise
from occ_model.products import MOST_MULTIPLIED

_PER_GREY = 2  # levels to a grey level of a file's pixels
_FILE_LEVELS = (GREYS - 1) * _PER_GREY + 1
_LEAST_NOISE = 1e-6  # grey levels, in place of none
_FINE, _BEYOND = 4, 40  # steps to a grey level of a fine grid, and grey levels beyond its ends
_QUANTILE_BITS = 12
_STRIDE = 5  # equal steps from the number of a band to that of the next one


def product(left: FloatArray, right: FloatArray) -> FloatArray:
    """Multiply matrices in parts so small that no threads are started for them."""
    height = max(MOST_MULTIPLIED // max(right.size, 1), 1)
    if height >= len(left):
        return np.asarray(left @ right)
    return np.concatenate([
        left[first : first + height] @ right for first in range(0, len(left), height)
    ])  # fmt: skip


@dataclass(frozen=True, eq=False, slots=True)
class GreyDistribution:
    """The probability of grey levels at each level of a pixel's mean value."""

    greys: IndexArray  # Shape (greys,): the grey levels that pixels can have
    below: FloatArray  # Shape (levels, greys - 1): probability of each but the last, or a lower one

    def means_of(self, curves: FloatArray) -> FloatArray:
        """Return the mean of some curves at each level.

        ``curves`` are given for 256 grey levels each, shape (curves, 256); the result has the shape
        (curves, levels).
        """
        own = curves[:, self.greys]
        return np.asarray(own[:, -1:] - product(np.diff(own, axis=1), self.below.T))

    def histograms(self, weights: FloatArray) -> FloatArray:
        """Return the expected numbers of pixels of each of 256 grey levels.

        ``weights`` are the numbers of pixels at each level, shape (pictures, levels).
        """
        cumulated = np.empty((len(weights), len(self.greys) + 1))
        cumulated[:, 0], cumulated[:, -1] = 0.0, weights.sum(axis=1)
        cumulated[:, 1:-1] = product(weights, self.below)
        counts: FloatArray = np.zeros((len(weights), GREYS))
        counts[:, self.greys] = np.maximum(np.diff(cumulated, axis=1), 0.0)
        return counts

    def fractions_from(self, grey: IndexArray) -> FloatArray:
        """Return the probability of each of some grey levels, or a higher one, at each level."""
        rank = np.searchsorted(self.greys, grey)
        fractions: FloatArray = np.zeros((len(rank), len(self.below)))
        fractions[rank == 0] = 1.0
        inner = (rank > 0) & (rank < len(self.greys))
        fractions[inner] = 1.0 - self.below[:, rank[inner] - 1].T
        return fractions


def table_of_law(law: GreyLaw) -> GreyDistribution:
    return GreyDistribution(law.greys, law.below)


@lru_cache(maxsize=1)
def table_without_noise() -> GreyDistribution:
    """Return the table of pixels that all have their rounded mean value, at levels of one grey."""
    greys = np.arange(GREYS)
    return GreyDistribution(greys, (greys[:, None] <= greys[:-1]).astype(np.float64))


@lru_cache(maxsize=8)
def table_of_file(law: GreyLaw | None, steps: bytes) -> GreyDistribution:
    """Return the table of pixels that are read from a file, by their mean after it.

    Of a pixel's deviation from its mean a fraction remains: the mean, over the coefficients, of how
    much each still follows a small change. All else that a pixel has of its block's noise and of
    the rounding is a sum of many, and normal. ``steps``: the 8 x 8 steps of the coefficients.
    """
    means = np.arange(_FILE_LEVELS) / _PER_GREY
    if law is None:
        rounded = np.rint(means)[:, None]
        return GreyDistribution(
            np.arange(GREYS), (rounded <= np.arange(GREYS - 1)).astype(np.float64)
        )
    rising = np.maximum.accumulate(law.means)
    levels = np.interp(means, rising, np.arange(len(rising)))
    noise = np.interp(levels, np.arange(len(rising)), law.deviations)
    step = np.frombuffer(steps).reshape(8, 8)
    # The part of the noise that differs from pixel to pixel in a block; the rest is in its mean.
    weights = np.ones((len(means), 8, 8))
    weights[:, 0] = dithered_fraction(noise[:, None], step)
    relative = np.maximum(noise, _LEAST_NOISE)[:, None, None] / step
    kept = (weights * density_at_boundaries(relative)).mean(axis=(1, 2))
    variance = (weights * square_of_rounded_noise(relative) * step**2).mean(axis=(1, 2))
    rest = np.sqrt(np.maximum(variance - (kept * noise) ** 2, 0.0))
    return GreyDistribution(np.arange(GREYS), _spread(law, levels, means, kept, rest))


def convert_to_file_levels(law: GreyLaw, changes: FloatArray) -> FloatArray:
    """Convert changes of the mean, in grey levels at each level of a law, to a file's levels."""
    means = np.arange(_FILE_LEVELS) / _PER_GREY
    return np.asarray(_PER_GREY * np.interp(means, np.maximum.accumulate(law.means), changes))


def _spread(
    law: GreyLaw, levels: FloatArray, means: FloatArray, kept: FloatArray, rest: FloatArray
) -> FloatArray:
    """Return the probabilities of grey levels up to each, with scaled deviations and normal noise.

    They are computed on a grid that is finer than grey levels, and reaches beyond them.
    """
    own = np.diff(law.below, axis=1, prepend=0.0, append=1.0)
    below, fraction = split(levels.copy(), len(own))
    chances = own[below] + fraction[:, None] * (own[below + 1] - own[below])
    value = means[:, None] + kept[:, None] * (law.greys - means[:, None])
    place = (value + _BEYOND) * _FINE
    width = (GREYS + 2 * _BEYOND) * _FINE
    first = np.clip(place.astype(int), 0, width - 2)
    part = place - first
    at = first + (np.arange(len(means)) * width)[:, None]
    grid = np.bincount(at.ravel(), (chances * (1.0 - part)).ravel(), len(means) * width)
    grid[1:] += np.bincount(at.ravel(), (chances * part).ravel(), len(means) * width)[:-1]
    grid = grid.reshape(len(means), width)
    sizes = np.rint(rest * (_FINE * 2.0)).astype(int)
    for size in np.unique(sizes[sizes > 0]).tolist():
        reach = 2 * min(2 * size + 2, width // 2 - 1) + 1
        rows = sizes == size
        grid[rows] = cv2.GaussianBlur(grid[rows], (reach, 1), 0.5 * size, sigmaY=1.0,
                                      borderType=cv2.BORDER_REPLICATE)  # fmt: skip
    ends = (_BEYOND + np.arange(GREYS - 1)) * _FINE + _FINE // 2
    cumulated = np.cumsum(grid, axis=1)
    half = 0.5 * (cumulated[:, ends] + cumulated[:, ends - 1])  # half of the pixels on a limit
    return np.clip(half / cumulated[:, -1:], 0.0, 1.0)


def dithered_fraction(noise: FloatArray, steps: FloatArray) -> FloatArray:
    """Return how much noise averages out the rounding of blocks' means: from 0 to 1.

    ``noise`` has a last axis of length 1, which stays.
    """
    relative = np.maximum(noise, _LEAST_NOISE) / steps[0]
    return np.asarray(density_at_boundaries(relative).mean(axis=-1, keepdims=True))


def places_of_stored(means: np.ndarray) -> Places:
    """Return the places of blocks' means, in grey levels, in the table of a file."""
    levels = np.clip(means, 0.0, WHITE)
    levels *= _PER_GREY
    return split(levels, _FILE_LEVELS)


def split(levels: np.ndarray, count: int) -> Places:
    """Split levels into whole ones, of which the next one exists as well, and fractions."""
    np.minimum(levels, count - 1.001, out=levels)
    below = levels.astype(np.int32)
    levels -= below
    return below.astype(np.intp), levels


class StoredMeans:
    """What a file does to the means, over the eight rows of a block, of neighbouring columns.

    The rounding of a coefficient is averaged over the blocks of a picture: bands of them have
    numbers of their noise in equal steps from a random first one (systematic sampling).
    """

    def __init__(self, steps: FloatArray) -> None:
        self._steps = steps
        self._step = steps[0].astype(np.float32)
        self._transform = cosine_transform().astype(np.float32)

    def store(self, means: np.ndarray, variance: np.ndarray, numbers: np.ndarray) -> np.ndarray:
        """Return the means that pixels have after the file.

        As far as noise dithers the rounding, all blocks of a column are changed alike on average.

        Parameters
        ----------
        means, variance : ndarray of float32, shape (images, bands, columns)
            Of the pixels, in grey levels.
        numbers : ndarray of uint32, shape (images, columns)
            Random.
        """
        images, bands, columns = means.shape
        blocks = -(-columns // 8)
        padded = [(0, 0), (0, 0), (0, 8 * blocks - columns)]
        if padded[2][1]:
            means, variance = np.pad(means, padded, "edge"), np.pad(variance, padded, "edge")
            numbers = np.pad(numbers, padded[1:], "wrap")
        along = self._transform * np.float32(math.sqrt(8.0))
        shape = images, bands, blocks, 8
        coefficient = ((means.reshape(shape) - np.float32(128.0)) @ along.T) / self._step
        spread = variance.reshape(shape) @ (self._transform**2).T
        np.sqrt(np.maximum(spread, 0.0, out=spread), out=spread)
        spread /= self._step
        # Bands that are neighbours have numbers far from each other.
        order = np.arange(bands) * (_STRIDE if bands % _STRIDE else 1) % bands
        step = (order * (2**32 // bands)).astype(np.uint32)[:, None]
        places = (numbers[:, None] + step) >> np.uint32(32 - _QUANTILE_BITS)
        is_even = spread > _EVEN_NOISE
        spread *= _normal_quantiles().take(places).reshape(shape)
        coefficient += spread
        error = np.rint(coefficient) - coefficient
        change = np.where(is_even, np.float32(0.0), error).mean(axis=1, keepdims=True)
        noise = np.sqrt(variance.mean(axis=(1, 2), dtype=np.float64))
        own_part = 1.0 - dithered_fraction(noise[:, None], self._steps)
        if own_part.max() > _NEGLIGIBLE_PART:
            own = error + spread
            own -= own.mean(axis=1, keepdims=True)
            change = change + own_part.astype(np.float32)[:, :, None, None] * own
        change *= self._step / np.float32(math.sqrt(8.0))
        stored = (change @ self._transform).reshape(images, change.shape[1], -1)
        return np.asarray((means + stored)[..., :columns])


_EVEN_NOISE = 0.6  # noise of a coefficient, in steps, above which its rounding has no mean error
_NEGLIGIBLE_PART = 0.01  # part of the rounding's own changes of blocks that is neglected


@lru_cache(maxsize=1)
def _normal_quantiles() -> np.ndarray:
    """Return the standard normal deviates at the middles of equal parts of probability."""
    from statistics import NormalDist

    normal, count = NormalDist(), 2**_QUANTILE_BITS
    return np.array([normal.inv_cdf((k + 0.5) / count) for k in range(count)], dtype=np.float32)
