"""Extract the signal of a picture: the panel's place, column means, and Otsu's threshold."""

import math

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.camera.photometry import FLAT_SPAN
from occ_model.products import dot
from occ_model.results.decoding import Location, Region

_BINS = 256

MAX_UNEXPLAINED = 0.05
"""Maximum fraction of a signal's variance that neither its model nor noise explains.

It was up to 3 % for packets that the equalizer read correctly, and mostly above 7 % for wrong ones.
"""

_MIN_VARIANCE = 1e-8  # of a signal, with full light as 1: a smaller one may be a model's error

_MAX_SUM_ROWS = 2**23  # most rows whose sum of bytes fits a 32-bit integer


def column_means(image: ByteArray, region: Region) -> FloatArray:
    """Return the mean grey level of each column of a region."""
    part = region.crop(image)
    sums = np.zeros(region.columns)
    for first in range(0, region.rows, _MAX_SUM_ROWS):
        rows = part[first : first + _MAX_SUM_ROWS]
        sums += cv2.reduce(rows, 0, cv2.REDUCE_SUM, dtype=cv2.CV_32S)[0]
    return sums / region.rows


_WHITE_PIXELS = 0.9  # fraction of a white column, as a region can include rows beside the panel


def white_fraction(image: ByteArray, region: Region, *, is_enhanced: bool) -> float | None:
    """Return the fraction of a region's columns whose pixels are nearly all white.

    Returns None if the enhancement may be the cause: without noise, it makes the brightest columns
    of a picture white.
    """
    part = region.crop(image)
    is_white = np.mean(part == np.iinfo(image.dtype).max, axis=0) >= _WHITE_PIXELS
    has_noise = np.any(np.ptp(part[:, ~is_white], axis=0))
    if is_enhanced and not has_noise:
        return None
    return float(is_white.mean())


def explain_flat(signal: FloatArray) -> str | None:
    """Return a sentence if a signal is too flat to show stripes; None otherwise."""
    swing = float(signal.max() - signal.min())
    if swing >= FLAT_SPAN:
        return None
    return f"No stripes: the signal spans only {swing:.2g} grey levels."


def otsu_split(counts: IndexArray) -> int | None:
    """Find the last bin of the lower class of a histogram; None if fewer than two bins are filled.

    The split maximises the variance between the classes (Otsu, IEEE Trans. SMC 9:62, 1979). If
    several splits do, for example with empty bins between the classes, the middle one is taken.
    """
    filled = np.flatnonzero(counts)
    if filled.size < 2:
        return None
    first = filled[0]
    # Sums from both ends about the middle, so that a small class keeps its digits beside a large
    # one, and a mirrored histogram gives the same numbers.
    counts = counts[first : filled[-1] + 1].astype(np.float64)
    moments = counts * (np.arange(len(counts)) - 0.5 * (len(counts) - 1))
    below, above = np.cumsum(counts)[:-1], np.cumsum(counts[::-1])[-2::-1]
    means = np.cumsum(moments)[:-1] / below, np.cumsum(moments[::-1])[-2::-1] / above
    class_variance = below * above * (means[1] - means[0]) ** 2
    best = np.flatnonzero(class_variance >= class_variance.max() * (1.0 - 1e-12))
    return int(first + best[len(best) // 2])


def otsu_threshold(signal: FloatArray) -> float:
    """Find the grey level that separates ones from zeros in a signal, with 256 bins."""
    low, high = float(signal.min()), float(signal.max())
    bins = np.rint((signal - low) * ((_BINS - 1) / (high - low))).astype(np.int64)
    split = otsu_split(np.bincount(bins, minlength=_BINS))
    assert split is not None  # noqa: S101 - the first and the last bin are filled
    return low + (split + 0.5) * (high - low) / (_BINS - 1)


def unexplained_fraction(signal: FloatArray, residual: FloatArray) -> float:
    """Return the fraction of a signal's variance that neither its model nor noise explains.

    Noise is independent from value to value; a correlation of neighbours is not noise.
    """
    centred_residual, centred_signal = residual - residual.mean(), signal - signal.mean()
    return dot(centred_residual[1:], centred_residual[:-1]) / max(
        dot(centred_signal, centred_signal), _MIN_VARIANCE * len(signal)
    )


_MAX_GRID_CELLS = 512  # maximum number of cells on a side of the grid on which contours grow

_MIN_BRIGHT_FRACTION = 0.04  # least fraction of bright pixels in a contour's cell; less is noise


def locate(image: ByteArray, bright_fraction: float) -> Location | None:
    """Find the panel's rectangle by the paper's method; None in an image of one level.

    The brightest pixels that cover ``bright_fraction`` of the area are selected, their contours are
    grown until they merge into one, and its bounding rectangle is the region. Two details are not
    given in the paper. A pixel below the image's Otsu threshold never counts as bright, because a
    distant panel has fewer bright pixels. The rectangle bounds the bright pixels within the grown
    contour, so that growth does not extend it into the surroundings.
    """
    level = bright_level(_histogram(image), bright_fraction)
    if level is None:
        return None
    bright = _select_above(image, level - 1)
    rows, columns = image.shape
    grid_size = grid_size_of(rows, columns)[::-1]
    fraction = np.asarray(
        cv2.resize(bright, grid_size, interpolation=cv2.INTER_AREA), dtype=np.uint8
    )
    cells = _select_above(fraction, 255 * _MIN_BRIGHT_FRACTION)
    if not cv2.hasNonZero(cells):
        cells = _select_above(fraction, 0)
    if not cv2.hasNonZero(cells):  # too few for a fraction of 1/255 in any cell
        return Location(_bounds(bright, Region(0, rows, 0, columns)), level, 1, 0)
    x, y, width, height = cv2.boundingRect(cells)
    scale_y, scale_x = rows / grid_size[1], columns / grid_size[0]
    search_area = Region(
        max(0, int((y - 1) * scale_y)),
        min(rows, int((y + height + 1) * scale_y)),
        max(0, int((x - 1) * scale_x)),
        min(columns, int((x + width + 1) * scale_x)),
    )
    growth = _find_merging_growth(cells)
    return Location(
        _bounds(bright, search_area),
        level,
        _count_contours(cells),
        growth * _cell_size(rows, columns),
    )


def _cell_size(rows: int, columns: int) -> int:
    """Return the number of pixels along the side of a cell of the grid."""
    return -(-max(rows, columns) // _MAX_GRID_CELLS)


def grid_size_of(rows: int, columns: int) -> tuple[int, int]:
    """Return the numbers of rows and columns of the grid on which contours are grown."""
    cell = _cell_size(rows, columns)
    return -(-rows // cell), -(-columns // cell)


def least_bright_fraction() -> float:
    """Return the bright fraction above which a cell, rounded to 8 bits, is part of a contour."""
    return (math.floor(255 * _MIN_BRIGHT_FRACTION) + 0.5) / 255.0


def _histogram(image: ByteArray) -> IndexArray:
    counts = np.zeros(256, dtype=np.int64)
    # OpenCV counts in single precision, which is exact only up to 2^24.
    rows = max(1, 2**24 // image.shape[1])
    for first in range(0, len(image), rows):
        part = cv2.calcHist([image[first : first + rows]], [0], None, [256], [0, 256])
        counts += part.ravel().astype(np.int64)
    return counts


def bright_level(counts: IndexArray, bright_fraction: float) -> int | None:
    """Return the grey level from which a pixel counts as bright; None if all are equal."""
    split = otsu_split(counts)
    if split is None:
        return None
    pixels_from_level = np.cumsum(counts[::-1])[::-1]
    bright_pixels = bright_fraction * counts.sum()
    return max(int(np.flatnonzero(pixels_from_level >= bright_pixels)[-1]), split + 1)


def _select_above(image: ByteArray, level: float) -> ByteArray:
    return np.asarray(cv2.threshold(image, level, 255, cv2.THRESH_BINARY)[1], dtype=np.uint8)


def _count_contours(cells: ByteArray) -> int:
    return int(cv2.connectedComponents(cells)[0]) - 1  # without the background


def _find_merging_growth(cells: ByteArray) -> int:
    """Find the smallest growth in cells that merges the contours into one."""

    def merges(growth: int) -> bool:
        kernel = np.ones((2 * growth + 1, 2 * growth + 1), dtype=np.uint8)
        return _count_contours(np.asarray(cv2.dilate(cells, kernel), dtype=np.uint8)) == 1

    if merges(0):
        return 0
    high = 1
    while not merges(high):
        high *= 2
    low = high // 2
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if merges(middle) else (middle, high)
    return high


def _bounds(bright: ByteArray, area: Region) -> Region:
    """Return the bounding rectangle of the bright pixels in a part of the image."""
    part = area.crop(bright)
    x, y, width, height = cv2.boundingRect(part)
    top, left = area.first_row + y, area.first_column + x
    return Region(top, top + height, left, left + width)
