"""Pixels of which only the gains vary have the mean and spread of pixels drawn one by one."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.effects.noisy_pixels import NoisyPixels

NAMES = frozenset({"fixed-pattern"})


@pytest.mark.parametrize("value", [120.0, 235.0, 250.0, 254.0])
@pytest.mark.parametrize("gain_variation", [0.02, 0.1])
def test_gains_move_and_spread_pixels_as_far_as_they_are_not_white(
    value: float, gain_variation: float
) -> None:
    scene = occ.load_preset("phone-68us").replace(gain_variation=gain_variation)
    pixels, values = NoisyPixels(scene, NAMES), np.array([value])
    gains = 1.0 + gain_variation * np.random.default_rng(1).normal(size=200_000)
    unclipped = value * gains ** (1.0 / scene.camera.gamma)
    mean = np.minimum(unclipped, 255.0).mean()
    spread = gain_variation / scene.camera.gamma * value
    assert pixels.means(NAMES, values)[0] == pytest.approx(mean, abs=0.04 * spread)
    expected = np.var(unclipped) * np.mean(unclipped < 255.0)
    assert pixels.variance_by("fixed-pattern", values)[0] == pytest.approx(expected, rel=0.05)
