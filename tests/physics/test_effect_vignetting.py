"""Laws of a picture that is darker towards its corners."""

import math

import numpy as np
import pytest

import occ_model as occ
from occ_model.camera.photometry import level_values
from occ_model.effects.optics_effects import Vignetting
from occ_model.scene.scene import Scene
from occ_model.simulation.render import observe

ONLY = {"sensor-noise": False, "fixed-pattern": False, "vignetting": True}


def vignetted(**changes: float | str) -> Scene:
    """A steady panel that fills a picture whose middle pixel lies on the optical axis."""
    chosen: dict[str, float | str] = {
        "rows": 101,
        "columns": 301,
        "pattern": "1",
        "distance": 0.1,
        "vignetting_exponent": 4.0,
        "luminance": 2000.0,
        "enhancement": "none",
    }
    return Scene().replace(**(chosen | changes))


def shown(scene: Scene, force: dict[str, bool] = ONLY) -> np.ndarray:
    """The panel's pixel values before rounding: those of the picture where it fills that."""
    return observe(scene, occ.plan(scene, force=force))


def cosine(scene: Scene, row: int, column: int) -> float:
    """Of the angle between a pixel's ray and the axis, which meets row 50 and column 150."""
    off_axis = math.hypot(row - 50, column - 150)
    return math.cos(math.atan(off_axis / scene.camera.focal_length_pixels))


@pytest.mark.parametrize("gamma", [1.0, 2.22])
@pytest.mark.parametrize("exponent", [1.0, 4.0, 8.0])
def test_pixels_darken_by_the_power_of_their_cosine(exponent: float, gamma: float) -> None:
    scene = vignetted(vignetting_exponent=exponent, gamma=gamma, luminance=1000.0)
    values = shown(scene)
    unvignetted = occ.column_profile(scene)[0]
    assert unvignetted < 255.0
    for pixel in ((50, 150), (50, 0), (0, 150), (0, 0), (100, 300), (13, 222)):
        factor = cosine(scene, *pixel) ** (exponent / gamma)
        assert values[pixel] == pytest.approx(unvignetted * factor, rel=1e-5)


def test_all_light_is_lost_alike_that_of_the_surroundings_too() -> None:
    scene = vignetted(distance=3.0, illuminance=3000.0)
    image = occ.render(scene, force=ONLY).image
    dark = float(occ.column_profile(scene.replace(pattern="0"))[0])
    for pixel in ((0, 0), (100, 300), (50, 0)):
        factor = cosine(scene, *pixel) ** (4 / 2.22)
        assert image[pixel] == pytest.approx(dark * factor, abs=0.51)


def test_the_picture_is_the_vignetted_one_rounded() -> None:
    scene = vignetted(pattern="")
    np.testing.assert_array_equal(occ.render(scene, force=ONLY).image, np.rint(shown(scene)))


def test_an_even_lens_is_nothing() -> None:
    scene = vignetted(vignetting_exponent=0.0, pattern="", distance=2.0)
    assert not Vignetting().is_present(scene)
    bare = occ.render(scene, tolerance=float("inf"))
    forced = occ.render(scene, tolerance=float("inf"), force={"vignetting": True})
    np.testing.assert_array_equal(forced.image, bare.image)


@pytest.mark.parametrize("limit", ["white", "full well"])
def test_light_is_lost_before_a_pixel_is_full(limit: str) -> None:
    scene = vignetted(iso=2000.0, full_well=1e9)
    unlimited = float(level_values(scene)[1])
    full = 255.0
    if limit == "full well":
        # As many electrons as the pixel value 200 stands for, of the light of the lit panel.
        light = 0.65 * 136e-6 / 2.48**2 * (2000 + 290 * 0.4 / math.pi) * 8.8e15 * 1e-12 * 0.55
        full = 200.0
        scene = scene.replace(full_well=light * (full / unlimited) ** 2.22)
    values = shown(scene, ONLY | {"full-well": True})
    corner = unlimited * cosine(scene, 0, 0) ** (4 / 2.22)
    assert unlimited > 255.0
    assert values[50, 150] == pytest.approx(full, rel=1e-3)
    assert values[0, 0] == pytest.approx(min(corner, full), rel=1e-3)
