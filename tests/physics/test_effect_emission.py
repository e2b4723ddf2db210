"""Laws of a panel that bundles its light."""

import math

import numpy as np
import pytest
from physics.pictured_luminance import pictured_luminance

import occ_model as occ
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import luminance_levels
from occ_model.camera.projection import image_points
from occ_model.effects.optics_effects import Emission
from occ_model.scene.scene import Scene

ROWS, COLUMNS = 101, 301
AXIS = (50, 150)
"""The pixel that the optical axis meets."""

NO_NOISE = {"sensor-noise": False, "fixed-pattern": False}


def steady(**changes: float | str) -> Scene:
    """A panel always lit, larger than the picture, and dim enough not to saturate."""
    chosen: dict[str, float | str] = {
        "rows": ROWS,
        "columns": COLUMNS,
        "pattern": "1",
        "distance": 0.5,
        "panel_width": 3.0,
        "panel_height": 3.0,
        "lambertian_order": 3.0,
        "luminance": 1000.0,
        "enhancement": "none",
    }
    return Scene().replace(**(chosen | changes))


@pytest.mark.parametrize("order", [1.5, 2.0, 3.0, 10.0])
@pytest.mark.parametrize("turn", ["yaw", "pitch"])
@pytest.mark.parametrize("degrees", [0.0, 20.0, -45.0, 60.0])
def test_a_turned_panel_is_darker_by_the_cosine_of_its_turn(
    order: float, turn: str, degrees: float
) -> None:
    angle = math.radians(degrees)
    scene = steady(lambertian_order=order, panel_width=0.2, panel_height=0.2, **{turn: angle})
    dark, bright = luminance_levels(scene)
    own = pictured_luminance(scene, Emission())[AXIS] - dark
    assert own == pytest.approx((bright - dark) * math.cos(angle) ** (order - 1), rel=1e-5)


@pytest.mark.parametrize("degrees", [15.0, -30.0])
def test_angles_of_yaw_and_ray_add_up(degrees: float) -> None:
    yaw = math.radians(degrees)
    scene = steady(yaw=yaw, distance=5.0, panel_width=10.0, panel_height=10.0)
    dark, bright = luminance_levels(scene)
    own = pictured_luminance(scene, Emission()) - dark
    for column in (60, 150, 240):
        ray = math.atan((column - 150) / scene.camera.focal_length_pixels)
        # The side that comes nearer, the right one for a positive yaw, faces the camera.
        expected = (bright - dark) * math.cos(yaw - ray) ** 2
        assert own[50, column] == pytest.approx(expected, rel=1e-5)


def test_each_corners_angle_is_between_its_normal_and_its_ray() -> None:
    scene = steady(yaw=0.4, pitch=-0.3, roll=0.5, distance=3.0, offset_x=0.2, panel_width=1.0)
    pose = scene.pose

    def turned(x: float, y: float, z: float) -> np.ndarray:
        sin, cos = math.sin(pose.pitch), math.cos(pose.pitch)
        y, z = y * cos - z * sin, y * sin + z * cos
        sin, cos = math.sin(pose.yaw), math.cos(pose.yaw)
        x, z = x * cos + z * sin, z * cos - x * sin
        sin, cos = math.sin(pose.roll), math.cos(pose.roll)
        return np.array([x * cos - y * sin, x * sin + y * cos, z])

    normal = turned(0.0, 0.0, -1.0)
    place = np.array([pose.offset_x, pose.offset_y, pose.distance])
    optics = Emission().apply(scene, Optics(occ.panel_corners(scene)))
    gains = optics.emission[0].at(np.arange(ROWS, dtype=np.float64), slice(None))
    for x, y in ((-0.2, -0.3), (0.1, -0.3), (0.1, 0.2), (0.0, 0.0)):
        point = turned(x, y, 0.0) + place
        column, row = np.rint(image_points(point[:2] / point[2], scene.camera)).astype(int)
        cosine = -normal @ point / np.linalg.norm(point)
        assert gains[row, column] == pytest.approx(cosine**2, rel=0.01)


def test_reflected_light_and_surroundings_stay_as_they_are() -> None:
    scene = steady(pattern="0", yaw=1.0, panel_width=0.2)
    np.testing.assert_allclose(
        pictured_luminance(scene, Emission()), luminance_levels(scene)[0], rtol=1e-5, atol=0
    )


@pytest.mark.parametrize("averaging", ["pixel-value", "light"])
def test_order_one_is_nothing(averaging: str) -> None:
    scene = steady(lambertian_order=1.0, yaw=0.7, pattern="", averaging=averaging, distance=4.0)
    assert not Emission().is_present(scene)
    bare = occ.render(scene, tolerance=float("inf"))
    forced = occ.render(scene, tolerance=float("inf"), force={"emission": True})
    np.testing.assert_allclose(forced.profile, bare.profile, rtol=1e-5)
    np.testing.assert_array_equal(forced.image, bare.image)


def test_the_picture_of_a_turned_panel_is_darker() -> None:
    scene = steady(panel_width=0.2)
    level = occ.render(scene, force=NO_NOISE)
    turned = occ.render(scene.replace(yaw=math.radians(60)), force=NO_NOISE)
    dark, bright = luminance_levels(steady())
    factor = (dark + (bright - dark) / 4) / bright
    expected = level.image[AXIS] * factor ** (1 / 2.22)
    assert turned.image[AXIS] == pytest.approx(expected, abs=1.0)
