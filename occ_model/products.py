"""Inner products of long vectors on the calling thread alone.

BLAS starts threads even for products that take less time than starting them. Their cost shows in
processor time, and in wall time where other processes want the cores. These functions multiply in
parts that are too small for threads, whatever the settings of the process.
"""

import math

import numpy as np

from occ_model.arrays import FloatArray

MOST_MULTIPLIED = 2**18
"""Most multiplications in a product of matrices for which OpenBLAS takes one thread."""

_MOST_TERMS = MOST_MULTIPLIED // 2  # multiplications in one part of a product
_DEPENDENT = 1e-13  # squared distance of a unit row from the span of the others that counts as 0
_SQUARINGS = 20  # after which an eigenvalue 1e-5 below the largest has 3e-5 of its weight
_LONGEST_DOT = 2**13  # elements of the vectors; OpenBLAS takes one thread up to 10,000


def dot(first: FloatArray, second: FloatArray) -> float:
    """Return the inner product of two vectors."""
    parts = range(0, len(first), _LONGEST_DOT)
    return float(sum(first[i : i + _LONGEST_DOT] @ second[i : i + _LONGEST_DOT] for i in parts))


def row_products(values: FloatArray, rows: FloatArray) -> FloatArray:
    """Return the inner product of values, or of several, with each of some rows.

    ``values``: shape (columns,) or (any, columns). ``rows``: shape (rows, columns). The products
    have the shape (rows,) or (any, rows).
    """
    step = max(1, _MOST_TERMS // max(1, len(rows) * (len(values) if values.ndim > 1 else 1)))
    product = np.asarray(values[..., :step] @ rows[:, :step].T)
    for start in range(step, rows.shape[1], step):
        part = slice(start, start + step)
        product += values[..., part] @ rows[:, part].T
    return product


def combine(weights: FloatArray, rows: FloatArray) -> FloatArray:
    """Return sums of weighted rows, for weights of shape (rows,) or several, (any, rows)."""
    step = max(1, _MOST_TERMS // max(1, weights.size))
    if rows.shape[1] <= step:
        return np.asarray(weights @ rows)
    starts = range(0, rows.shape[1], step)
    return np.concatenate([weights @ rows[:, i : i + step] for i in starts], axis=-1)


def orthonormalize(rows: FloatArray) -> FloatArray:
    """Return orthonormal rows with the same span.

    A row that is a combination of others is replaced by one of nearly 0.
    """
    norms = np.sqrt(np.einsum("ij,ij->i", rows, rows))
    rows = rows / np.maximum(norms, np.finfo(float).tiny)[:, None]
    products = row_products(rows, rows) + _DEPENDENT * np.eye(len(rows))
    # LAPACK has decompositions that are more exact, but their threads cost a hundred times as much
    # as the decomposition.
    return combine(np.linalg.inv(np.linalg.cholesky(products)), rows)


def leading_direction(products: FloatArray) -> FloatArray:
    """Return the eigenvector of the largest eigenvalue of a matrix of products, of norm 1."""
    power = products / max(float(np.trace(products)), np.finfo(float).tiny)
    for _ in range(_SQUARINGS):
        power = row_products(power, power)
        power /= max(float(np.trace(power)), np.finfo(float).tiny)
    longest = power[int(np.diag(power).argmax())]
    return np.asarray(longest / max(math.sqrt(dot(longest, longest)), np.finfo(float).tiny))


def quadratic_forms(vectors: FloatArray, matrix: FloatArray) -> FloatArray:
    """Return v' M v for each row v of ``vectors`` and a symmetric matrix M."""
    step = max(1, MOST_MULTIPLIED // matrix.size)
    parts = (vectors[i : i + step] for i in range(0, len(vectors), step))
    return np.concatenate([np.einsum("ij,ij->i", part @ matrix, part) for part in parts])


def solve_positive_definite(matrix: FloatArray, sums: FloatArray) -> FloatArray:
    """Solve a positive definite system; LAPACK would start threads for a hundred equations."""
    both = np.column_stack([matrix, sums])
    for place, row in enumerate(both):
        row /= row[place]
        factors = both[:, place].copy()
        factors[place] = 0.0
        both -= np.outer(factors, row)
    return both[:, -1]


def least_squares(parts: FloatArray, values: FloatArray) -> FloatArray:
    """Fit a sum of weighted columns to some values by normal equations; return the weights."""
    products = row_products(parts.T, parts.T)
    products.flat[:: len(products) + 1] *= 1.0 + 1e-9
    return np.asarray(np.linalg.solve(products, parts.T @ values), dtype=np.float64)


def two_factors(parts: FloatArray, values: FloatArray) -> FloatArray:
    """Fit a sum of two weighted columns to some values; return the weights, none below 0.

    No number in ``parts`` is below 0. ``scipy.optimize.nnls`` does this too, but takes 0.2 s to
    import.
    """
    products, towards = parts.T @ parts, parts.T @ values
    both = np.linalg.lstsq(products, towards, rcond=None)[0]
    if both.min() >= 0.0:
        return np.asarray(both, dtype=np.float64)
    # One weight is 0: that of the column that alone explains less.
    alone = np.maximum(towards, 0.0) / np.maximum(np.diag(products), 1e-300)
    is_better = np.arange(2) == np.argmax(alone * towards)
    return np.where(is_better, alone, 0.0)
