"""Interpolation of all rows of a band from a few.

In a band of rows the light changes smoothly, so that a polynomial through its values at a few nodes
gives all rows. With Chebyshev nodes the error falls geometrically with their number, and the last
coefficients of the Chebyshev series bound it (L. N. Trefethen, *Approximation Theory and
Approximation Practice*, 2013, chapters 3 and 8).
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial.chebyshev import chebvander
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, Pixels
from occ_model.products import MOST_MULTIPLIED

NODES = 6  # nodes of a band

TOLERANCE = 2e-3  # largest error of mean values in grey levels, far below that of rounding to bytes


def node_rows(rows: range) -> FloatArray:
    """Return the nodes of a band of evenly spaced rows, shape (nodes,); they are between rows."""
    first, last = rows[0], rows[-1]
    return np.asarray((first + last) / 2.0 + (last - first) / 2.0 * _nodes())


@lru_cache(maxsize=16)
def row_weights(rows: int) -> Pixels:
    """Return the weights from a band's nodes to its rows, shape (rows, nodes)."""
    weights = chebvander(np.linspace(-1.0, 1.0, rows), NODES - 1) @ _coefficients()
    return np.asarray(weights, dtype=np.float32)


def apply_weights(weights: Pixels, values: Pixels) -> Pixels:
    """Multiply weights (rows, nodes) by values (nodes, columns) as matrices.

    Some columns at a time are so few that BLAS starts no threads, which would compete with those
    that compute the bands.
    """
    width = max(MOST_MULTIPLIED // weights.size, 1)
    out = np.empty((len(weights), values.shape[1]), dtype=np.float32)
    for start in range(0, values.shape[1], width):
        columns = slice(start, start + width)
        np.matmul(weights, values[:, columns], out=out[:, columns])
    return out


def find_smooth_columns(values: Pixels, tolerance: float = TOLERANCE) -> NDArray[np.bool_]:
    """Return which columns can be interpolated from the nodes to within a tolerance."""
    last = np.abs(apply_weights(_coefficients()[-2:].astype(np.float32), values))
    return np.asarray(last.sum(axis=0) <= tolerance)


def _nodes() -> FloatArray:
    return np.cos(np.pi * (np.arange(NODES) + 0.5) / NODES)


@lru_cache(maxsize=1)
def _coefficients() -> FloatArray:
    """Return the matrix from values at nodes to Chebyshev coefficients, shape (nodes, nodes)."""
    transform = 2.0 / NODES * chebvander(_nodes(), NODES - 1).T
    transform[0] /= 2.0
    return np.asarray(transform)
