"""Inner products in parts are those of whole vectors."""

import numpy as np
import pytest

from occ_model.products import dot, row_products


@pytest.mark.parametrize("length", [0, 1, 8191, 8192, 8193, 50_000])
def test_products_in_parts_are_those_of_whole_vectors(length: int) -> None:
    random = np.random.default_rng(length)
    first, second = random.normal(size=(9, length)), random.normal(size=(4, length))
    whole = (first[:, None] * second).sum(axis=2)
    np.testing.assert_allclose(
        row_products(first, second), whole, rtol=0, atol=1e-12 * (1 + length)
    )
    assert dot(first[0], second[0]) == pytest.approx(whole[0, 0], abs=1e-12 * (1 + length))
