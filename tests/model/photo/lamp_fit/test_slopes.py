"""Slopes of the model of a lamp's stripes, compared with differences."""

import numpy as np
import pytest

from occ_model.photo.lamp_fit.model import (
    AMBIENT,
    COUNT,
    FLOOR,
    PERIOD,
    PLACE,
    TOE,
    LampModel,
    envelope_basis,
)
from occ_model.photo.lamp_fit.profile import LampProfile

COLUMNS = np.arange(90.0)


@pytest.mark.parametrize("seed", range(6))
def test_slopes_are_those_of_differences(seed: int) -> None:
    random = np.random.default_rng(seed)
    basis = envelope_basis(len(COLUMNS), 5)
    size = basis.shape[1]
    dark = np.zeros(len(COLUMNS))
    profile = LampProfile(dark, dark, dark > 0.0)
    model = LampModel(profile, basis, np.diff(np.eye(size), 2, axis=0), is_linear=False)
    values = np.concatenate([random.normal(0.0, 0.7, COUNT), random.normal(-0.5, 0.3, size)])
    values[PERIOD], values[PLACE] = np.log(random.uniform(6.0, 40.0)), random.uniform(0.0, 30.0)
    values[TOE] = -6.0  # small
    # Between the stripes there is some light, or the curve is cut off.
    values[FLOOR], values[AMBIENT] = abs(values[FLOOR]), 0.01
    level, slopes = model.slopes(values)
    np.testing.assert_allclose(level, model.levels(values), atol=1e-12)
    for parameter in range(len(values)):
        step = np.zeros(len(values))
        step[parameter] = 1e-6
        difference = (model.levels(values + step) - model.levels(values - step)) / 2e-6
        most = 2e-6 * (1.0 + float(abs(slopes).max()))
        np.testing.assert_allclose(slopes[:, parameter], difference, atol=most)
