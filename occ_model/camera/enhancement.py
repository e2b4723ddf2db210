"""Contrast enhancement: histogram equalization or a stretch, and rounding to 8 bits."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Self

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.camera.photometry import FLAT_SPAN, WHITE

_LEVEL_TOLERANCE = 1e-9  # grey levels within which column values are equal: their rounding error


_NEGLIGIBLE_TAIL = 5.0  # standard deviations; beyond lies less than 1e-6 of a normal distribution
_TABLE_END = 8.0  # standard deviations tabulated: none of 1e14 pixels is expected beyond
_PER_DEVIATION = 2048  # entries of the table of the normal distribution to a standard deviation


def to_bytes(values: NDArray[np.floating[Any]]) -> ByteArray:
    """Round grey levels to the nearest of 0 to 255."""
    return np.asarray(np.clip(np.rint(values), 0.0, WHITE), dtype=np.uint8)


class Enhancement:
    """The contrast enhancement of a picture with some column values.

    Its curve, of shape (256,) and nowhere falling, follows from the columns' values alone; it is
    applied to pixels that a lens, noise or a file has changed since. ``"equalization"``, the
    paper's choice, equalizes the histogram of the rounded values; ``"stretch"`` makes the smallest
    0 and the largest 255. A profile that spans less than one grey level is only rounded; one whose
    values differ by rounding errors alone has one grey level, also half-way between two.
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
            self.curve = _equalization(rounded)
        elif rounded.max() > rounded.min():
            darkest, brightest = int(rounded.min()), int(rounded.max())
            self.curve = to_bytes((np.arange(256) - darkest) * (WHITE / (brightest - darkest)))

    def __call__(self, values: NDArray[np.floating[Any]]) -> ByteArray:
        """Round and enhance grey levels of any shape."""
        if self._is_even:
            same = (values >= self._low) & (values <= self._high)
            values = np.where(same, self._low, values)
        return self.curve[to_bytes(values)]

    def moments(self, levels: FloatArray, spread: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the mean and the standard deviation of a noisy pixel after the enhancement.

        A pixel of mean v and standard deviation s passes the step of the curve from level k to the
        next with the probability Q((k + 1/2 - v) / s), Q being the tail of the normal distribution.
        The mean is the sum of the steps times these probabilities, and that of the square likewise.
        """
        return self._moments(PassedSteps.of(levels, spread))

    def _moments(self, passed: "PassedSteps") -> tuple[FloatArray, FloatArray]:
        curve = self.curve.astype(np.float64)
        mean = passed.mean_of(curve)
        return mean, np.sqrt(np.maximum(passed.mean_of(curve**2) - mean**2, 0.0))

    def mean(self, passed: "PassedSteps") -> FloatArray:
        """Return the mean of :meth:`moments` alone."""
        return passed.mean_of(self.curve.astype(np.float64))

    def smoothed(self, passed: "PassedSteps") -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return :meth:`moments`, and the mean of the sum of squares of the steps passed."""
        jumps = np.concatenate([[0.0], np.cumsum(np.diff(self.curve.astype(np.float64)) ** 2)])
        return *self._moments(passed), passed.mean_of(jumps)

    def of_bytes(self, image: ByteArray, out: ByteArray | None = None) -> ByteArray:
        """Enhance rounded levels, shape (rows, columns), optionally in place."""
        return np.asarray(cv2.LUT(image, self.curve, dst=out), dtype=np.uint8)


def byte_fractions(levels: FloatArray, spread: FloatArray, weights: FloatArray) -> FloatArray:
    """Return the number of pixels of each of the 256 levels, by means, noise and weights."""
    steps = PassedSteps.of(levels, spread)
    edge, passed = steps.edge, steps.passed
    ones, none = np.ones((len(levels), 1)), np.zeros((len(levels), 1))
    fraction = np.hstack([ones, passed]) - np.hstack([passed, none])
    place = np.hstack([edge, edge[:, -1:] + 1])
    flat = np.minimum(place, 255).ravel()
    counts = np.bincount(flat, weights=(fraction * weights[:, None]).ravel(), minlength=256)
    return np.asarray(counts, dtype=np.float64)


def fraction_above(limit: float, levels: FloatArray, spread: FloatArray) -> FloatArray:
    """Return the fraction of noisy pixels above a limit, for each mean and standard deviation."""
    return _tail((limit - levels) / np.maximum(spread, _LEVEL_TOLERANCE))


@dataclass(frozen=True, eq=False, slots=True)
class PassedSteps:
    """The steps from one grey level to the next near some levels, and the pixels that pass them."""

    # Shape (values, steps): the grey level below each step; below the first one lies hardly any
    # pixel
    edge: IndexArray
    passed: FloatArray  # Shape (values, steps): the fraction of the pixels above it

    @classmethod
    def of(cls, levels: FloatArray, spread: FloatArray) -> Self:
        """Find the steps for noisy pixels of some mean values."""
        reach = min(math.ceil(_NEGLIGIBLE_TAIL * float(spread.max())) + 1, 256)
        lowest = np.minimum(np.maximum(np.rint(levels).astype(np.int64) - reach, 0), 255)
        step = lowest[:, None] + np.arange(2 * reach)
        scale = (1.0 / np.maximum(spread, _LEVEL_TOLERANCE))[:, None]
        passed = _tail((step + (0.5 - levels[:, None])) * scale)
        passed[step >= 255] = 0.0
        return cls(step, passed)

    def mean_of(self, values: FloatArray) -> FloatArray:
        """Return the mean of what pixels get whose level has some value."""
        steps = np.concatenate([np.diff(values), np.zeros(self.edge.shape[1] + 1)])
        passed = np.einsum("ij,ij->i", steps[self.edge], self.passed)
        return np.asarray(values[self.edge[:, 0]] + passed)


def _tail(deviations: FloatArray) -> FloatArray:
    """Return the fraction of a normal distribution above some deviations, exact to 1e-4."""
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


def _equalization(rounded: ByteArray) -> ByteArray:
    """Return the enhanced level of each of the 256 grey levels."""
    # Explicitly one row: a one-dimensional array has different shapes in OpenCV 4 and 5.
    equalized = cv2.equalizeHist(rounded[None, :])[0]
    curve = np.zeros(256, dtype=np.uint8)
    curve[rounded] = equalized
    # A level that no column has follows the next darker one: as many columns are below it.
    return np.maximum.accumulate(curve)


def enhance(profile: FloatArray, method: str) -> ByteArray:
    return Enhancement(profile, method)(profile)
