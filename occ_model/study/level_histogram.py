"""Histogram of a picture's grey levels, and how much of it is clipped."""

from dataclasses import dataclass

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray

_WHITE = 255

SATURATED_FROM = 0.01
"""Share of white pixels from which light is said to be lost."""


@dataclass(frozen=True, eq=False, slots=True)
class LevelHistogram:
    """How often each grey level occurs.

    Parameters
    ----------
    shares : ndarray of float64, shape (256,)
        Share of the pixels at each level; they add up to 1.
    """

    shares: FloatArray

    @property
    def white(self) -> float:
        """Share of pixels that are white."""
        return float(self.shares[_WHITE])

    @property
    def black(self) -> float:
        """Share of pixels that are black."""
        return float(self.shares[0])

    @property
    def is_saturated(self) -> bool:
        """Whether so many pixels are white that light is lost."""
        return self.white >= SATURATED_FROM


def level_histogram(image: ByteArray) -> LevelHistogram:
    """Count the grey levels of a picture.

    Parameters
    ----------
    image : ndarray of uint8, shape (rows, columns)
        The picture, or a part of it.
    """
    if not image.size:
        return LevelHistogram(np.zeros(_WHITE + 1))
    counts = cv2.calcHist([np.ascontiguousarray(image)], [0], None, [_WHITE + 1], [0, _WHITE + 1])
    return LevelHistogram(counts.ravel().astype(np.float64) / image.size)
