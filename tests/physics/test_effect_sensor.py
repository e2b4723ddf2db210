"""Laws of a full well and of photon transfer, with electrons computed independently."""

import math
from itertools import product

import numpy as np
import pytest
from each_case import each_case

import occ_model as occ
from occ_model.effects.sensor_effects import FullWell
from occ_model.scene.scene import Scene

ONLY = {"sensor-noise": False, "fixed-pattern": False}


def overexposed_scene(**changes: float | str) -> Scene:
    """Make a panel that fills the picture and overfills its pixels at a low ISO speed."""
    return Scene().replace(
        rows=40, columns=300, distance=0.05, iso=20.0, luminance=100_000.0, enhancement="none",
    ).replace(**changes)  # fmt: skip


def value_of_full(scene: Scene) -> float:
    """Return the pixel value, by equations (1) and (2), of the light that just fills a pixel."""
    camera, sensor = scene.camera, scene.sensor
    photons = 1 / (320.0 * 3.547e-19)  # in a lumen second of 560 nm
    lux_seconds = sensor.full_well / (photons * sensor.pixel_pitch**2 * sensor.quantum_efficiency)
    meter = camera.iso * (lux_seconds / 0.65) / camera.meter_constant
    return float(118.0 * meter ** (1 / camera.gamma))


@each_case(product((5.0, 15.0, 25.0), (1.0, 2.22), (1e-6, 2e-6)))
def test_the_picture_saturates_at_the_value_of_a_full_pixel(
    iso: float, gamma: float, pitch: float
) -> None:
    scene = overexposed_scene(
        iso=iso, gamma=gamma, pixel_pitch=pitch, luminance=2e6, full_well=3000 * (pitch / 1e-6) ** 2
    )
    full = value_of_full(scene)
    assert full < 255.0
    frame = occ.render(scene, tolerance=0, force=ONLY)
    assert frame.profile.max() == pytest.approx(full, rel=2e-3)
    assert frame.image.max() == pytest.approx(full, abs=1.0)


def test_values_below_a_full_pixel_stay_as_they_are() -> None:
    scene = overexposed_scene()
    full, bare = value_of_full(scene), occ.column_profile(scene)
    assert bare.min() < full < bare.max()
    profile = occ.render(scene, tolerance=0, force=ONLY).profile
    below = bare < 0.99 * full
    np.testing.assert_array_equal(profile[below], bare[below])
    assert (profile <= bare).all()


def test_surroundings_are_full_as_well() -> None:
    scene = overexposed_scene(distance=5.0, pattern="0", illuminance=2e6)
    frame = occ.render(scene, tolerance=0, force=ONLY)
    assert frame.image.min() == frame.image.max() == pytest.approx(value_of_full(scene), abs=1.0)


def test_at_a_high_iso_speed_the_pixel_value_ends_first() -> None:
    scene = overexposed_scene(iso=400.0)
    assert value_of_full(scene) > 255.0
    assert not FullWell().is_present(scene)
    frame = occ.render(scene, tolerance=0, force=ONLY | {"full-well": True})
    np.testing.assert_array_equal(frame.profile, occ.column_profile(scene))


ROWS, COLUMNS = 100, 200
SHOT = {"fixed-pattern": False, "full-well": False, "sensor-noise": True}
PATTERN = {"fixed-pattern": True, "full-well": False, "sensor-noise": False}

_PHOTON = 6.62607e-34 * 2.99792e8 / 560e-9
"""Energy in joules of a photon in the middle of white light."""


def steady_scene(electrons: float, **changes: float | str) -> Scene:
    """Make a panel, always lit, that fills the picture and gives each pixel some electrons.

    They follow from 320 lm/W and 0.65 L t / N^2 lux seconds.
    """
    chosen: dict[str, float | str] = {
        "rows": ROWS,
        "columns": COLUMNS,
        "distance": 0.05,
        "pattern": "1",
        "illuminance": 0.0,
        "gamma": 1.0,
        "iso": 100.0,
        "full_well": 1e9,
        "enhancement": "none",
    }
    scene = Scene().replace(**(chosen | changes))
    camera, sensor = scene.camera, scene.sensor
    area = sensor.pixel_pitch**2 * sensor.quantum_efficiency
    lux_seconds = electrons / area * 320.0 * _PHOTON
    return scene.replace(luminance=lux_seconds / 0.65 * camera.f_number**2 / camera.exposure_time)


def level_of(scene: Scene) -> float:
    return float(occ.column_profile(scene)[0])


def count_electrons(scene: Scene, electrons: float, seed: int = 1) -> np.ndarray:
    """Return the electrons in each pixel, with the gamma inverted, shape (rows, columns)."""
    image = occ.render(scene, force=SHOT, seed=seed).image
    return (image / level_of(scene)) ** scene.camera.gamma * electrons


def test_the_picture_itself_shows_the_line() -> None:
    read_noise, samples = 10.0, ROWS * COLUMNS
    for electrons in (60.0, 150.0, 300.0, 500.0, 650.0):
        scene = steady_scene(electrons, read_noise=read_noise, adc_bits=24)
        seen = count_electrons(scene, electrons)
        a_level = electrons / level_of(scene)
        expected = electrons + read_noise**2 + a_level**2 / 12  # the picture's own rounding
        assert seen.var() == pytest.approx(expected, rel=5 * math.sqrt(2 / samples))
        assert seen.mean() == pytest.approx(electrons, abs=5 * math.sqrt(expected / samples))


@pytest.mark.parametrize("limit", ["white", "full well"])
@pytest.mark.parametrize("gamma", [1.0, 2.22])
def test_full_pixels_show_no_noise(limit: str, gamma: float) -> None:
    scene = steady_scene(5000.0, gamma=gamma, iso=400.0)
    if limit == "full well":
        scene = scene.replace(full_well=4000.0, iso=15.0)
    image = occ.render(scene, force=SHOT | PATTERN | {"full-well": True}, seed=2).image
    assert image.min() == image.max()
    assert (image.max() == 255) == (limit == "white")


def test_the_fixed_pattern_is_the_same_in_every_picture() -> None:
    scene = steady_scene(400.0, gain_variation=0.05)
    first, second = (occ.render(scene, force=PATTERN, seed=seed).image for seed in (1, 2))
    np.testing.assert_array_equal(first, second)
    level = level_of(scene)
    assert (first / level).std() == pytest.approx(0.05, rel=0.03)
    brighter = occ.render(steady_scene(600.0, gain_variation=0.05), force=PATTERN).image
    np.testing.assert_allclose(brighter / 1.5, first, rtol=0, atol=1.0)
