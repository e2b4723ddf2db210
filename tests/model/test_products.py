"""Inner products in parts are those of whole vectors."""

import numpy as np
import pytest

from occ_model.products import (
    combine,
    dot,
    leading_direction,
    orthonormalize,
    quadratic_forms,
    row_products,
    solve_positive_definite,
)


@pytest.mark.parametrize("length", [0, 1, 8191, 8192, 8193, 50_000])
def test_products_in_parts_are_those_of_whole_vectors(length: int) -> None:
    random = np.random.default_rng(length)
    first, second = random.normal(size=(9, length)), random.normal(size=(4, length))
    weights = random.normal(size=(5, 9))
    off = 1e-12 * (1 + length)
    whole = (first[:, None] * second).sum(axis=2)
    mixed = (weights[:, :, None] * first).sum(axis=1)
    assert dot(first[0], second[0]) == pytest.approx(whole[0, 0], abs=off)
    np.testing.assert_allclose(row_products(first, second), whole, rtol=0.0, atol=off)
    np.testing.assert_allclose(row_products(first[2], second), whole[2], rtol=0.0, atol=off)
    np.testing.assert_allclose(combine(weights, first), mixed, rtol=0.0, atol=off)
    np.testing.assert_allclose(combine(weights[1], first), mixed[1], rtol=0.0, atol=off)


def test_orthonormal_rows_span_what_the_rows_span_also_where_one_is_superfluous() -> None:
    rows = np.random.default_rng(3).normal(size=(5, 40)) * [[1.0], [1e-3], [1e3], [1.0], [1.0]]
    basis = orthonormalize(rows)
    np.testing.assert_allclose(basis @ basis.T, np.eye(5), atol=1e-6)
    np.testing.assert_allclose((rows @ basis.T) @ basis, rows, atol=1e-9 * np.abs(rows).max())
    again = orthonormalize(np.vstack([rows[2:], rows[2] - rows[3]]))
    np.testing.assert_allclose((rows[3] @ again.T) @ again, rows[3], atol=1e-6)
    assert np.linalg.norm(again, axis=1).max() < 1.0 + 1e-6


@pytest.mark.parametrize("lead", [1.0, 1e-150, 1e150])
def test_the_leading_direction_is_that_of_the_largest_eigenvalue(lead: float) -> None:
    turned = np.linalg.qr(np.random.default_rng(4).normal(size=(20, 20)))[0]
    values = lead * np.append(np.linspace(0.0, 0.999, 19), 1.0)
    found = leading_direction((turned * values) @ turned.T)
    assert abs(found @ turned[:, -1]) == pytest.approx(1.0, abs=1e-9)
    assert not leading_direction(np.zeros((3, 3))).any()


def test_a_positive_matrix_is_solved_and_gives_its_quadratic_forms() -> None:
    random = np.random.default_rng(5)
    rows, vectors = random.normal(size=(150, 160)), random.normal(size=(40, 150))
    matrix, wanted = rows @ rows.T, random.normal(size=150)
    assert solve_positive_definite(matrix, matrix @ wanted) == pytest.approx(wanted, abs=1e-6)
    lengths = ((vectors @ rows) ** 2).sum(axis=1)
    assert quadratic_forms(vectors, matrix) == pytest.approx(lengths)
