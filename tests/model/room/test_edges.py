"""Edges of lamps lie within their errors, however the lens and the sensor change their light."""

from typing import Any

import numpy as np
import pytest
from amount import amount
from small_rooms import small_room

import occ_model as occ
from occ_model.camera.enhancement import Enhancement
from occ_model.camera.photometry import (
    ColumnLight,
    luminance_levels,
    panel_values,
    saturate,
)
from occ_model.room.edge_lines import BLOCK, Course, Line, estimate_variance_ratio
from occ_model.room.edges import find_edges
from occ_model.room.render import RoomFrame
from occ_model.room.room import Place, Room
from occ_model.room.seen_light import ApparentLight
from occ_model.room.view import lamp_scene, scene_with_lamp
from occ_model.scene.scene import Scene

_POINTS = 640
_ENDS = np.array([[0.0, 250.0], [_POINTS - 1.0, 270.0]])


def line(random: np.random.Generator, reach: int) -> Line:
    """Return a line through points whose errors are means over ``reach`` neighbours."""
    noise = random.normal(size=_POINTS + reach - 1)
    errors = 0.2 * np.convolve(noise, np.full(reach, reach**-0.5), mode="valid")
    course = Course.of(_ENDS, Scene().replace(rows=500, columns=_POINTS))
    return Line(course, errors)


def cut(reach: int) -> float:
    """Return the factor by which blocks underestimate a variance of means over neighbours.

    Points k apart have 1 - k / reach of their variance in common, among all and within a block.
    """
    apart = np.arange(1 - reach, reach)
    alike = 1.0 - np.abs(apart) / reach
    return float(alike.sum() / (alike * np.maximum(1.0 - np.abs(apart) / BLOCK, 0.0)).sum())


@pytest.mark.parametrize("reach", [1, 8])
def test_the_error_of_a_line_follows_from_the_scatter_within_blocks(reach: int) -> None:
    random = np.random.default_rng(9107 + reach)
    squares, rooms = [], amount(30, 150)
    for _ in range(rooms):
        lines = [line(random, reach) for _ in range(4)]
        alike = estimate_variance_ratio(lines)
        for each in lines:
            edge = each.make_edge(alike)
            off = (edge.points - _ENDS) @ edge.normal
            squares.append(off @ np.linalg.solve(edge.covariance, off) / 2.0)
    # The mean square of 1,200 numbers scatters by 4 %.
    assert np.mean(squares) == pytest.approx(cut(reach), rel=0.12 * np.sqrt(150 / rooms))
    assert cut(reach) < 1.5


WHITE = {"iso": 1600.0, "exposure_time": 100e-6}
NOISY = {"iso": 400.0, "read_noise": 20.0, "gain_variation": 0.02, "edge_time": 10e-6}
LENSES: list[dict[str, Any]] = [
    {},
    WHITE,
    {"point_spread": 4.0, **NOISY},
    {"point_spread": 3.0, "radial_k1": 0.2, **WHITE},
    {"radial_k1": -0.1, "point_spread": 0.6, "iso": 200.0},
]
_CAMERA = Place(x=0.45, y=0.6, z=-0.9, yaw=0.1, pitch=-0.1, roll=0.4)


def _bent(**settings: Any) -> Room:
    return small_room(
        4, apart=1.3, camera=_CAMERA, rows=1152, columns=1152, readout_time=24e-6, **settings
    )


def _corners(room: Room) -> dict[str, np.ndarray]:
    """Return the corners of each lamp as a lens without distortion shows them."""
    return {lamp.name: occ.panel_corners(lamp_scene(room, lamp)) for lamp in room.lamps}


def _deviations(frame: RoomFrame, image: np.ndarray) -> np.ndarray:
    """Return how far edges lie inside the true ones, in errors, starting from rough corners."""
    random, room = np.random.default_rng(5), frame.room
    found = []
    for name, corners in _corners(room).items():
        (lamp,) = (one for one in room.lamps if one.name == name)
        rough = corners + random.uniform(-4.0, 4.0, corners.shape)
        for edge in find_edges(image, room, lamp, rough):
            starts, ends = corners, np.roll(corners, -1, axis=0)
            along = (ends - starts) / np.hypot(*(ends - starts).T)[:, None]
            side = (along @ (edge.points[1] - edge.points[0])).argmax()
            off = (edge.points - starts[side]) @ [-along[side, 1], along[side, 0]]
            found.append(np.linalg.solve(np.linalg.cholesky(edge.covariance), off))
    return np.array(found)


@pytest.mark.parametrize("settings", LENSES)
def test_edges_lie_within_their_errors_in_both_pictures(settings: dict[str, Any]) -> None:
    frame = occ.render_room(_bent(**settings), seed=3)
    for image in (frame.camera_image, frame.image):
        off = _deviations(frame, image)
        assert len(off) >= 10  # of 16
        assert np.abs(off).max() < 4.5
        assert 0.2 < np.square(off).mean() < 2.0
        # There is no common shift beyond chance, considering that a lamp's edges share an error.
        assert abs(off[:, 0].mean()) < 4.0 / np.sqrt(len(off) / 2.0)


@pytest.mark.parametrize("light", [0.0, 300.0, 1500.0, 3600.0])
@pytest.mark.parametrize("settings", [{}, WHITE, NOISY])
def test_the_apparent_light_of_pixels_is_that_expected_from_noise_and_enhancement(
    settings: dict[str, Any], light: float
) -> None:
    room = small_room(1, rows=300, columns=400, **settings)
    scene = scene_with_lamp(room, room.lamps[0])
    panel = scene.replace(
        pattern="1", luminance=light, distance=0.1, enhancement="none", edge_time=0.0
    )
    image = occ.render(panel, tolerance=0.0, seed=2).camera_image
    true = light + luminance_levels(scene)[0]
    values = panel_values(scene, ColumnLight.of(scene))
    curve = Enhancement(saturate(values), "equalization").curve
    plain, enhanced = ApparentLight(scene), ApparentLight(scene, (curve, values))
    for expected, pixels in (
        (plain.inside, plain.of(image)),
        (enhanced.inside, enhanced.of(curve[image])),
        (enhanced.outside, enhanced.of(image)),
    ):
        error = 5.0 * pixels.std() / np.sqrt(image.size)
        assert pixels.mean() == pytest.approx(float(expected(true)), abs=error, rel=2e-3)
