"""Contrast enhancement: histogram equalization or a linear stretch, and rounding to 8 bits."""

import math
from dataclasses import dataclass
from typing import Any, Self

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.camera.normal import normal_fraction
from occ_model.camera.photometry import FLAT_SPAN, WHITE

_LEVEL_TOLERANCE = 1e-9  # difference of column values in grey levels that is only rounding
_SEEN_PIXELS = 0.5  # expected pixels of a grey level below which a picture hardly has one
_NEGLIGIBLE_TAIL = 5.0  # standard deviations beyond which a normal distribution has less than 1e-6


def to_bytes(values: NDArray[np.floating[Any]]) -> ByteArray:
    """Round grey levels to the nearest of 0 to 255."""
    return np.asarray(np.clip(np.rint(values), 0.0, WHITE), dtype=np.uint8)


class Enhancement:
    """The contrast enhancement for a picture with some column values.

    Its curve, of shape (256,) and never falling, is applied to pixels that a lens or a file have
    changed. ``"equalization"``, the paper's choice, equalizes the histogram of the pixels: of the
    rounded column values, or of ``counts``, the expected number of noisy pixels of each grey level;
    ``"stretch"`` maps the smallest of the column values to 0 and the largest to 255. A profile that
    spans less than one grey level is only rounded. If its values differ only by rounding errors,
    all round to the same level, even half-way between two.
    """

    def __init__(self, profile: FloatArray, method: str, counts: FloatArray | None = None) -> None:
        low, high = float(profile.min()), float(profile.max())
        self._low, self._high = low, high
        self._is_even = 0.0 < high - low < _LEVEL_TOLERANCE
        self.curve: ByteArray = np.arange(256, dtype=np.uint8)
        if method == "none" or high - low < FLAT_SPAN:
            return
        rounded = to_bytes(profile)
        if method == "equalization":
            if counts is None:
                counts = np.bincount(rounded, minlength=256).astype(np.float64)
            self.curve = equalizing_curve(counts)
        elif rounded.max() > rounded.min():
            darkest, brightest = int(rounded.min()), int(rounded.max())
            self.curve = to_bytes((np.arange(256) - darkest) * (WHITE / (brightest - darkest)))

    def __call__(self, values: NDArray[np.floating[Any]]) -> ByteArray:
        """Round and enhance grey levels of any shape."""
        if self._is_even:
            is_equal = (values >= self._low) & (values <= self._high)
            values = np.where(is_equal, self._low, values)
        return self.curve[to_bytes(values)]

    def enhance_bytes(self, image: ByteArray, out: ByteArray | None = None) -> ByteArray:
        """Enhance whole grey levels, shape (rows, columns), optionally in place."""
        return np.asarray(cv2.LUT(image, self.curve, dst=out), dtype=np.uint8)


def equalizing_curve(counts: FloatArray) -> ByteArray:
    """Return the curve that equalizes a histogram, shape (256,), as OpenCV does.

    The darkest level of which at least half a pixel is expected becomes black. If there is none, as
    in a picture of a few noisy pixels, it is the darkest one of which any is expected.
    """
    seen = np.where(counts < _SEEN_PIXELS, 0.0, counts)
    counts = seen if seen.any() else counts
    darkest = int(np.flatnonzero(counts)[0])
    total = counts.sum() - counts[darkest]
    curve = np.arange(256, dtype=np.uint8)
    if total <= 0.0:  # one level only
        return curve
    brighter = np.cumsum(counts) - counts[darkest]
    brighter[:darkest] = 0.0
    # In single precision, as the library rounds.
    scaled = brighter.astype(np.float32) * np.float32(np.float32(WHITE) / np.float32(total))
    return to_bytes(scaled)


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
        fraction_above = normal_fraction((levels[:, None] - 0.5 - step) * scale)
        fraction_above[step >= 255] = 0.0
        return cls(step, fraction_above)

    def mean_of(self, values: FloatArray) -> FloatArray:
        """Return the mean of ``values``, given for each grey level, over the pixels."""
        steps = np.concatenate([np.diff(values), np.zeros(self.level_below.shape[1] + 1)])
        fraction_above = np.einsum("ij,ij->i", steps[self.level_below], self.fraction_above)
        return np.asarray(values[self.level_below[:, 0]] + fraction_above)


def enhance(profile: FloatArray, method: str) -> ByteArray:
    return Enhancement(profile, method)(profile)
