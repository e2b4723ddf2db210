"""Small solvers of a lamp's fit, compared with SciPy's."""

import numpy as np
import pytest
from scipy.interpolate import BSpline
from scipy.optimize import nnls

from occ_model.photo.lamp_fit.model import envelope_basis
from occ_model.products import two_factors


@pytest.mark.parametrize("seed", range(40))
def test_two_factors_are_those_of_non_negative_least_squares(seed: int) -> None:
    random = np.random.default_rng(seed)
    parts = random.uniform(0.0, 1.0, (30, 2)) ** random.integers(1, 6)
    values = parts @ random.normal(0.2, 1.0, 2) + random.normal(0.0, 0.3, 30)
    np.testing.assert_allclose(two_factors(parts, values), nnls(parts, values)[0], atol=1e-9)


@pytest.mark.parametrize(("count", "knots"), [(16, 2), (91, 5), (640, 30)])
def test_the_envelopes_splines_are_cubic(count: int, knots: int) -> None:
    ends = np.concatenate([np.zeros(3), np.linspace(0.0, 1.0, knots + 1), np.ones(3)])
    right = BSpline.design_matrix(np.linspace(0.0, 1.0, count), ends, 3).toarray()
    np.testing.assert_allclose(envelope_basis(count, knots), right, atol=1e-12)
