"""Inner products of long vectors on the calling thread alone.

BLAS starts threads for products that take less time than the threads; what they cost is seen in
processor time, and in wall time where other processes want the cores. Products in parts stay below
the size at which it does, whatever the settings of the process.
"""

import math

import numpy as np

from occ_model.arrays import FloatArray

MOST_MULTIPLIED = 2**18
"""Multiplications of a product of matrices up to which OpenBLAS takes one thread."""

_MOST_TERMS = MOST_MULTIPLIED // 2  # of a product here
_DEPENDENT = 1e-13  # squared distance of a unit row from the others' combinations that is none
_SQUARINGS = 20  # of a matrix, after which eigenvalues a millionth smaller than the first are gone
_LONGEST_DOT = 2**13  # of two vectors; OpenBLAS takes one thread up to 10,000


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


def combined(weights: FloatArray, rows: FloatArray) -> FloatArray:
    """Return sums of weighted rows, for weights of shape (rows,) or several, (any, rows)."""
    step = max(1, _MOST_TERMS // max(1, weights.size))
    if rows.shape[1] <= step:
        return np.asarray(weights @ rows)
    starts = range(0, rows.shape[1], step)
    return np.concatenate([weights @ rows[:, i : i + step] for i in starts], axis=-1)


def orthonormal(rows: FloatArray) -> FloatArray:
    """Return orthonormal rows of which the same combinations can be made.

    In place of a row that is a combination of others, one of nearly 0 is returned.
    """
    norms = np.sqrt(np.einsum("ij,ij->i", rows, rows))
    rows = rows / np.maximum(norms, np.finfo(float).tiny)[:, None]
    products = row_products(rows, rows) + _DEPENDENT * np.eye(len(rows))
    # Not by the decompositions of LAPACK that are more exact, since their threads cost a hundred
    # times as much as they do.
    return combined(np.linalg.inv(np.linalg.cholesky(products)), rows)


def leading_direction(products: FloatArray) -> FloatArray:
    """Return the eigenvector of the largest eigenvalue of a matrix of products, of norm 1."""
    power = products / max(float(np.trace(products)), np.finfo(float).tiny)
    for _ in range(_SQUARINGS):
        power = row_products(power, power)
        power /= max(float(np.trace(power)), np.finfo(float).tiny)
    longest = power[int(np.diag(power).argmax())]
    return np.asarray(longest / max(math.sqrt(dot(longest, longest)), np.finfo(float).tiny))


def quadratic_forms(vectors: FloatArray, matrix: FloatArray) -> FloatArray:
    """Return v' M v of each of some vectors, which are rows, and a symmetric matrix M."""
    step = max(1, MOST_MULTIPLIED // matrix.size)
    parts = (vectors[i : i + step] for i in range(0, len(vectors), step))
    return np.concatenate([np.einsum("ij,ij->i", part @ matrix, part) for part in parts])


def solved_positive(matrix: FloatArray, sums: FloatArray) -> FloatArray:
    """Solve the equations of a positive definite matrix; LAPACK starts threads for a hundred."""
    both = np.column_stack([matrix, sums])
    for place, row in enumerate(both):
        row /= row[place]
        factors = both[:, place].copy()
        factors[place] = 0.0
        both -= np.outer(factors, row)
    return both[:, -1]


def least_squares(parts: FloatArray, values: FloatArray) -> FloatArray:
    """Return the factors of columns whose sum is nearest to some values, by normal equations."""
    products = row_products(parts.T, parts.T)
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
