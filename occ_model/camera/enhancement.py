"""Contrast enhancement and rounding to 8 bits."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.photometry import FLAT, WHITE


def to_bytes(values: NDArray[np.floating[Any]]) -> ByteArray:
    """Round grey levels to the nearest of 0 to 255."""
    return np.asarray(np.clip(np.rint(values), 0.0, WHITE), dtype=np.uint8)


def enhancement_of(profile: FloatArray, method: str) -> Callable[[FloatArray], ByteArray]:
    """Make the contrast enhancement that a picture with these column values gets.

    Parameters
    ----------
    profile : ndarray of float64, shape (columns,)
        Grey levels.
    method
        ``"equalization"``: histogram equalization of the rounded values, the paper's choice;
        ``"stretch"``: the smallest value becomes 0, the largest 255; ``"none"``.

    Returns
    -------
    callable
        Takes grey levels, those of the profile or others, of any shape; gives them enhanced and
        rounded. A profile that spans less than one grey level gets rounding only.
    """
    low, high = float(profile.min()), float(profile.max())
    if method == "none" or high - low < FLAT:
        return to_bytes
    if method == "stretch":
        return lambda values: to_bytes((values - low) * (WHITE / (high - low)))
    curve = _equalization(to_bytes(profile))
    return lambda values: curve[to_bytes(values)]


def _equalization(rounded: ByteArray) -> ByteArray:
    """Give what each of the 256 grey levels becomes."""
    # One row, given as such: a one-dimensional array means different shapes to OpenCV 4 and 5.
    equalized = cv2.equalizeHist(rounded[None, :])[0]
    curve = np.zeros(256, dtype=np.uint8)
    curve[rounded] = equalized
    # A level that no column has becomes what the next darker one does: no more are below it.
    return np.maximum.accumulate(curve)


def enhance(profile: FloatArray, method: str) -> ByteArray:
    """Enhance the contrast of column values and round them.

    Parameters
    ----------
    profile : ndarray of float64, shape (columns,)
        Grey levels.
    method
        As for :func:`enhancement_of`.

    Returns
    -------
    ndarray of uint8, shape (columns,)
    """
    return enhancement_of(profile, method)(profile)
