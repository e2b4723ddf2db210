"""Which axis of a photo the rolling shutter scanned: the one across the stripes."""

import math

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.reading.image_decoding import Samples

SCAN_AXES = ("auto", "columns", "lines")
"""The axis of the file that the rolling shutter scanned; ``"auto"``: the one across the stripes."""

_USUAL = 0.97
"""Share of the differences between neighbours that are not at a panel's edges."""


def stripes_are_lines(samples: Samples, lying: bool) -> bool:
    """Whether the means of lines differ more, from one to the next, than those of columns.

    Lines and columns are those of the upright photo, of which ``samples`` may be transposed.
    """
    axes = (1, 0) if lying else (0, 1)
    columns, lines = (_roughness(means_along(samples, axis)) for axis in axes)
    return lines > columns


def _roughness(means: FloatArray) -> float:
    """Give the mean difference of neighbours, without the largest: those are a panel's edges."""
    steps = np.sort(np.abs(np.diff(means)))
    usual = steps[: math.ceil(_USUAL * len(steps))]
    return float(usual.mean()) if usual.size else 0.0


def means_along(samples: Samples, axis: int) -> FloatArray:
    """Average samples along an axis, many times faster than numpy."""
    sums = cv2.reduce(samples, axis, cv2.REDUCE_SUM, dtype=cv2.CV_64F)
    means: FloatArray = np.asarray(sums, dtype=np.float64).ravel() / samples.shape[axis]
    return means
