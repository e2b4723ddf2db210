"""Laws of a panel with directed light, and of a lens that darkens the corners."""

import math

import numpy as np
import pytest
from physics.pictured_luminance import pictured_luminance

import occ_model as occ
from occ_model.camera.photometry import level_values, luminance_levels
from occ_model.effects.optics_effects import Emission
from occ_model.scene.scene import Scene
from occ_model.simulation.render import observe

ROWS, COLUMNS = 101, 301
AXIS = (50, 150)  # the pixel that the optical axis meets

NO_NOISE = {"sensor-noise": False, "fixed-pattern": False}


def steady_scene(**changes: float | str) -> Scene:
    """Make a panel that is always lit, larger than the picture, and too dim to saturate."""
    return Scene().replace(
        rows=ROWS, columns=COLUMNS, pattern="1", distance=0.5, panel_width=3.0, panel_height=3.0,
        lambertian_order=3.0, luminance=1000.0, enhancement="none",
    ).replace(**changes)  # fmt: skip


def test_reflected_light_and_surroundings_stay_as_they_are() -> None:
    scene = steady_scene(pattern="0", yaw=1.0, panel_width=0.2)
    np.testing.assert_allclose(
        pictured_luminance(scene, Emission()), luminance_levels(scene)[0], rtol=1e-5, atol=0
    )


def test_the_picture_of_a_turned_panel_is_darker() -> None:
    scene = steady_scene(panel_width=0.2)
    level = occ.render(scene, force=NO_NOISE)
    turned = occ.render(scene.replace(yaw=math.radians(60)), force=NO_NOISE)
    dark, bright = luminance_levels(steady_scene())
    factor = (dark + (bright - dark) / 4) / bright
    expected = level.image[AXIS] * factor ** (1 / 2.22)
    assert turned.image[AXIS] == pytest.approx(expected, abs=1.0)


ONLY = {"sensor-noise": False, "fixed-pattern": False, "vignetting": True}


def vignetted_scene(**changes: float | str) -> Scene:
    """Make a steady panel that fills a picture with its middle pixel on the optical axis."""
    return Scene().replace(
        rows=101, columns=301, pattern="1", distance=0.1, vignetting_exponent=4.0,
        luminance=2000.0, enhancement="none",
    ).replace(**changes)  # fmt: skip


def panel_values_of(scene: Scene, force: dict[str, bool] = ONLY) -> np.ndarray:
    """Return the pixel values before rounding of a panel that fills the picture."""
    return observe(scene, occ.plan(scene, force=force))


def cosine(scene: Scene, row: int, column: int) -> float:
    """Return the cosine between a pixel's ray and the axis, which meets row 50 and column 150."""
    off_axis = math.hypot(row - 50, column - 150)
    return math.cos(math.atan(off_axis / scene.camera.focal_length_pixels))


@pytest.mark.parametrize("gamma", [1.0, 2.22])
@pytest.mark.parametrize("exponent", [1.0, 4.0, 8.0])
def test_pixels_darken_by_the_power_of_their_cosine(exponent: float, gamma: float) -> None:
    scene = vignetted_scene(vignetting_exponent=exponent, gamma=gamma, luminance=1000.0)
    values = panel_values_of(scene)
    unvignetted = occ.column_profile(scene)[0]
    assert unvignetted < 255.0
    for pixel in ((50, 150), (50, 0), (0, 150), (0, 0), (100, 300), (13, 222)):
        factor = cosine(scene, *pixel) ** (exponent / gamma)
        assert values[pixel] == pytest.approx(unvignetted * factor, rel=1e-5)


def test_all_light_is_lost_alike_that_of_the_surroundings_too() -> None:
    scene = vignetted_scene(distance=3.0, illuminance=3000.0)
    image = occ.render(scene, force=ONLY).image
    dark = float(occ.column_profile(scene.replace(pattern="0"))[0])
    for pixel in ((0, 0), (100, 300), (50, 0)):
        factor = cosine(scene, *pixel) ** (4 / 2.22)
        assert image[pixel] == pytest.approx(dark * factor, abs=0.51)


@pytest.mark.parametrize("limit", ["white", "full well"])
def test_light_is_lost_before_a_pixel_is_full(limit: str) -> None:
    scene = vignetted_scene(iso=2000.0, full_well=1e9)
    unlimited = float(level_values(scene)[1])
    full = 255.0
    if limit == "full well":
        # As many electrons as the lit panel gives at the pixel value 200.
        light = 0.65 * 136e-6 / 2.48**2 * (2000 + 290 * 0.4 / math.pi) * 8.8e15 * 1e-12 * 0.55
        full = 200.0
        scene = scene.replace(full_well=light * (full / unlimited) ** 2.22)
    values = panel_values_of(scene, ONLY | {"full-well": True})
    corner = unlimited * cosine(scene, 0, 0) ** (4 / 2.22)
    assert unlimited > 255.0
    assert values[50, 150] == pytest.approx(full, rel=1e-3)
    assert values[0, 0] == pytest.approx(min(corner, full), rel=1e-3)
