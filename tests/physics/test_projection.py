"""Laws of the projection, and of the image made with it."""

import math

import numpy as np
import pytest

import occ_model as occ
from occ_model.camera.projection import paint, row_spans
from occ_model.scene.scene import Scene


def test_a_level_panel_is_as_wide_as_similar_triangles_say() -> None:
    scene = Scene().replace(distance=1.2, panel_width=0.6, panel_height=0.3)
    corners = occ.panel_corners(scene)
    focal = scene.camera.focal_length_pixels
    width, height = np.ptp(corners, axis=0)
    assert width == pytest.approx(focal * 0.6 / 1.2)
    assert height == pytest.approx(focal * 0.3 / 1.2)
    centre = [(scene.camera.columns - 1) / 2, (scene.camera.rows - 1) / 2]
    np.testing.assert_allclose(corners.mean(axis=0), centre)


def test_a_26_mm_equivalent_lens_frames_the_known_diagonal() -> None:
    camera = occ.load_preset("phone-136us").camera
    angle = 2 * math.atan(math.hypot(camera.rows, camera.columns) / 2 / camera.focal_length_pixels)
    assert math.degrees(angle) == pytest.approx(79.5, abs=0.1)


def test_a_yawed_panel_has_the_perspective_of_its_edges() -> None:
    yaw, distance, width = math.radians(30), 1.5, 0.6
    scene = Scene().replace(yaw=yaw, distance=distance, panel_width=width)
    focal = scene.camera.focal_length_pixels
    x = occ.panel_corners(scene)[:, 0] - (scene.camera.columns - 1) / 2
    # A point at s along the turned edge is at (s cos yaw, distance - s sin yaw).
    s = np.array([-1, 1, 1, -1]) * width / 2
    expected = focal * s * math.cos(yaw) / (distance - s * math.sin(yaw))
    np.testing.assert_allclose(x, expected)


@pytest.mark.parametrize("roll", [0.0, 0.3, -1.0])
def test_panel_rows_carry_the_profile_and_outside_is_dark(roll: float) -> None:
    scene = Scene().replace(rows=300, columns=200, distance=1.5, roll=roll)
    frame = occ.render(scene, tolerance=np.inf)
    first, last = row_spans(frame.corners, 300, 200)
    assert (last > first).any()
    surroundings = frame.image[0, 0]
    for row in range(300):
        a, b = first[row], last[row]
        np.testing.assert_array_equal(frame.image[row, a:b], frame.signal[a:b])
        assert (frame.image[row, :a] == surroundings).all()
        assert (frame.image[row, b:] == surroundings).all()


def test_surroundings_have_the_dark_panels_pixel_value() -> None:
    scene = Scene().replace(rows=100, columns=100, distance=5.0, illuminance=3000.0)
    frame = occ.render(scene.replace(enhancement="none"), tolerance=np.inf)
    dark = occ.column_profile(scene.replace(pattern="0"))
    assert frame.image[0, 0] == round(float(dark[0]))


def test_a_panel_that_fills_the_picture_leaves_no_surroundings() -> None:
    corners = np.array([[-9, -9], [99, -9], [99, 99], [-9, 99]])
    image = paint(np.arange(50, dtype=np.uint8), corners, range(20), np.full(50, 200, np.uint8))
    np.testing.assert_array_equal(image, np.tile(np.arange(50), (20, 1)))
