"""Laws of an LED with rise and fall times, and of lamps that flicker."""

import numpy as np
import pytest

import occ_model as occ
from occ_model.camera.photometry import luminance_levels, pixel_value
from occ_model.camera.projection import row_spans
from occ_model.effects.light_effects import ambient_fractions
from occ_model.scene.scene import Scene

ONLY_FLICKER = {"sensor-noise": False, "fixed-pattern": False, "flicker": True}


def flickering_scene(**changes: float | str) -> Scene:
    """Make deep flicker at 100 Hz in a small picture with surroundings on all sides of the
    panel."""
    return Scene().replace(
        flicker_depth=0.8, flicker_frequency=100.0, illuminance=3000.0, rows=90, columns=400,
        readout_time=50e-6, distance=2.0, enhancement="none",
    ).replace(**changes)  # fmt: skip


@pytest.mark.parametrize("enhancement", ["none", "stretch", "equalization"])
def test_the_surroundings_flicker_beside_a_panel_that_blinks(enhancement: str) -> None:
    scene = flickering_scene(enhancement=enhancement)
    frame = occ.render(scene, force=ONLY_FLICKER)
    first, last = row_spans(frame.corners, 90, 400)
    row = 45
    outside = np.r_[0 : first[row], last[row] : 400]
    dark = luminance_levels(scene)[0] * ambient_fractions(scene)
    expected = np.rint(pixel_value(dark, scene.camera))
    assert 50 < len(outside) < 350
    np.testing.assert_array_equal(frame.image[row, outside], expected[outside])
    np.testing.assert_array_equal(frame.image[0], expected)


@pytest.mark.parametrize("averaging", ["pixel-value", "light"])
def test_the_panel_flickers_by_the_light_that_it_reflects(averaging: str) -> None:
    scene = flickering_scene(averaging=averaging, code=0, illuminance=1000.0)
    profile = occ.render(scene, force=ONLY_FLICKER).profile
    dark, bright = luminance_levels(scene)
    reflected = dark * ambient_fractions(scene)
    lit = occ.on_time(scene) / scene.camera.exposure_time
    emitted = bright - dark
    if averaging == "light":
        expected = pixel_value(reflected + emitted * lit, scene.camera)
    else:
        low, high = pixel_value(np.array([reflected, reflected + emitted]), scene.camera)
        expected = high * lit + low * (1 - lit)
    np.testing.assert_allclose(profile, np.minimum(expected, 255.0), rtol=1e-12)
