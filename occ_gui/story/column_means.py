"""Means of a picture's columns over the pixels of a screen, and a curve's extremes over them."""

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray


def resampled(pixels: ByteArray, edges: FloatArray, rows: int) -> ByteArray:
    """Average a picture over cells of the screen, exactly, whatever their size: (rows, cells).

    ``edges``: where each cell begins and the last one ends, in columns from the left edge of the
    first; beyond the picture, this goes on with its last column.
    ``rows``: at most those of the picture are averaged, more are repeated.
    """
    height = min(rows, pixels.shape[0])
    low = cv2.resize(pixels, (pixels.shape[1], height), interpolation=cv2.INTER_AREA)
    columns = low.shape[1]
    # The running sum along each row: a cell's mean is the difference of two of its values. They
    # are whole numbers below 2^24 for as many columns as a picture can show at once, so exact.
    kind = np.float32 if 255 * columns < 2**24 else np.float64
    sums = np.zeros((height, columns + 1), dtype=kind)
    np.cumsum(low, axis=1, dtype=kind, out=sums[:, 1:])
    places = np.clip(edges, 0.0, columns)
    whole = np.minimum(places.astype(np.int64), columns - 1)
    at = sums.take(whole, axis=1)
    at += low.take(whole, axis=1) * (places - whole).astype(kind)
    means = at[:, 1:] - at[:, :-1]
    widths = np.diff(places)
    empty = widths <= 0.0
    means *= (1.0 / np.where(empty, 1.0, widths)).astype(kind)
    if empty.any():  # beyond the picture
        nearest = np.clip(np.floor(edges[:-1][empty]).astype(np.int64), 0, columns - 1)
        means[:, empty] = low[:, nearest]
    means += 0.5
    found = means.astype(np.uint8)
    if height < rows:
        found = cv2.resize(found, (found.shape[1], rows), interpolation=cv2.INTER_NEAREST_EXACT)
    return np.ascontiguousarray(found)


def shrunk(pixels: ByteArray, rows: int, columns: int) -> ByteArray:
    """Average a picture over the cells of a much coarser grid.

    First over whole pixels, which OpenCV does many times faster than over parts of them; what is
    left over at the lower and right edge, less than half a cell, is left out.
    """
    high, wide = max(1, pixels.shape[0] // (2 * rows)), max(1, pixels.shape[1] // (2 * columns))
    height, width = pixels.shape[0] // high, pixels.shape[1] // wide
    even = pixels[: height * high, : width * wide]
    small = cv2.resize(even, (width, height), interpolation=cv2.INTER_AREA)
    small = cv2.resize(small, (columns, rows), interpolation=cv2.INTER_AREA)
    return np.asarray(small, dtype=np.uint8)


def envelope(
    positions: FloatArray, values: FloatArray, left: float, right: float, cells: int
) -> tuple[FloatArray, FloatArray]:
    """Reduce a curve of evenly spaced points to its extremes over the cells of a screen.

    What is in view and the point beyond each end are returned; of each cell with more than two
    points the lowest and the highest one, in their order.
    """
    first = max(int(np.searchsorted(positions, left)) - 1, 0)
    last = int(np.searchsorted(positions, right, side="right")) + 1
    positions, values = positions[first:last], values[first:last]
    a_cell = len(values) // max(cells, 1)
    if a_cell < 2:
        return positions, values
    groups = len(values) // a_cell
    rest = groups * a_cell
    folded = values[:rest].reshape(groups, a_cell)
    low, high = folded.argmin(axis=1), folded.argmax(axis=1)
    starts = np.arange(groups) * a_cell
    both = np.sort(np.stack([low, high], axis=1), axis=1) + starts[:, None]
    picked = np.concatenate([[0], both.ravel(), np.arange(rest, len(values)), [len(values) - 1]])
    picked = np.unique(picked)
    return positions[picked], values[picked]
