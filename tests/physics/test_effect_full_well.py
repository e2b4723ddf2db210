"""Laws of pixels that hold so many electrons and no more."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.effects.sensor_effects import FullWell
from occ_model.scene.scene import Scene

ONLY = {"sensor-noise": False, "fixed-pattern": False}


def overexposed(**changes: float | str) -> Scene:
    """A panel that fills the picture and overfills the pixels at a low ISO speed."""
    chosen: dict[str, float | str] = {
        "rows": 40,
        "columns": 300,
        "distance": 0.05,
        "iso": 20.0,
        "luminance": 100_000.0,
        "enhancement": "none",
    }
    return Scene().replace(**(chosen | changes))


def value_of_full(scene: Scene) -> float:
    """The pixel value, by equations (1) and (2), of the light that just fills a pixel."""
    camera, sensor = scene.camera, scene.sensor
    photons = 1 / (320.0 * 3.547e-19)  # in a lumen second, of 560 nm
    lux_seconds = sensor.full_well / (photons * sensor.pixel_pitch**2 * sensor.quantum_efficiency)
    meter = camera.iso * (lux_seconds / 0.65) / camera.meter_constant
    return float(118.0 * meter ** (1 / camera.gamma))


@pytest.mark.parametrize("gamma", [1.0, 2.22])
@pytest.mark.parametrize("iso", [5.0, 15.0, 25.0])
@pytest.mark.parametrize("pitch", [1e-6, 2e-6])
def test_the_picture_saturates_at_the_value_of_a_full_pixel(
    iso: float, gamma: float, pitch: float
) -> None:
    scene = overexposed(
        iso=iso, gamma=gamma, pixel_pitch=pitch, luminance=2e6, full_well=3000 * (pitch / 1e-6) ** 2
    )
    full = value_of_full(scene)
    assert full < 255.0
    frame = occ.render(scene, tolerance=0, force=ONLY)
    assert frame.profile.max() == pytest.approx(full, rel=2e-3)
    assert frame.image.max() == pytest.approx(full, abs=1.0)


def test_values_below_a_full_pixel_stay_as_they_are() -> None:
    scene = overexposed()
    full, bare = value_of_full(scene), occ.column_profile(scene)
    assert bare.min() < full < bare.max()
    profile = occ.render(scene, tolerance=0, force=ONLY).profile
    below = bare < 0.99 * full
    np.testing.assert_array_equal(profile[below], bare[below])
    assert (profile <= bare).all()


def test_surroundings_are_full_as_well() -> None:
    scene = overexposed(distance=5.0, pattern="0", illuminance=2e6)
    frame = occ.render(scene, tolerance=0, force=ONLY)
    assert frame.image.min() == frame.image.max() == pytest.approx(value_of_full(scene), abs=1.0)


def test_at_a_high_iso_speed_the_pixel_value_ends_first() -> None:
    scene = overexposed(iso=400.0)
    assert value_of_full(scene) > 255.0
    assert not FullWell().is_present(scene)
    frame = occ.render(scene, tolerance=0, force=ONLY | {"full-well": True})
    np.testing.assert_array_equal(frame.profile, occ.column_profile(scene))
