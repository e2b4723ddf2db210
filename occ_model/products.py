"""Inner products of long vectors on the calling thread alone.

BLAS starts threads for products that take less time than the threads; what they cost is seen in
processor time, and in wall time where other processes want the cores. Products in parts stay below
the size at which it does, whatever the settings of the process.
"""

import numpy as np

from occ_model.arrays import FloatArray

_MOST_TERMS = 2**17  # of a product; OpenBLAS takes one thread up to 2^18
_LONGEST_DOT = 2**13  # of two vectors; OpenBLAS takes one thread up to 10,000


def dot(first: FloatArray, second: FloatArray) -> float:
    """Return the inner product of two vectors."""
    parts = range(0, len(first), _LONGEST_DOT)
    return float(sum(first[i : i + _LONGEST_DOT] @ second[i : i + _LONGEST_DOT] for i in parts))


def row_products(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the inner product of each row of one matrix with each row of another."""
    step = max(1, _MOST_TERMS // max(1, len(first) * len(second)))
    product = np.zeros((len(first), len(second)))
    for start in range(0, first.shape[1], step):
        part = slice(start, start + step)
        product += first[:, part] @ second[:, part].T
    return product
