"""Column means of drawn pictures are those of the law, by their mean and their spread."""

import numpy as np
import pytest
from amount import amount
from physics.effect_world import scene_of
from scipy.stats import chi2

import occ_model as occ
from occ_model.camera.coverage import column_spans
from occ_model.effects.effect import OpticsEffect, paper_view_of
from occ_model.effects.registry import NAMES, effects_named
from occ_model.effects.sensor_effects import Jpeg
from occ_model.simulation.columns import expose_columns

GREYS = np.arange(256.0)
_OFF = [*effects_named(NAMES, Jpeg), *effects_named(NAMES, OpticsEffect)]
FORCE = {effect.name: False for effect in _OFF} | {"sensor-noise": True, "fixed-pattern": True}
FEWEST_COLUMNS = 20
NO_SPREAD = 1e-6  # grey levels
MOST_SKEWED = 0.5  # fourth moment of a column's mean beside the normal law's, which is 3


@pytest.mark.parametrize("seed", range(5000, 5000 + amount(20, 300)))
def test_column_means_are_those_of_the_law(seed: int) -> None:
    scene = scene_of(seed)
    plan, view = occ.plan(scene, 0.0, force=FORCE), paper_view_of(scene)
    columns = expose_columns(view, plan)
    assert columns.law is not None
    law = columns.law
    raw = [law.interpolate(law.mean_of(GREYS**power), columns.panel) for power in range(5)]
    mean = raw[1]
    spread = np.sqrt(np.maximum(raw[2] - mean**2, 0.0))
    first, last = column_spans(view.corners, scene.camera.rows, scene.camera.columns)
    rows = last - first
    profile = occ.render(scene, tolerance=0.0, force=FORCE, seed=seed).profile
    still = (rows > 0) & (spread < NO_SPREAD)
    np.testing.assert_allclose(profile[still], mean[still], atol=2e-3)
    fourth = raw[4] - 4.0 * mean * raw[3] + 6.0 * mean**2 * raw[2] - 3.0 * mean**4
    noisy = (spread > 0.01) & (fourth < MOST_SKEWED * rows * spread**4)
    if noisy.sum() >= FEWEST_COLUMNS:
        off = (profile - mean)[noisy] / spread[noisy]
        chance = chi2.sf(float(off**2 @ rows[noisy]), len(off))
        assert 1e-5 < chance < 1.0 - 1e-5
