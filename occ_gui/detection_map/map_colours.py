"""Colours of a map: evenly spaced to the eye, and told apart by colour-blind eyes too."""

from functools import cache

import numpy as np
import pyqtgraph as pg
from PySide6.QtGui import QImage

from occ_model.arrays import ByteArray, FloatArray

RATES, DIFFERENCES = "viridis", "CET-CBD1"
"""The colour maps of rates, and of their differences."""

_STEPS = 256


@cache
def colour_table(name: str) -> ByteArray:
    """Give the colours of a colour map from its lower end, shape (256, 3)."""
    return np.asarray(pg.colormap.get(name).getLookupTable(nPts=_STEPS, alpha=False))


def painted(values: FloatArray, low: float, high: float, name: str) -> ByteArray:
    """Give each value its colour.

    Parameters
    ----------
    values : ndarray of float64, shape (points along x, points along y)
        What is no number becomes transparent.
    low, high
        The values at both ends of the colour map.
    name
        The colour map.

    Returns
    -------
    ndarray of uint8, shape (points along x, points along y, 4)
    """
    there = np.isfinite(values)
    share = np.where(there, (values - low) / (high - low), 0.0)
    steps = np.rint(np.clip(share, 0.0, 1.0) * (_STEPS - 1)).astype(np.int64)
    colours = np.empty((*values.shape, 4), dtype=np.uint8)
    colours[..., :3] = colour_table(name)[steps]
    colours[..., 3] = np.where(there, 255, 0)
    return colours


def image_of(colours: ByteArray) -> QImage:
    """Make a picture of colours, the first along y at the bottom."""
    rows = np.ascontiguousarray(colours.transpose(1, 0, 2)[::-1])
    height, width = rows.shape[:2]
    image = QImage(rows.data, width, height, 4 * width, QImage.Format.Format_RGBA8888)
    return image.copy()  # the array's memory goes with it
