"""A table of the law of grey levels over all mean pixel values, and what follows from it.

The table has a row for each of some levels: a power of the mean value in which noise is as wide
everywhere, or in which grey levels are. Between two levels the law is interpolated linearly, which
adds a variance of a sixth of a step's square on average; the table is sharpened by as much.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import cv2
import numpy as np

from occ_model.arrays import FloatArray, IndexArray, Pixels
from occ_model.camera.interpolation import Places, divide_weights, interpolate_at, split_levels
from occ_model.camera.photometry import WHITE
from occ_model.camera.pixel_noise import GREY_LEVELS, GREYS, PixelNoise

_PER_ROOT = 32.0  # levels to the root of an electron, 16 to the deviation of shot noise
_PER_GREY = 16  # levels to a grey level, where noise is far less
_FEWEST_TO_WHITE = 256.0
_MOST_TO_WHITE, _MOST = 4096.0, 8192.0
_BRIGHTEST_LEVEL = 1e9  # up to which levels are told apart before gains
_BLOCK = 256  # levels to which a table's height is rounded up
_MOST_GAIN = 4.0  # standard deviations that a pixel's gain differs from the mean
_BRIGHTEST = 7.0  # deviations above white, or a full well, at which all pixels have the top code


@dataclass(frozen=True, eq=False)
class GreyLaw:
    """The probability of each grey level that a pixel can have, for mean values up to some end."""

    noise: PixelNoise
    to_white: float  # Level of white
    power: float  # Power of the pixel value to which a level is proportional
    greys: IndexArray  # Shape (greys,): the grey levels that pixels can have

    below: FloatArray
    """Probability of each grey level but the last, or of a lower one: shape (levels, greys - 1)."""

    def levels_of(self, values: Pixels) -> Pixels:
        """Return the levels of mean pixel values before saturation, in single precision.

        They may be above the law's last one, and below it with a small gain.
        """
        flat = np.maximum(values, np.float32(0.0)).reshape(len(values), -1)
        levels = np.asarray(cv2.pow(flat, self.power), dtype=np.float32)
        levels *= np.float32(self.to_white / WHITE**self.power)
        np.minimum(levels, np.float32(_BRIGHTEST_LEVEL), out=levels)
        return levels.reshape(values.shape)

    @property
    def last(self) -> float:
        """The last level, up to which values are told apart."""
        return len(self.below) - 1.001

    @cached_property
    def is_whole(self) -> bool:
        """Whether all brighter pixels are those of the last level."""
        return not self.below[-1].any()

    @cached_property
    def means(self) -> FloatArray:
        """The mean grey level of a pixel at each level, shape (levels,)."""
        return self.mean_of(GREY_LEVELS)

    @cached_property
    def deviations(self) -> FloatArray:
        """The standard deviation of a pixel's grey level at each level, shape (levels,)."""
        square = self.mean_of(GREY_LEVELS**2)
        return np.sqrt(np.maximum(square - self.means**2, 0.0))

    @cached_property
    def values(self) -> FloatArray:
        """The mean pixel value before saturation of each level, shape (levels,)."""
        return np.asarray(
            WHITE * (np.arange(len(self.below)) / self.to_white) ** (1.0 / self.power)
        )

    def at_means(self, of_levels: FloatArray, means: FloatArray) -> FloatArray:
        """Interpolate a quantity, given for each level, at pixels of some mean grey levels."""
        return np.interp(means, self._rising_means, of_levels)

    @cached_property
    def _rising_means(self) -> FloatArray:
        return np.asarray(np.maximum.accumulate(self.means))

    def fraction_below(self, grey: int) -> FloatArray:
        """Return the probability of a grey level below ``grey``, at each level."""
        rank = int(np.searchsorted(self.greys, grey))
        if 0 < rank < len(self.greys):
            return self.below[:, rank - 1]
        return np.full(len(self.below), float(rank > 0))

    def histogram(self, values: FloatArray, weights: FloatArray) -> FloatArray:
        """Return the expected number of pixels of each of 256 grey levels, by their weights."""
        levels = divide_weights(weights, self.places(values), len(self.below))
        used = np.flatnonzero(levels)
        counts: FloatArray = np.zeros(GREYS)
        counts[self.greys] = np.maximum(levels[used] @ self._fractions[used], 0.0)
        return counts

    def interpolate(self, of_levels: FloatArray, values: FloatArray) -> FloatArray:
        """Interpolate a quantity, given for each level, at mean pixel values."""
        return interpolate_at(of_levels, self.places(values))

    def places(self, values: FloatArray) -> Places:
        """Return the places of mean pixel values before saturation among the levels."""
        levels = self.to_white * (np.maximum(values, 0.0) / WHITE) ** self.power
        np.minimum(levels, self.last, out=levels)
        return split_levels(levels)

    def mean_of(self, curve: FloatArray) -> FloatArray:
        """Return the mean of a curve at each level."""
        own = curve[self.greys]
        return np.asarray(own[-1] - self.below @ np.diff(own))

    @cached_property
    def _fractions(self) -> FloatArray:
        """Probability of each grey level, shape (levels, greys)."""
        return np.diff(self.below, axis=1, prepend=0.0, append=1.0)


def grey_law(noise: PixelNoise, brightest: float) -> GreyLaw:
    """Return the law for mean values up to a brightest one, cached for the same sensor."""
    to_white, power, end = _scale(noise)
    needed = max(min(brightest, 1e9), 0.0) ** power * (to_white / WHITE**power) + 3.0
    blocks = math.ceil(min(needed, end) / _BLOCK)
    return _tabulate(noise, min(blocks * _BLOCK, math.ceil(end)))


def law_of_known_gains(noise: PixelNoise, brightest: float) -> GreyLaw:
    """Return the law of pixels whose gains are known, for mean values up to a brightest one.

    The mean values with their gains may be brighter by as much as any gain is larger.
    """
    largest = 1.0 + _MOST_GAIN * noise.gain_variation
    return grey_law(replace(noise, gain_variation=0.0), brightest * largest ** (1.0 / noise.gamma))


@lru_cache(maxsize=64)
def _scale(noise: PixelNoise) -> tuple[float, float, float]:
    """Return the level of white, the power of a value, and the level of none but top codes."""
    top = min(noise.full, noise.white)
    # Relative to the top; the gain's part grows with it.
    reach = float(noise.deviation(np.array(top))) / top
    end = top * (1.0 + _BRIGHTEST * reach) / max(1.0 - _BRIGHTEST * noise.gain_variation, 0.1)
    end += _BRIGHTEST**2 * noise.is_counted
    to_white, power = _PER_ROOT * math.sqrt(noise.white), noise.gamma / 2.0
    if to_white > _MOST_TO_WHITE or not noise.is_counted:
        to_white, power = _PER_GREY * WHITE, 1.0
    to_white = max(to_white, _FEWEST_TO_WHITE)
    last = to_white * (end / noise.white) ** (power / noise.gamma)
    shrunk = min(_MOST / last, 1.0)
    return to_white * shrunk, power, last * shrunk + 2.0


@lru_cache(maxsize=8)
def _tabulate(noise: PixelNoise, levels: int) -> GreyLaw:
    to_white, power, end = _scale(noise)
    relative = np.arange(levels + 2) / to_white
    below = noise.fractions(noise.white * relative ** (noise.gamma / power))
    around = below[2:] + below[:-2]
    around /= 12.0
    below[1:-1] *= 7.0 / 6.0
    below[1:-1] -= around
    below = np.clip(below[:-1], 0.0, 1.0)
    np.maximum.accumulate(below, axis=1, out=below)
    if levels >= math.ceil(end):
        below[-1] = 0.0  # brighter pixels than any that differ
    below.flags.writeable = False
    return GreyLaw(noise, to_white, power, noise.greys, below)
