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


def two_factors(parts: FloatArray, values: FloatArray) -> FloatArray:
    """Return the factors of two columns, none below 0, whose sum is nearest to some values.

    No number in ``parts`` is below 0. SciPy's takes 0.2 s to import.
    """
    products, towards = parts.T @ parts, parts.T @ values
    both = np.linalg.lstsq(products, towards, rcond=None)[0]
    if both.min() >= 0.0:
        return np.asarray(both, dtype=np.float64)
    # Of the two factors one is 0; the other one explains more.
    alone = np.maximum(towards, 0.0) / np.maximum(np.diag(products), 1e-300)
    is_better = np.arange(2) == np.argmax(alone * towards)
    return np.where(is_better, alone, 0.0)
