"""Estimate the slowly varying dark and bright levels of stripes under uneven light."""

import math
from functools import lru_cache

import cv2
import numpy as np

from occ_model.arrays import FloatArray
from occ_model.products import combine, orthonormalize, row_products

MEAN_SHAPES = 6
"""Number of polynomials for the trend of a profile's mean; two thirds as many are for its swing."""

LEAST_SWING = 0.05
"""Least ratio of a local swing to the largest one, or of a power to its mean, in a division."""

_LEAST_VARIANCE = 1e-18  # variance below which a profile is constant except for rounding


def envelope(profile: FloatArray, width: int) -> tuple[FloatArray, FloatArray]:
    """Return the low and the high level around each column, smoothed.

    A grey-scale opening removes bright stripes, a closing removes dark ones. ``width``: number of
    columns within which the stripes reach both levels.
    """
    width = max(3, min(width, 2 * len(profile) - 1)) | 1
    # One row, as OpenCV 4 and 5 give one-dimensional arrays different shapes.
    line = profile[None, :]
    kernel = np.ones((1, width), dtype=np.uint8)
    levels = []
    for operation in (cv2.MORPH_OPEN, cv2.MORPH_CLOSE):
        rough = cv2.morphologyEx(line, operation, kernel, borderType=cv2.BORDER_REPLICATE)
        levels.append(cv2.blur(rough, (width, 1), borderType=cv2.BORDER_REFLECT)[0])
    low, high = levels
    return np.asarray(low, dtype=np.float64), np.asarray(high, dtype=np.float64)


@lru_cache(maxsize=8)  # a film's frames need the same shapes
def smooth_shapes(count: int, freedom: int) -> FloatArray:
    """Return Chebyshev polynomials, shape (columns, freedom), as a basis of slow changes."""
    place = np.linspace(-1.0, 1.0, count)
    vander = np.polynomial.chebyshev.chebvander(place, freedom - 1)
    shapes: FloatArray = np.asarray(vander, dtype=np.float64)
    shapes.flags.writeable = False  # it is cached and shared
    return shapes


def remove_trend(profile: FloatArray) -> FloatArray:
    """Remove slow changes of a profile's mean and swing."""
    mean, deviation = trend_of(profile, MEAN_SHAPES)
    return np.asarray((profile - mean) / deviation)


def trend_of(profile: FloatArray, polynomials: int) -> tuple[FloatArray, FloatArray]:
    """Return a profile's local mean, a sum of so many polynomials, and its local deviation."""
    mean = _smooth(profile, polynomials)
    square = (profile - mean) ** 2
    power = np.maximum(
        _smooth(square, -(-2 * polynomials // 3)), LEAST_SWING * float(np.mean(square))
    )
    return mean, np.sqrt(np.maximum(power, 1e-300))


def weighted_correlation(first: FloatArray, second: FloatArray, weights: FloatArray) -> float:
    """Return the correlation of two profiles, from -1 to 1; 0 if one of them is constant."""
    weights = weights / weights.sum()
    a, b = first - weights @ first, second - weights @ second
    energy = math.sqrt(float(weights @ a**2) * float(weights @ b**2))
    return float(weights @ (a * b)) / energy if energy > _LEAST_VARIANCE else 0.0


def _smooth(values: FloatArray, freedom: int) -> FloatArray:
    shapes = _orthonormal_shapes(len(values), freedom)
    return combine(row_products(values, shapes), shapes)


@lru_cache(maxsize=8)
def _orthonormal_shapes(columns: int, freedom: int) -> FloatArray:
    shapes = orthonormalize(np.ascontiguousarray(smooth_shapes(columns, freedom).T))
    shapes.flags.writeable = False
    return shapes
