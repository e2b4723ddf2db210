"""How far a draft's column means may lie from those of the whole picture.

A draft is a systematic sample of the picture's rows. Its error is estimated from the sample itself,
by the differences between successive parts of it (W. G. Cochran, *Sampling Techniques*, 1977,
chapter 8): whatever makes rows differ, noise, a file's rounding or a slow change of the light,
shows in them. The panel's rim, which such differences do not show, is added.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.camera.coverage import column_spans
from occ_model.camera.photometry import WHITE

_BLOCK = 8  # rows of a part: those of a block of a JPEG file, whose errors depend on each other
_BLUR_REACH = 4.0  # standard deviations of the lens's blur that a rim reaches into the panel
_DEVIATIONS_ADDED = 5.0  # standard deviations of an estimate by which the stated error is larger


@dataclass(frozen=True, eq=False, slots=True)
class DraftedPanel:
    rows: range  # The rows of the picture that the draft shows
    # The columns of the panel's bounding rectangle, over which the error is averaged
    columns: slice
    # Shape (corners, 2): the panel's outline in the picture, (column, row) of each corner
    outline: FloatArray
    size: tuple[int, int]  # Rows and columns of the picture
    blur: float  # Standard deviation of the lens's blur in pixels
    # Standard deviation of a column's mean over one block of the picture's file by the file's
    # rounding, and the most that it can be in a block, in grey levels; 0 for no file
    rounding: float
    largest_rounding: float


@dataclass(frozen=True, eq=False, slots=True)
class DraftedMeans:
    # Shape (rows of the draft, columns): the draft: the camera's for the profile, the receiver's
    # for the signal
    image: ByteArray
    means: FloatArray  # Shape (columns,): its column means over the panel
    # The values that pixels of the scene can have without noise, the least and the greatest among
    # them
    levels: FloatArray | ByteArray
    stretch: float  # How many levels of the image one level of the camera's is, in the mean


def draft_errors(panel: DraftedPanel, means: Mapping[str, DraftedMeans]) -> dict[str, float]:
    """Return RMS sampling errors of a draft's columns on the panel, in grey levels, by name."""
    whole = [ends[panel.columns] for ends in column_spans(panel.outline, *panel.size)]
    first, last = (_rows_before(ends, panel.rows) for ends in whole)
    seen = whole[1] > whole[0]
    return {name: _error(panel, own, seen, first, last) for name, own in means.items()}


def _error(
    panel: DraftedPanel,
    drafted: DraftedMeans,
    seen: NDArray[np.bool_],
    first: IndexArray,
    last: IndexArray,
) -> float:
    step = panel.rows.step
    means = drafted.means[panel.columns]
    swing = float(np.ptp(np.concatenate([drafted.levels, means])))
    top, bottom = int(first.min()) // _BLOCK * _BLOCK, int(last.max())
    crop = np.ascontiguousarray(drafted.image[top:bottom, panel.columns])
    first, last = np.maximum(first - top, 0), np.maximum(last - top, 0)
    variance, rim = _of_parts(crop, means, first, last, math.ceil(_BLUR_REACH * panel.blur / step))
    short = seen & np.isnan(variance)
    rounding = panel.rounding * drafted.stretch
    largest = min(panel.largest_rounding * drafted.stretch, swing)
    # Of a file's block that shows the panel in part nothing is known from others.
    variance[short] = _of_few_rows(crop, first, last, short, swing) + largest**2
    # Steps that no two parts of the draft happen to be on either side of.
    variance += rounding**2 / np.maximum((last - first) / _BLOCK, 1.0)
    rim[short] = 0.0
    # Rows of the blurred rim that the draft does not show at all.
    rim += swing * np.minimum(4.0 * panel.blur / np.maximum(step * (last - first), 1), 1.0)
    count = max(len(means) / _BLOCK, 1.0)
    margin = 1.0 + _DEVIATIONS_ADDED / math.sqrt(2.0 * count)
    random = margin * math.sqrt((1.0 + 1.0 / step) * float(variance[seen].sum()) / len(means))
    return min(random + math.sqrt(float((rim[seen] ** 2).sum()) / len(means)), WHITE)


def _rows_before(places: IndexArray, rows: range) -> IndexArray:
    return np.clip(-(-(places - rows.start) // rows.step), 0, len(rows))


def _of_parts(
    image: ByteArray, means: FloatArray, first: IndexArray, last: IndexArray, guard: int
) -> tuple[FloatArray, FloatArray]:
    """Estimate the variance of each column's mean by successive parts, and what its rim adds.

    Not a number and 0 where a column has fewer than two whole parts within the panel.
    """
    count = len(image) // _BLOCK
    sums = [
        cv2.reduce(image[at : at + _BLOCK], 0, cv2.REDUCE_SUM, dtype=cv2.CV_32S)[0]
        for at in range(0, count * _BLOCK, _BLOCK)
    ]
    parts = np.array(sums, dtype=np.float64).reshape(count, image.shape[1]) / _BLOCK
    start = _BLOCK * np.arange(count)[:, None]
    inside = (start >= first + guard) & (start + _BLOCK <= last - guard)
    number = inside.sum(axis=0)
    pairs = inside[1:] & inside[:-1]
    squares = np.where(pairs, np.diff(parts, axis=0) ** 2, 0.0).sum(axis=0)
    enough = number >= 2
    variance = np.full(image.shape[1], np.nan)
    variance[enough] = (squares / 2.0)[enough] / (number - 1)[enough] / number[enough]
    within = np.where(inside, parts, 0.0).sum(axis=0) / np.maximum(number, 1)
    return variance, np.where(enough, np.abs(means - within), 0.0)


def _of_few_rows(
    image: ByteArray, first: IndexArray, last: IndexArray, short: NDArray[np.bool_], swing: float
) -> FloatArray:
    """Bound the variance of the means of columns with few rows by that of the rows themselves."""
    places = np.flatnonzero(short)
    number = (last - first)[places]
    squares, freedoms = 0.0, 0
    for place, count in zip(places.tolist(), number.tolist(), strict=True):
        if count > 1:
            rows = image[first[place] : last[place], place]
            squares += float(rows.var()) * count
            freedoms += count - 1
    # With no two rows of a panel nothing is known of how they differ.
    pixel = squares / freedoms if freedoms else swing**2
    shown = pixel * np.minimum(_BLOCK / np.maximum(number, 1), 1.0)
    return np.asarray(np.where(number > 1, shown, pixel + swing**2))
