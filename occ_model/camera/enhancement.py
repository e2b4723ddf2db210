"""Contrast enhancement and rounding to 8 bits."""

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.photometry import FLAT, WHITE

_SAME = 1e-9
"""Grey levels within which column values are the same: they are not known any better."""


def to_bytes(values: NDArray[np.floating[Any]]) -> ByteArray:
    """Round grey levels to the nearest of 0 to 255."""
    return np.asarray(np.clip(np.rint(values), 0.0, WHITE), dtype=np.uint8)


class Enhancement:
    """The contrast enhancement that a picture with some column values gets.

    The curve is that of the columns; what a lens, noise or a file makes of the pixels afterwards is
    sent through it as it is.

    A profile that spans less than one grey level gets rounding only; one whose values are all the
    same but for the arithmetic's own rounding gets the same grey level everywhere, also where they
    lie half-way between two.

    Parameters
    ----------
    profile : ndarray of float64, shape (columns,)
        Grey levels.
    method
        ``"equalization"``: histogram equalization of the rounded values, the paper's choice;
        ``"stretch"``: the smallest value becomes 0, the largest 255; ``"none"``.
    """

    def __init__(self, profile: FloatArray, method: str) -> None:
        low, high = float(profile.min()), float(profile.max())
        is_flat = high - low < FLAT
        self._low, self._high = low, high
        self._is_even = 0.0 < high - low < _SAME
        self._scale = WHITE / (high - low) if method == "stretch" and not is_flat else None
        levels = np.arange(256)
        if method == "equalization" and not is_flat:
            self._curve = _equalization(to_bytes(profile))
        elif self._scale is not None:
            self._curve = to_bytes((levels - low) * self._scale)
        else:
            self._curve = levels.astype(np.uint8)

    @property
    def needs_fractions(self) -> bool:
        """Whether rounding first would make the result coarser."""
        return self._scale is not None

    def __call__(self, values: NDArray[np.floating[Any]]) -> ByteArray:
        """Enhance and round grey levels, those of the profile or others, of any shape."""
        if self._scale is not None:
            return to_bytes((values - self._low) * self._scale)
        if self._is_even:
            same = (values >= self._low) & (values <= self._high)
            values = np.where(same, self._low, values)
        return self._curve[to_bytes(values)]

    def of_bytes(self, image: ByteArray) -> ByteArray:
        """Enhance grey levels that are rounded already, shape (rows, columns)."""
        return np.asarray(cv2.LUT(image, self._curve), dtype=np.uint8)


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
        As for :class:`Enhancement`.

    Returns
    -------
    ndarray of uint8, shape (columns,)
    """
    return Enhancement(profile, method)(profile)
