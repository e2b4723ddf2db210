"""How far a draft's column means may lie from those of the whole picture.

A draft is a systematic sample of the picture's rows. Its error is estimated from the sample itself,
by the differences between successive parts of it (W. G. Cochran, *Sampling Techniques*, 1977,
chapter 8): whatever makes rows differ, noise, a file's rounding or a slow change of the light,
shows in them. The panel's rim, which such differences do not show, is added. Columns with fewer
rows than two such parts are compared with all of their rows in the picture, exposed for it.
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

_BLOCK = 8  # rows of a part: those of a block of a JPEG file, whose errors depend on each other
_FEWEST_PARTS = 2  # whose difference tells how much they differ by chance
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
    # rounding, in grey levels; 0 for no file
    rounding: float


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


ExposeRows: TypeAlias = Callable[[NDArray[np.bool_]], Mapping[str, FloatArray]]
"""Exposes some rows of the whole picture, shape (rows,), a few times with other noise: column means
by name, each of shape (times, columns)."""


def draft_errors(
    panel: DraftedPanel, means: Mapping[str, DraftedMeans], expose: ExposeRows
) -> dict[str, float]:
    """Return RMS sampling errors of a draft's columns on the panel, in grey levels, by name."""
    whole = [ends[panel.columns] for ends in column_spans(panel.outline, *panel.size)]
    first, last = (_rows_before(ends, panel.rows) for ends in whole)
    seen = whole[1] > whole[0]
    guard = math.ceil(_BLUR_REACH * panel.blur / panel.rows.step)
    short = seen & ((last - guard) // _BLOCK + -(first + guard) // _BLOCK < _FEWEST_PARTS)
    shown = _within(whole[0][short], whole[1][short], panel.size[0])
    exposed = expose(shown) if short.any() else {}
    return {
        name: _error(panel, own, (first, last, guard), seen, short, exposed.get(name))
        for name, own in means.items()
    }


def _within(first: IndexArray, last: IndexArray, rows: int) -> NDArray[np.bool_]:
    """Return which rows lie from a first to before a last one."""
    steps = np.zeros(rows + 1, dtype=np.int64)
    np.add.at(steps, first, 1)
    np.add.at(steps, last, -1)
    return np.asarray(np.cumsum(steps)[:-1] > 0)


def _error(
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
    variance, rim = _of_parts(crop, means, first - top, last - top, guard)
    # Steps that no two parts of the draft happen to be on either side of.
    rounding = panel.rounding * drafted.stretch
    variance += rounding**2 / np.maximum((last - first) / _BLOCK, 1.0)
    # Rows of the blurred rim that the draft does not show at all.
    rim += swing * np.minimum(4.0 * panel.blur / np.maximum(step * (last - first), 1), 1.0)
    if exposed is not None:
        variance[short], rim[short] = _of_all_rows(exposed[:, panel.columns], means, short)
    count = max(len(means) / _BLOCK, 1.0)
    margin = 1.0 + _DEVIATIONS_ADDED / math.sqrt(2.0 * count)
    random = margin * math.sqrt((1.0 + 1.0 / step) * float(variance[seen].sum()) / len(means))
    return min(random + math.sqrt(float((rim[seen] ** 2).sum()) / len(means)), WHITE)


def _of_all_rows(
    exposed: FloatArray, means: FloatArray, short: NDArray[np.bool_]
) -> tuple[FloatArray, FloatArray]:
    """Return the variance of short columns' means in the picture, and how far the draft is off."""
    own = exposed[:, short]
    times = len(own)
    noise = own.var(axis=0, ddof=1) * (1.0 + 1.0 / times) if times > 1 else np.zeros(own.shape[1])
    return noise, np.abs(means[short] - own.mean(axis=0))


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
    enough = number >= _FEWEST_PARTS
    variance = np.full(image.shape[1], np.nan)
    variance[enough] = (squares / 2.0)[enough] / (number - 1)[enough] / number[enough]
    within = np.where(inside, parts, 0.0).sum(axis=0) / np.maximum(number, 1)
    return variance, np.where(enough, np.abs(means - within), 0.0)
