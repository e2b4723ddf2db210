"""Scaled parameters are differences from a first guess, and have no slope at their bounds."""

import numpy as np
import pytest

from occ_model.photo.fit.scaled_parameters import ScaledParameters

FIRST = np.array([0.09, 0.6, 2.7, 0.1, 0.05, 0.2, -0.2, 0.9, 0.03])
SCALE = np.array([0.001, 0.02, 0.02, 0.12, 0.04, 0.25, 0.35, 0.5, 0.02])
GAMMA = (-0.5, 0.5)
ALL = np.arange(9)


def test_nothing_changed_is_the_first_guess() -> None:
    scaled = ScaledParameters(FIRST, ALL, SCALE, 0.09, GAMMA)
    assert scaled.values(np.zeros(9)) == pytest.approx(FIRST)


def test_only_what_is_free_changes() -> None:
    free = np.array([0, 2, 7])
    values = ScaledParameters(FIRST, free, SCALE, 0.09, GAMMA).values(np.ones(3))
    assert np.flatnonzero(values != FIRST).tolist() == free.tolist()
    assert values[free] == pytest.approx((FIRST + SCALE)[free])


def test_equal_changes_of_the_exposure_are_equal_ratios() -> None:
    scaled = ScaledParameters(FIRST, np.array([1]), SCALE, 0.09, GAMMA)
    ratios = [scaled.values(np.array([change]))[1] / 0.6 for change in (-3.0, 1.0, 3.0)]
    assert ratios[0] * ratios[2] == pytest.approx(1.0)
    assert ratios[2] == pytest.approx(ratios[1] ** 3)


@pytest.mark.parametrize("blur", [-2.5, -0.1, 0.4])
@pytest.mark.parametrize("seed", range(3))
def test_the_slopes_are_limits_of_differences(seed: int, blur: float) -> None:
    scaled = ScaledParameters(FIRST, ALL, SCALE, 0.09, GAMMA)
    here = np.random.default_rng(seed).normal(size=9)
    here[7] = blur
    steps = 1e-6 * np.eye(9)
    differences = [scaled.values(here + step) - scaled.values(here - step) for step in steps]
    assert np.diag(scaled.slopes(here)) == pytest.approx(np.array(differences) / 2e-6, abs=1e-6)


def test_a_blur_below_none_is_that_above_it() -> None:
    scaled = ScaledParameters(FIRST, np.array([7]), SCALE, 0.09, GAMMA)
    none = FIRST[7] / SCALE[7]
    for more in (0.0, 0.3, 2.0):
        below, above = (np.array([sign * more - none]) for sign in (-1.0, 1.0))
        assert scaled.values(above)[7] == pytest.approx(more * SCALE[7])
        assert scaled.values(below) == pytest.approx(scaled.values(above))
        assert scaled.slopes(above) == pytest.approx(SCALE[7])
        assert scaled.slopes(below) == pytest.approx(-SCALE[7] if more else SCALE[7])


def test_beyond_a_bound_nothing_changes() -> None:
    scaled = ScaledParameters(FIRST, ALL, SCALE, 0.09, GAMMA)
    for sign in (-1.0, 1.0):
        far = sign * np.array([1e3, 1e3, 0.0, 1e3, 1e3, 1e3, 1e3, 1e3, 1e3])
        values = scaled.values(far)
        assert values == pytest.approx(scaled.values(1.1 * far))
        bounded = np.flatnonzero(scaled.slopes(far) == 0.0)
        # The exposure's upper bound is that of its change.
        assert bounded.tolist() == [0, 1, 3, 4, 5, 6, 7, 8]


def test_a_first_guess_beyond_a_bound_is_at_it() -> None:
    scaled = ScaledParameters(FIRST + 100.0 * SCALE, ALL, SCALE, 0.09, GAMMA)
    assert scaled.values(np.zeros(9))[0] == pytest.approx(0.18)
    assert scaled.values(np.zeros(9))[3] == pytest.approx(0.5)
    # From an upper bound differences would only lead out.
    assert not scaled.slopes(np.zeros(9))[[0, 3]].any()
