"""Estimate how much a draft's column means may differ from those of the whole picture.

A draft is a systematic sample of the picture's rows. Its error is estimated from the sample itself,
by the differences between successive parts (W. G. Cochran, *Sampling Techniques*, 1977, chapter 8).
They contain everything that makes rows differ: noise, a file's rounding, or a slow change of the
light. Only the error at the panel's rim is added separately. Columns with fewer rows than two parts
are compared with all of their rows, which are exposed for this purpose.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.camera.coverage import column_spans
from occ_model.camera.photometry import WHITE
from occ_model.camera.picture_rows import JPEG_BLOCK

_BLOCK = JPEG_BLOCK  # rows of a part, whose errors are correlated
_MOST_EXPOSURES = 16  # of columns with few rows
_DIFFERENCES = 30  # of exposures, of as many blocks of columns, that tell their variance
_BLOCKS_BEYOND = 4  # blocks of columns that may lie beyond a step that no exposure has passed
_FEWEST_PARTS = 2  # fewest parts whose differences tell how much they vary
_BLUR_REACH = 4.0  # reach of a blurred rim into the panel, in standard deviations
_DEVIATIONS_ADDED = 5.0  # standard deviations that are added to the estimate of an error


@dataclass(frozen=True, eq=False, slots=True)
class DraftedPanel:
    rows: range  # The rows of the picture that the draft shows
    # Columns of the panel's bounding rectangle, over which the error is averaged
    columns: slice
    # Shape (corners, 2): (column, row) of each corner of the panel's outline in the picture
    outline: FloatArray
    size: tuple[int, int]  # Rows and columns of the picture
    blur: float  # Standard deviation of the lens's blur in pixels
    # Standard deviation, in grey levels, that a file's rounding adds to a column's mean over one
    # block; 0 without a file
    rounding: float


@dataclass(frozen=True, eq=False, slots=True)
class DraftedMeans:
    # Shape (rows of the draft, columns): the camera's draft for the profile, or the receiver's for
    # the signal
    image: ByteArray
    means: FloatArray  # Shape (columns,): its column means over the panel
    # Values that pixels of the scene can have without noise, with the smallest and the largest
    levels: FloatArray | ByteArray
    stretch: float  # Mean number of the image's levels for each level of the camera's picture


ExposeRows: TypeAlias = Callable[[NDArray[np.bool_], int], Mapping[str, FloatArray]]
"""Exposes the marked rows, shape (rows,), of the whole picture so many times with other noise, or
once without any, and returns column means by name, each of shape (times, columns)."""


def draft_errors(
    panel: DraftedPanel, means: Mapping[str, DraftedMeans], expose: ExposeRows
) -> dict[str, float]:
    """Return the RMS sampling errors of a draft's columns on the panel, in grey levels, by name."""
    whole = [ends[panel.columns] for ends in column_spans(panel.outline, *panel.size)]
    first, last = (_count_rows_before(ends, panel.rows) for ends in whole)
    seen = whole[1] > whole[0]
    guard = math.ceil(_BLUR_REACH * panel.blur / panel.rows.step)
    short = seen & ((last - guard) // _BLOCK + -(first + guard) // _BLOCK < _FEWEST_PARTS)
    shown = _mark_rows(whole[0][short], whole[1][short], panel.size[0])
    exposed = expose(shown, _exposures(int(short.sum()))) if short.any() else {}
    return {
        name: _estimate_error(panel, own, (first, last, guard), seen, short, exposed.get(name))
        for name, own in means.items()
    }


def _exposures(columns: int) -> int:
    """Return how often columns are exposed: the fewer they are, the more often."""
    return min(_MOST_EXPOSURES, 1 + math.ceil(_DIFFERENCES * _BLOCK / columns))


def _mark_rows(first: IndexArray, last: IndexArray, rows: int) -> NDArray[np.bool_]:
    """Mark the rows that are in any of the ranges from a first row to before a last one."""
    steps = np.zeros(rows + 1, dtype=np.int64)
    np.add.at(steps, first, 1)
    np.add.at(steps, last, -1)
    return np.asarray(np.cumsum(steps)[:-1] > 0)


def _estimate_error(
    panel: DraftedPanel,
    drafted: DraftedMeans,
    rows: tuple[IndexArray, IndexArray, int],
    seen: NDArray[np.bool_],
    short: NDArray[np.bool_],
    exposed: FloatArray | None,
) -> float:
    first, last, guard = rows
    step = panel.rows.step
    means = drafted.means[panel.columns]
    swing = float(np.ptp(np.concatenate([drafted.levels, means])))
    top, bottom = int(first.min()) // _BLOCK * _BLOCK, int(last.max())
    crop = np.ascontiguousarray(drafted.image[top:bottom, panel.columns])
    variance, rim = _compare_parts(crop, means, first - top, last - top, guard)
    # Rounding steps that happen to be in no pair of parts of the draft.
    rounding = panel.rounding * drafted.stretch
    variance += rounding**2 / np.maximum((last - first) / _BLOCK, 1.0)
    # Rows of the blurred rim that are not in the draft at all.
    rim += swing * np.minimum(4.0 * panel.blur / np.maximum(step * (last - first), 1), 1.0)
    if exposed is not None:
        variance[short], rim[short] = _compare_with_all_rows(
            exposed[:, panel.columns], means, short, rounding
        )
    count = max(len(means) / _BLOCK, 1.0)
    margin = 1.0 + _DEVIATIONS_ADDED / math.sqrt(2.0 * count)
    random = margin * math.sqrt((1.0 + 1.0 / step) * float(variance[seen].sum()) / len(means))
    return min(random + math.sqrt(float((rim[seen] ** 2).sum()) / len(means)), WHITE)


def _compare_with_all_rows(
    exposed: FloatArray, means: FloatArray, short: NDArray[np.bool_], rounding: float
) -> tuple[FloatArray, FloatArray]:
    """Return the variance of short columns' means in the picture, and the draft's difference."""
    own = exposed[:, short]
    times, off = len(own), np.abs(means[short] - own.mean(axis=0))
    if times == 1:  # without noise all exposures are alike
        return np.zeros(len(off)), off
    # By chance all exposures may lie on the same side of a file's step, and the picture beyond: in
    # a few blocks, since of many some would have lain there.
    beyond = rounding * math.sqrt(min(_BLOCKS_BEYOND * _BLOCK / len(off), 1.0))
    return own.var(axis=0, ddof=1) * (1.0 + 1.0 / times), np.hypot(off, beyond)


def _count_rows_before(places: IndexArray, rows: range) -> IndexArray:
    return np.clip(-(-(places - rows.start) // rows.step), 0, len(rows))


def _compare_parts(
    image: ByteArray, means: FloatArray, first: IndexArray, last: IndexArray, guard: int
) -> tuple[FloatArray, FloatArray]:
    """Estimate the variance of each column's mean from successive parts, and the rim's error.

    They are NaN and 0 for a column with fewer than two whole parts inside the panel.
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
    enough = number >= _FEWEST_PARTS
    variance = np.full(image.shape[1], np.nan)
    variance[enough] = (squares / 2.0)[enough] / (number - 1)[enough] / number[enough]
    within = np.where(inside, parts, 0.0).sum(axis=0) / np.maximum(number, 1)
    return variance, np.where(enough, np.abs(means - within), 0.0)
