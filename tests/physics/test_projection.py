"""Laws of the projection, and of the image made with it."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import occ_model as occ
from occ_model.camera.projection import paint, row_spans
from occ_model.scene.scene import Scene

POINTS = st.tuples(st.floats(-50, 90), st.floats(-50, 90))


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


def test_twice_the_distance_is_half_the_size() -> None:
    near = np.ptp(occ.panel_corners(Scene().replace(distance=0.8)), axis=0)
    far = np.ptp(occ.panel_corners(Scene().replace(distance=1.6)), axis=0)
    np.testing.assert_allclose(near, 2 * far)


def test_an_offset_moves_the_panel_by_similar_triangles() -> None:
    scene = Scene().replace(distance=2.0)
    moved = occ.panel_corners(scene.replace(offset_x=0.5, offset_y=-0.25))
    shift = moved - occ.panel_corners(scene)
    focal = scene.camera.focal_length_pixels
    np.testing.assert_allclose(shift, np.tile([focal * 0.25, -focal * 0.125], (4, 1)))


def test_a_yawed_panel_has_the_perspective_of_its_edges() -> None:
    yaw, distance, width = math.radians(30), 1.5, 0.6
    scene = Scene().replace(yaw=yaw, distance=distance, panel_width=width)
    focal = scene.camera.focal_length_pixels
    x = occ.panel_corners(scene)[:, 0] - (scene.camera.columns - 1) / 2
    # A point at s along the turned edge is at (s cos yaw, distance - s sin yaw).
    s = np.array([-1, 1, 1, -1]) * width / 2
    expected = focal * s * math.cos(yaw) / (distance - s * math.sin(yaw))
    np.testing.assert_allclose(x, expected)


def test_a_roll_of_a_quarter_turn_exchanges_width_and_height() -> None:
    scene = Scene().replace(panel_width=0.5, panel_height=0.2, roll=math.pi / 2)
    upright = np.ptp(occ.panel_corners(scene.replace(roll=0.0)), axis=0)
    np.testing.assert_allclose(np.ptp(occ.panel_corners(scene), axis=0), upright[::-1])


def test_a_panel_reaching_behind_the_camera_is_refused() -> None:
    scene = Scene().replace(distance=0.2, yaw=math.radians(80))
    with pytest.raises(occ.ProjectionError, match=r"200 mm|0\.2 m"):
        occ.render(scene)


def test_an_image_too_large_for_any_camera_is_refused() -> None:
    with pytest.raises(occ.ProjectionError, match="million"):
        occ.render(Scene().replace(rows=100_000, columns=100_000))


@given(points=st.lists(POINTS, min_size=3, max_size=3, unique=True))
def test_row_spans_hold_just_the_pixels_whose_centres_lie_inside(
    points: list[tuple[float, float]],
) -> None:
    corners = np.array(points)
    rows, columns = 40, 41
    first, last = row_spans(corners, rows, columns)
    inside = np.zeros((rows, columns), dtype=bool)
    for row in range(rows):
        inside[row, first[row] : last[row]] = True
    y, x = np.mgrid[0:rows, 0:columns].astype(float)
    turns = []
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        turns.append((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0))
    side = np.stack(turns)
    clearly_inside = (side > 1e-6).all(axis=0) | (side < -1e-6).all(axis=0)
    clearly_outside = (side < -1e-6).any(axis=0) & (side > 1e-6).any(axis=0)
    assert inside[clearly_inside].all()
    assert not inside[clearly_outside].any()


def test_corners_a_million_images_away_still_give_whole_rows() -> None:
    corners = np.array([[-1e12, -1e12], [1e12, -1e12], [1e12, 1e12], [-1e12, 1e12]])
    first, last = row_spans(corners, 10, 20)
    assert (first == 0).all()
    assert (last == 20).all()


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


def test_a_panel_outside_the_picture_leaves_it_dark() -> None:
    frame = occ.render(Scene().replace(rows=50, columns=60, offset_x=50.0), tolerance=np.inf)
    assert len(np.unique(frame.image)) == 1


def test_a_panel_that_fills_the_picture_leaves_no_surroundings() -> None:
    corners = np.array([[-9, -9], [99, -9], [99, 99], [-9, 99]])
    image = paint(np.arange(50, dtype=np.uint8), corners, range(20), np.full(50, 200, np.uint8))
    np.testing.assert_array_equal(image, np.tile(np.arange(50), (20, 1)))
