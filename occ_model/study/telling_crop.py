"""The part of a picture in which a difference shows best, at the size of a small picture."""

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray, Pixels
from occ_model.camera.photometry import WHITE
from occ_model.results.effect_costs import EffectCrop

CROP = (64, 112)  # rows and columns of a crop that is looked at closely
ICON = (16, 40)  # rows and columns of a crop in a line of a table
_MIN_KEPT_FRACTION = 0.7
"""Fraction of a difference that averaging must keep for the averaged panel to show it."""

_CLIPPED_PERCENT = 1.0  # of the pixels at either end that the stretching to the full range may clip
_MAX_AMPLIFIED = 256
_MIDDLE_GREY = 128.0


def telling_crop(with_effect: Pixels, without: Pixels, most: tuple[int, int] = CROP) -> EffectCrop:
    """Choose the crop of the panel's bounding rectangle that shows a difference best.

    One that varies slowly is shown on the whole panel, reduced by averaging areas. A fine one would
    be averaged away: it is shown in real pixels, where it is largest.
    """
    difference = with_effect - without
    size = (min(most[0], len(difference)), min(most[1], difference.shape[1]))
    small = _averaged(difference, size)
    is_averaged = _rms(small) >= _MIN_KEPT_FRACTION * _rms(difference)
    if is_averaged:
        shown = [_averaged(with_effect, size), _averaged(without, size), small]
    else:
        place = _largest(difference, size)
        shown = [values[place] for values in (with_effect, without, difference)]
    one, other = _stretched(shown[0], shown[1])
    factor = _amplification(shown[2])
    amplified = np.clip(_MIDDLE_GREY + factor * shown[2], 0.0, WHITE)
    return EffectCrop(one, other, amplified.astype(np.uint8), factor, is_averaged)


def _averaged(values: Pixels, size: tuple[int, int]) -> Pixels:
    return np.asarray(cv2.resize(values, size[::-1], interpolation=cv2.INTER_AREA), np.float32)


def _rms(values: Pixels) -> float:
    return float(np.sqrt(np.mean(np.square(values, dtype=np.float64))))


def _largest(difference: Pixels, size: tuple[int, int]) -> tuple[slice, slice]:
    """Return the window in which the difference's mean square is largest."""
    sums = cv2.integral(np.square(difference), sdepth=cv2.CV_64F)
    rows, columns = size
    windows = (sums[rows:, columns:] - sums[:-rows, columns:] - sums[rows:, :-columns]) + sums[
        :-rows, :-columns
    ]
    row, column = np.unravel_index(int(np.argmax(windows)), windows.shape)
    return slice(int(row), int(row) + rows), slice(int(column), int(column) + columns)


def _stretched(one: Pixels, other: Pixels) -> tuple[ByteArray, ByteArray]:
    """Stretch both pictures in the same way."""
    both: FloatArray = np.stack((one, other)).astype(np.float64)
    low, high = np.percentile(both, (_CLIPPED_PERCENT, 100.0 - _CLIPPED_PERCENT))
    grey = np.clip((both - low) * (WHITE / max(high - low, 1.0)), 0.0, WHITE).astype(np.uint8)
    return grey[0], grey[1]


def _amplification(difference: Pixels) -> int:
    """Return the largest power of two that leaves the difference within the range of grey."""
    largest = float(np.percentile(np.abs(difference), 100.0 - _CLIPPED_PERCENT))
    factor = 1
    while factor < _MAX_AMPLIFIED and 2 * factor * largest < _MIDDLE_GREY:
        factor *= 2
    return factor
