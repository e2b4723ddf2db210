"""Contrast enhancement: histogram equalization or a linear stretch, and rounding to 8 bits."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Self

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.camera.photometry import FLAT_SPAN, WHITE

_LEVEL_TOLERANCE = 1e-9  # difference of column values in grey levels that is only rounding


_NEGLIGIBLE_TAIL = 5.0  # standard deviations beyond which a normal distribution has less than 1e-6
_TABLE_END = 8.0  # standard deviations that are tabulated; not one of 1e14 pixels is beyond
_PER_DEVIATION = 2048  # entries of the table of the normal distribution for each standard deviation


def to_bytes(values: NDArray[np.floating[Any]]) -> ByteArray:
    """Round grey levels to the nearest of 0 to 255."""
    return np.asarray(np.clip(np.rint(values), 0.0, WHITE), dtype=np.uint8)


class Enhancement:
    """The contrast enhancement for a picture with some column values.

    Its curve, of shape (256,) and never falling, follows from the column values alone; it is then
    applied to pixels that a lens, noise or a file have changed. ``"equalization"``, the paper's
    choice, equalizes the histogram of the rounded values; ``"stretch"`` maps the smallest to 0 and
    the largest to 255. A profile that spans less than one grey level is only rounded. If its values
    differ only by rounding errors, all round to the same level, even half-way between two.
    """

    def __init__(self, profile: FloatArray, method: str) -> None:
        low, high = float(profile.min()), float(profile.max())
        self._low, self._high = low, high
        self._is_even = 0.0 < high - low < _LEVEL_TOLERANCE
        self.curve: ByteArray = np.arange(256, dtype=np.uint8)
        if method == "none" or high - low < FLAT_SPAN:
            return
        rounded = to_bytes(profile)
        if method == "equalization":
            self.curve = _equalize(rounded)
        elif rounded.max() > rounded.min():
            darkest, brightest = int(rounded.min()), int(rounded.max())
            self.curve = to_bytes((np.arange(256) - darkest) * (WHITE / (brightest - darkest)))

    def __call__(self, values: NDArray[np.floating[Any]]) -> ByteArray:
        """Round and enhance grey levels of any shape."""
        if self._is_even:
            is_equal = (values >= self._low) & (values <= self._high)
            values = np.where(is_equal, self._low, values)
        return self.curve[to_bytes(values)]

    def moments(self, levels: FloatArray, spread: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return mean and standard deviation of noisy pixels after the enhancement.

        A pixel of mean v and standard deviation s is above the curve's step from level k to the
        next with the probability Q((k + 1/2 - v) / s), where Q is the tail of the normal
        distribution. The mean is the sum of the steps times these probabilities; the mean square
        follows likewise.
        """
        return self._moments(LevelSteps.of(levels, spread))

    def _moments(self, steps: "LevelSteps") -> tuple[FloatArray, FloatArray]:
        curve = self.curve.astype(np.float64)
        mean = steps.mean_of(curve)
        return mean, np.sqrt(np.maximum(steps.mean_of(curve**2) - mean**2, 0.0))

    def mean(self, steps: "LevelSteps") -> FloatArray:
        """Return only the mean of :meth:`moments`."""
        return steps.mean_of(self.curve.astype(np.float64))

    def moments_and_jumps(self, steps: "LevelSteps") -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return :meth:`moments`, and the mean sum of the squares of the steps below a pixel."""
        jumps = np.concatenate([[0.0], np.cumsum(np.diff(self.curve.astype(np.float64)) ** 2)])
        return *self._moments(steps), steps.mean_of(jumps)

    def enhance_bytes(self, image: ByteArray, out: ByteArray | None = None) -> ByteArray:
        """Enhance whole grey levels, shape (rows, columns), optionally in place."""
        return np.asarray(cv2.LUT(image, self.curve, dst=out), dtype=np.uint8)


def byte_fractions(levels: FloatArray, spread: FloatArray, weights: FloatArray) -> FloatArray:
    """Return the expected number of pixels of each of the 256 levels, weighted."""
    steps = LevelSteps.of(levels, spread)
    level_below, fraction_above = steps.level_below, steps.fraction_above
    ones, zeros = np.ones((len(levels), 1)), np.zeros((len(levels), 1))
    fraction = np.hstack([ones, fraction_above]) - np.hstack([fraction_above, zeros])
    place = np.hstack([level_below, level_below[:, -1:] + 1])
    flat = np.minimum(place, 255).ravel()
    counts = np.bincount(flat, weights=(fraction * weights[:, None]).ravel(), minlength=256)
    return np.asarray(counts, dtype=np.float64)


def fraction_above(limit: float, levels: FloatArray, spread: FloatArray) -> FloatArray:
    """Return the fraction of noisy pixels above a limit, for each mean and noise."""
    return _tail((limit - levels) / np.maximum(spread, _LEVEL_TOLERANCE))


@dataclass(frozen=True, eq=False, slots=True)
class LevelSteps:
    """Steps between grey levels near some mean values, and the fraction of pixels above each."""

    # Shape (values, steps): the grey level below each step; hardly any pixel is below the first
    level_below: IndexArray
    fraction_above: FloatArray  # Shape (values, steps): the fraction of the pixels above it

    @classmethod
    def of(cls, levels: FloatArray, spread: FloatArray) -> Self:
        """Find the steps that matter for noisy pixels of some mean values."""
        reach = min(math.ceil(_NEGLIGIBLE_TAIL * float(spread.max())) + 1, 256)
        lowest = np.minimum(np.maximum(np.rint(levels).astype(np.int64) - reach, 0), 255)
        step = lowest[:, None] + np.arange(2 * reach)
        scale = (1.0 / np.maximum(spread, _LEVEL_TOLERANCE))[:, None]
        fraction_above = _tail((step + (0.5 - levels[:, None])) * scale)
        fraction_above[step >= 255] = 0.0
        return cls(step, fraction_above)

    def mean_of(self, values: FloatArray) -> FloatArray:
        """Return the mean of ``values``, given for each grey level, over the pixels."""
        steps = np.concatenate([np.diff(values), np.zeros(self.level_below.shape[1] + 1)])
        fraction_above = np.einsum("ij,ij->i", steps[self.level_below], self.fraction_above)
        return np.asarray(values[self.level_below[:, 0]] + fraction_above)


def _tail(deviations: FloatArray) -> FloatArray:
    """Return the fraction of a normal distribution above some deviations, to within 1e-4."""
    place = np.maximum(deviations, -_TABLE_END)
    np.minimum(place, _TABLE_END, out=place)
    place += _TABLE_END
    place *= _PER_DEVIATION
    return _tail_table()[place.astype(np.int32)]


@lru_cache(maxsize=1)
def _tail_table() -> FloatArray:
    entries = 2 * round(_TABLE_END) * _PER_DEVIATION + 1
    places = (np.arange(entries) + 0.5) / _PER_DEVIATION - _TABLE_END
    return np.array([0.5 * math.erfc(u / math.sqrt(2.0)) for u in places.tolist()])


def _equalize(rounded: ByteArray) -> ByteArray:
    """Return the curve that equalizes the histogram of rounded levels, shape (256,)."""
    # Explicitly one row, since a one-dimensional array has different shapes in OpenCV 4 and 5.
    equalized = cv2.equalizeHist(rounded[None, :])[0]
    curve = np.zeros(256, dtype=np.uint8)
    curve[rounded] = equalized
    # A level without columns takes the value of the next darker one.
    return np.maximum.accumulate(curve)


def enhance(profile: FloatArray, method: str) -> ByteArray:
    return Enhancement(profile, method)(profile)
