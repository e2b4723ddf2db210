"""Contrast enhancement and rounding to 8 bits."""

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.photometry import WHITE

_SMALLEST_SWING = 1.0
"""A profile that spans less than one grey level is flat: stretching it would invent stripes."""


def to_bytes(values: FloatArray) -> ByteArray:
    """Round grey levels to the nearest of 0 to 255."""
    return np.clip(np.rint(values), 0.0, WHITE).astype(np.uint8)


def enhance(profile: FloatArray, method: str) -> ByteArray:
    """Enhance the contrast of column values and round them.

    Parameters
    ----------
    profile : ndarray of float64, shape (columns,)
        Grey levels.
    method
        ``"equalization"``: histogram equalization of the rounded values, the paper's choice;
        ``"stretch"``: the smallest value becomes 0, the largest 255; ``"none"``.

    Returns
    -------
    ndarray of uint8, shape (columns,)
        A profile that spans less than one grey level comes back rounded only.
    """
    rounded = to_bytes(profile)
    low, high = float(profile.min()), float(profile.max())
    if method == "none" or high - low < _SMALLEST_SWING:
        return rounded
    if method == "stretch":
        return to_bytes((profile - low) * (WHITE / (high - low)))
    # One row, given as such: a one-dimensional array means different shapes to OpenCV 4 and 5.
    return np.asarray(cv2.equalizeHist(rounded[None, :])[0], dtype=np.uint8)
