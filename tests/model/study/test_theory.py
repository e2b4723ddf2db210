"""The limits of theory are where their equations say."""

import math

import numpy as np
import pytest

import occ_model as occ
from occ_model.camera.photometry import level_values
from occ_model.scene.scene import Scene
from occ_model.study import theory
from occ_model.study.observation import panel_span
from occ_model.study.theory import gaussian_rate_bound, row_rate_frequency


def test_at_its_limit_two_packets_just_fill_the_panels_columns() -> None:
    scene = occ.load_preset("tablet-122us")
    frequency = theory.two_packets_frequency(scene)
    span = panel_span(scene)
    chips = span.columns * scene.camera.readout_time * frequency
    assert chips == pytest.approx(2 * len(occ.packet(scene)), rel=1e-12)
    assert theory.two_packets_frequency(scene.replace(offset_x=50.0)) is None


def test_the_lit_panel_is_just_white_at_saturation_exposure() -> None:
    scene = occ.load_preset("phone-136us")
    white = theory.saturation_exposure(scene)
    assert level_values(scene.replace(exposure_time=white))[1] == pytest.approx(255.0, rel=1e-12)
    dark = scene.replace(luminance=0.0, illuminance=0.0)
    assert theory.saturation_exposure(dark) == math.inf


@pytest.mark.parametrize("decibels", [0.0, 20.0, 40.0])
@pytest.mark.parametrize("exposure", [20e-6, 136e-6, 1e-3])
def test_the_rate_bound_is_the_water_filling_integral(decibels: float, exposure: float) -> None:
    scene = Scene().replace(exposure_time=exposure)
    half, power = row_rate_frequency(scene), 10.0 ** (decibels / 10.0)

    grid = np.linspace(0.0, half, 40_001)
    noise = 1.0 / half / np.maximum(np.sinc(grid * exposure) ** 2, 1e-300)
    # The power fills the frequencies with the lowest noise up to one level.
    least = np.sort(noise)
    levels = (power / grid[1] + np.cumsum(least)) / np.arange(1, len(least) + 1)
    level = levels[levels > least][-1]
    bits = float(np.trapezoid(np.log2(np.maximum(level / noise, 1.0)), grid))
    seconds = 30.0 * scene.camera.columns * scene.camera.readout_time
    assert gaussian_rate_bound(scene, power, 30.0) == pytest.approx(bits * seconds, rel=1e-3)
