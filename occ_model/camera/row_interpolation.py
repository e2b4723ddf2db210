"""Interpolation from a few rows to all rows of a band.

Within a band of rows the light changes smoothly with the row, so that a polynomial through its
values at a few nodes gives all its rows. At the Chebyshev nodes its error falls geometrically with
their number, and the last coefficients of its Chebyshev series bound it (L. N.
Trefethen, *Approximation Theory and Approximation Practice*, 2013, chapters 3 and 8).
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial.chebyshev import chebvander
from numpy.typing import NDArray

from occ_model.arrays import FloatArray, Pixels

NODES = 6  # nodes of a band

TOLERANCE = 2e-3  # largest error of mean values, in grey levels: far below rounding to bytes


def node_rows(rows: range) -> FloatArray:
    """Return the nodes of a band of evenly spaced rows, shape (nodes,): places between its rows."""
    first, last = rows[0], rows[-1]
    return np.asarray((first + last) / 2.0 + (last - first) / 2.0 * _nodes())


@lru_cache(maxsize=16)
def row_weights(rows: int) -> Pixels:
    """Return the weights from a band's nodes to its rows, shape (rows, nodes)."""
    found = chebvander(np.linspace(-1.0, 1.0, rows), NODES - 1) @ _coefficients()
    return np.asarray(found, dtype=np.float32)


def weighted(weights: Pixels, values: Pixels) -> Pixels:
    """Return the matrix product of weights (rows, nodes) and values (nodes, columns).

    Not by BLAS, whose threads wait for each other beside those that compute the bands.
    """
    return np.asarray(np.einsum("ij,jk->ik", weights, values))


def smooth_columns(values: Pixels, tolerance: float = TOLERANCE) -> NDArray[np.bool_]:
    """Return the columns whose rows follow from the nodes within a tolerance."""
    last = np.abs(weighted(_coefficients()[-2:].astype(np.float32), values))
    return np.asarray(last.sum(axis=0) <= tolerance)


def _nodes() -> FloatArray:
    return np.cos(np.pi * (np.arange(NODES) + 0.5) / NODES)


@lru_cache(maxsize=1)
def _coefficients() -> FloatArray:
    """Return the matrix from values at nodes to Chebyshev coefficients, shape (nodes, nodes)."""
    transform = 2.0 / NODES * chebvander(_nodes(), NODES - 1).T
    transform[0] /= 2.0
    return np.asarray(transform)
