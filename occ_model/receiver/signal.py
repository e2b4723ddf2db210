"""From a picture to a signal: the panel's place, column means, Otsu's threshold of both."""

import math

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.camera.photometry import FLAT_SPAN
from occ_model.results.decoding import Location, Region

_BINS = 256

MAX_UNEXPLAINED = 0.05
"""Fraction of a signal's variance, neither its model's nor noise, above which it is another's.

Of packets that the equalizer had read correctly up to 3 %, of wrong ones as a rule more than 7 %.
"""

_MIN_VARIANCE = 1e-8  # of light in fractions of full light: no model is more exact

_WHOLE_ROWS = 2**23  # most rows whose sum of bytes fits an integer of 32 bits


def column_means(image: ByteArray, region: Region) -> FloatArray:
    """Average each column of a region, in grey levels."""
    part = region.crop(image)
    sums = np.zeros(region.columns)
    for first in range(0, region.rows, _WHOLE_ROWS):
        rows = part[first : first + _WHOLE_ROWS]
        sums += cv2.reduce(rows, 0, cv2.REDUCE_SUM, dtype=cv2.CV_32S)[0]
    return sums / region.rows


_WHITE_PIXELS = 0.9  # of a white column's: a region can hold some rows beside the panel


def white_fraction(image: ByteArray, region: Region, *, is_enhanced: bool) -> float | None:
    """Return the fraction of a region's columns that are white, but for a margin of their pixels.

    None where that may be an enhancement's doing: it makes the brightest columns of a picture
    without noise white.
    """
    part = region.crop(image)
    whites = np.mean(part == np.iinfo(image.dtype).max, axis=0) >= _WHITE_PIXELS
    if is_enhanced and not np.any(np.ptp(part[:, ~whites], axis=0)):
        return None
    return float(whites.mean())


def why_flat(signal: FloatArray) -> str | None:
    """Return a sentence if a signal is too flat to show stripes, else None."""
    swing = float(signal.max() - signal.min())
    if swing >= FLAT_SPAN:
        return None
    return f"No stripes: the signal spans only {swing:.2g} grey levels."


def otsu_split(counts: IndexArray) -> int | None:
    """Find the last bin of the lower class of a histogram; None where fewer than two are filled.

    The split maximises the variance between the classes (Otsu, IEEE Trans. SMC 9:62, 1979). Where
    several splits do, as when empty bins lie between the classes, the middle one is taken.
    """
    filled = np.flatnonzero(counts)
    if filled.size < 2:
        return None
    first = filled[0]
    # Summed from both ends, about the middle: the smallest class keeps its digits beside a large
    # one, and a histogram and its mirror image give the same numbers.
    counts = counts[first : filled[-1] + 1].astype(np.float64)
    moments = counts * (np.arange(len(counts)) - 0.5 * (len(counts) - 1))
    below, above = np.cumsum(counts)[:-1], np.cumsum(counts[::-1])[-2::-1]
    means = np.cumsum(moments)[:-1] / below, np.cumsum(moments[::-1])[-2::-1] / above
    between = below * above * (means[1] - means[0]) ** 2
    best = np.flatnonzero(between >= between.max() * (1.0 - 1e-12))
    return int(first + best[len(best) // 2])


def otsu_threshold(signal: FloatArray) -> float:
    """Find the grey level, in 256 bins, that separates ones from zeros in a signal."""
    low, high = float(signal.min()), float(signal.max())
    bins = np.rint((signal - low) * ((_BINS - 1) / (high - low))).astype(np.int64)
    split = otsu_split(np.bincount(bins, minlength=_BINS))
    assert split is not None  # noqa: S101 - the first bin and the last are filled
    return low + (split + 0.5) * (high - low) / (_BINS - 1)


def unexplained_fraction(signal: FloatArray, residual: FloatArray) -> float:
    """Return the fraction of a signal's variance that its model leaves, without the noise.

    Noise differs from each value to the next; what is common to neighbours is not noise.
    """
    left, seen = residual - residual.mean(), signal - signal.mean()
    return float(left[1:] @ left[:-1]) / max(float(seen @ seen), _MIN_VARIANCE * len(signal))


_MAX_GRID_CELLS = 512  # maximum cells on a side of the grid on which contours grow

_MIN_BRIGHT_FRACTION = 0.04  # of bright pixels in a cell of a contour; below it they are noise


def locate(image: ByteArray, bright_fraction: float) -> Location | None:
    """Find the rectangle round the panel, as the paper describes it; None in an even image.

    The brightest pixels that cover ``bright_fraction`` of the area are selected; their contours are
    grown until only one is left; its bounding rectangle is the region. The paper leaves two things
    open. Here a pixel darker than the image's Otsu threshold never counts as bright, as a panel far
    away has fewer bright pixels. And the rectangle is that of the bright pixels in the grown
    contour, which growth does not extend into the surroundings: growth, a measure of the distance
    between contours, does not change it.
    """
    level = bright_level(_histogram(image), bright_fraction)
    if level is None:
        return None
    bright = _above(image, level - 1)
    rows, columns = image.shape
    grid_size = grid_of(rows, columns)[::-1]
    fraction = np.asarray(
        cv2.resize(bright, grid_size, interpolation=cv2.INTER_AREA), dtype=np.uint8
    )
    cells = _above(fraction, 255 * _MIN_BRIGHT_FRACTION)
    if not cv2.hasNonZero(cells):
        cells = _above(fraction, 0)
    if not cv2.hasNonZero(cells):  # too few for any cell to have a fraction of 1/255
        return Location(_bounds(bright, Region(0, rows, 0, columns)), level, 1, 0)
    x, y, width, height = cv2.boundingRect(cells)
    scale_y, scale_x = rows / grid_size[1], columns / grid_size[0]
    around = Region(
        max(0, int((y - 1) * scale_y)),
        min(rows, int((y + height + 1) * scale_y)),
        max(0, int((x - 1) * scale_x)),
        min(columns, int((x + width + 1) * scale_x)),
    )
    reach = _growth_to_one(cells)
    return Location(
        _bounds(bright, around), level, _contours(cells), reach * _cell_size(rows, columns)
    )


def _cell_size(rows: int, columns: int) -> int:
    """Return the pixels along a side of a cell of the grid."""
    return -(-max(rows, columns) // _MAX_GRID_CELLS)


def grid_of(rows: int, columns: int) -> tuple[int, int]:
    """Return the number of cells, down and across, that contours of a picture are grown on."""
    cell = _cell_size(rows, columns)
    return -(-rows // cell), -(-columns // cell)


def least_bright_fraction() -> float:
    """Return the fraction of bright pixels that a cell of a contour exceeds, as a byte holds it."""
    return (math.floor(255 * _MIN_BRIGHT_FRACTION) + 0.5) / 255.0


def _histogram(image: ByteArray) -> IndexArray:
    counts = np.zeros(256, dtype=np.int64)
    # OpenCV counts in single precision, which holds no whole number above 2^24.
    rows = max(1, 2**24 // image.shape[1])
    for first in range(0, len(image), rows):
        part = cv2.calcHist([image[first : first + rows]], [0], None, [256], [0, 256])
        counts += part.ravel().astype(np.int64)
    return counts


def bright_level(counts: IndexArray, bright_fraction: float) -> int | None:
    """Return the grey level from which a pixel counts as bright; None where all are equal."""
    split = otsu_split(counts)
    if split is None:
        return None
    at_least = np.cumsum(counts[::-1])[::-1]
    wanted = bright_fraction * counts.sum()
    return max(int(np.flatnonzero(at_least >= wanted)[-1]), split + 1)


def _above(image: ByteArray, level: float) -> ByteArray:
    return np.asarray(cv2.threshold(image, level, 255, cv2.THRESH_BINARY)[1], dtype=np.uint8)


def _contours(cells: ByteArray) -> int:
    return int(cv2.connectedComponents(cells)[0]) - 1  # the background is one of them


def _growth_to_one(cells: ByteArray) -> int:
    """Find the least growth in cells that merges the contours into one."""

    def is_one(reach: int) -> bool:
        kernel = np.ones((2 * reach + 1, 2 * reach + 1), dtype=np.uint8)
        return _contours(np.asarray(cv2.dilate(cells, kernel), dtype=np.uint8)) == 1

    if is_one(0):
        return 0
    high = 1
    while not is_one(high):
        high *= 2
    low = high // 2
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if is_one(middle) else (middle, high)
    return high


def _bounds(bright: ByteArray, within: Region) -> Region:
    """Return the bounding rectangle of the bright pixels in a part of the image."""
    part = within.crop(bright)
    x, y, width, height = cv2.boundingRect(part)
    top, left = within.first_row + y, within.first_column + x
    return Region(top, top + height, left, left + width)
