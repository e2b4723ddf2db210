"""Products of long, narrow matrices, without the threads of a matrix library.

A library starts its threads for products of this size, and waiting for them takes longer than the
product itself. It starts none for a small block.
"""

import numpy as np

from occ_model.arrays import FloatArray

_MOST_PRODUCTS = 200_000  # of numbers in a block; OpenBLAS starts threads from 262,144 on


def products_of(parts: FloatArray) -> FloatArray:
    """Return the products of all pairs of columns, shape (columns, columns)."""
    rows, columns = parts.shape
    step = max(1, _MOST_PRODUCTS // columns**2)
    total = np.zeros((columns, columns))
    for first in range(0, rows, step):
        block = parts[first : first + step]
        total += block.T @ block
    return total


def least_squares(parts: FloatArray, values: FloatArray) -> FloatArray:
    """Return the factors of columns whose sum is nearest to some values, by normal equations."""
    products = products_of(parts)
    products.flat[:: len(products) + 1] *= 1.0 + 1e-9
    return np.asarray(np.linalg.solve(products, parts.T @ values), dtype=np.float64)
