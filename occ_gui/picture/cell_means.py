"""The means of an image's pixels over the cells of a grid, wherever the image lies on it."""

import cv2
import numpy as np
from PySide6.QtCore import QRectF

from occ_model.arrays import ByteArray, FloatArray


def cell_means(image: ByteArray, rect: QRectF, grid: QRectF, shape: tuple[int, int]) -> FloatArray:
    """Average an image over the cells of a grid.

    So two images of different sizes are compared without false stripes: each cell holds the exact
    mean of what lies under it, parts of pixels by their share.

    Parameters
    ----------
    image : ndarray of uint8, shape (rows, columns)
        The image.
    rect
        Where it lies.
    grid
        Where the grid lies: within ``rect``.
    shape
        Rows and columns of the grid.

    Returns
    -------
    ndarray of float64, shape ``shape``
        The means in grey levels.
    """
    rows, columns = image.shape
    x = _edges(grid.left() - rect.left(), grid.width(), columns / rect.width(), shape[1], columns)
    y = _edges(grid.top() - rect.top(), grid.height(), rows / rect.height(), shape[0], rows)
    # At least one pixel, also of a grid that only touches the image's edge.
    left, top = min(int(x[0]), columns - 1), min(int(y[0]), rows - 1)
    right, bottom = max(int(np.ceil(x[-1])), left + 1), max(int(np.ceil(y[-1])), top + 1)
    pixels = image[top:bottom, left:right]
    pixels, x, y = _halved(pixels, x - left, y - top)
    # Between its corners the running integral of square pixels is bilinear, so this is exact.
    integral = cv2.integral(np.ascontiguousarray(pixels), sdepth=cv2.CV_64F)
    total = _interpolated(_interpolated(np.asarray(integral, dtype=np.float64), y).T, x).T
    area = np.outer(np.diff(y), np.diff(x))
    means = np.diff(np.diff(total, axis=0), axis=1) / np.maximum(area, 1e-12)
    return np.asarray(means, dtype=np.float64)


def _edges(start: float, width: float, scale: float, cells: int, pixels: int) -> FloatArray:
    edges = (start + width * np.arange(cells + 1) / cells) * scale
    return np.asarray(np.clip(edges, 0.0, pixels), dtype=np.float64)


def _halved(
    pixels: ByteArray, x: FloatArray, y: FloatArray
) -> tuple[ByteArray, FloatArray, FloatArray]:
    """Halve an image, which is fast, as often as a cell still spans two pixels each way."""
    while min(_span(x), _span(y)) >= 4.0 and min(pixels.shape) >= 2:
        half = (pixels.shape[1] // 2, pixels.shape[0] // 2)
        even = pixels[: 2 * half[1], : 2 * half[0]]
        pixels = np.asarray(cv2.resize(even, half, interpolation=cv2.INTER_AREA), dtype=np.uint8)
        x, y = np.minimum(x / 2, half[0]), np.minimum(y / 2, half[1])
    return pixels, x, y


def _span(edges: FloatArray) -> float:
    """Say how many pixels a cell spans."""
    return float(edges[-1] - edges[0]) / (len(edges) - 1)


def _interpolated(values: FloatArray, places: FloatArray) -> FloatArray:
    """Interpolate between the rows of an array."""
    below = np.minimum(places.astype(np.intp), len(values) - 2)
    share = (places - below)[:, None]
    return np.asarray(values[below] * (1 - share) + values[below + 1] * share, dtype=np.float64)
