"""A room with one lamp has the picture of its scene, and the light of several lamps adds up."""

import dataclasses
from typing import Any

import numpy as np
import pytest
from small_rooms import small_room

import occ_model as occ
from occ_model.camera.photometry import luminance_of
from occ_model.camera.projection import image_rays
from occ_model.effects.distortion import undistort
from occ_model.effects.plan import plan_of
from occ_model.room.render import render_room
from occ_model.room.room import Place, Room, RoomLamp
from occ_model.room.view import lamps_in_view, seen_outline
from occ_model.scene.scene import SimulationSettings

SMALL = {"rows": 600, "columns": 800}
TURNED = {"yaw": 0.2, "pitch": -0.1, "roll": 0.3, "start_time": 1e-3}


def _beside(room: Room, **changes: Any) -> Room:
    other = dataclasses.replace(room.lamps[0], name="other", **changes)
    return room.replace(lamps=(*room.lamps, other))


@pytest.mark.parametrize("preset", ["phone-136us", "phone-136us-real", "tablet-61us"])
@pytest.mark.parametrize("tolerance", [0.0, 0.5, float("inf")])
def test_a_room_of_one_lamp_is_its_scene_byte_for_byte(preset: str, tolerance: float) -> None:
    scene = occ.load_preset(preset).replace(**SMALL, **TURNED)
    frame = occ.render(scene, tolerance=tolerance, seed=3)
    made = render_room(Room.of_scene(scene), tolerance=tolerance, seed=3)
    np.testing.assert_array_equal(made.camera_image, frame.camera_image)
    if frame.plan.kinds - {"column"}:  # with these alone, a scene is enhanced before rounding
        np.testing.assert_array_equal(made.image, frame.image)


def test_a_lamp_out_of_the_picture_changes_nothing() -> None:
    scene = occ.load_preset("phone-136us").replace(**SMALL, **TURNED)
    alone = Room.of_scene(scene)
    for place in ({"x": 30.0}, {"z": -2.0}, {"pitch": 0.0, "x": -5.0}):
        made = render_room(_beside(alone, **place), seed=3)
        np.testing.assert_array_equal(made.camera_image, render_room(alone, seed=3).camera_image)


def test_a_lamp_that_only_distortion_brings_into_the_picture_is_drawn_and_bounded() -> None:
    room = small_room(
        1, camera=Place(z=0.0), illuminance=0.0, equivalent_focal_length=0.0181,
        radial_k1=-0.25, radial_k2=0.03,
    )  # fmt: skip
    # A lamp of 0.8 m x 0.7 m in the plane z = 2.6 m, with its first corner at this pixel.
    corner = np.array([740.0, 490.0])
    x, y = image_rays(undistort(corner, room.scene), room.scene.camera) * 2.6
    lamp = dataclasses.replace(room.lamps[0], x=float(x) + 0.4, y=float(y) + 0.35, roll=0.0)
    frame = occ.render_room(room.replace(lamps=(lamp,)))
    (shown,) = frame.lamps
    assert np.hypot(*(shown.outline - corner).T).min() < 0.1
    lit = np.argwhere(frame.camera_image > 40)
    assert lit.min(axis=0) == pytest.approx(corner[::-1], abs=12)  # a chip may be dark there
    # The part of the lamps' plane that the camera sees ends at the picture's corners.
    seen = seen_outline(room, 2.6)
    x, y = image_rays(undistort(np.array([767.0, 511.0]), room.scene), room.scene.camera) * 2.6
    assert np.hypot(*(seen - [x, y]).T).min() < 1e-9


def test_far_from_other_lamps_a_pixel_is_that_of_the_lamps_own_scene() -> None:
    scene = occ.load_preset("phone-136us-real").replace(**SMALL, jpeg_quality=0, distance=3.0)
    alone = Room.of_scene(scene)
    made = render_room(_beside(alone, x=1.0, y=0.3), tolerance=0.0, seed=3)
    own = occ.render(scene, tolerance=0.0, seed=3).camera_image
    left = np.s_[:, :460]
    np.testing.assert_array_equal(made.camera_image[left], own[left])
    assert (made.camera_image[:, 460:] != own[:, 460:]).mean() > 0.05


def test_the_light_of_overlapping_lamps_adds_up_before_the_tone_curve() -> None:
    scene = occ.load_preset("phone-136us").replace(
        **SMALL, luminance=400.0, gain_variation=0.0, averaging="light", roll=0.2
    )
    one = Room.of_scene(scene)
    two = _beside(one, x=0.2, y=0.1, start_time=0.7e-3)
    off = {"fixed-pattern": False, "sensor-noise": False}
    images = [
        render_room(room, tolerance=0.0, force=off).camera_image.astype(float)
        for room in (one, two.replace(lamps=two.lamps[1:]), two, one.replace(x=9.0))
    ]
    first, second, both, dark = (luminance_of(image, scene.camera) for image in images)
    shared = (images[0] > images[3]) & (images[1] > images[3])
    assert shared.mean() > 0.02
    assert images[2].max() < 255.0
    step = luminance_of(images[2] + 0.5, scene.camera) - both
    worst = np.abs(both - (first + second - dark)) / step
    assert worst.max() < 4.0  # rounding errors of four pictures


def test_mains_flicker_does_not_depend_on_the_start_of_a_lamps_packet() -> None:
    scene = occ.load_preset("phone-136us").replace(
        **SMALL, flicker_depth=0.9, illuminance=2000.0, gain_variation=0.0, luminance=100.0
    )
    off = {"fixed-pattern": False, "sensor-noise": False}
    room = Room.of_scene(scene)
    late = room.replace(lamps=(dataclasses.replace(room.lamps[0], start_time=1.7e-3),))
    first, second = (
        render_room(one, tolerance=0.0, force=off).camera_image for one in (room, late)
    )
    beside = first[0]
    assert np.ptp(beside) > 20
    np.testing.assert_array_equal(beside, second[0])
    lit = render_room(room, tolerance=0.0, force=off).lamps[0].region
    top = lit.first_row, slice(lit.first_column, lit.last_column)
    assert (first[top] != second[top]).any()


def test_the_pixels_lit_by_a_disc_are_those_of_its_circle() -> None:
    scene = occ.load_preset("phone-136us").replace(**SMALL, switching_frequency=1e6)
    lamp = RoomLamp(name="disc", shape="disc", z=1.5, transmitter=scene.transmitter)
    made = render_room(Room(lamps=(lamp,), scene=scene), tolerance=float("inf"))
    area = np.pi * (0.3 / 1.5 * scene.camera.focal_length_pixels) ** 2
    lit = (made.camera_image > made.camera_image[0, 0]).sum()
    assert lit == pytest.approx(area, rel=2e-3)


def test_a_turned_camera_shows_a_lamp_where_an_independent_projection_does() -> None:
    scene = occ.load_preset("phone-136us").replace(**SMALL)
    lamp = RoomLamp(name="a", x=0.3, y=-0.2, z=2.7, roll=0.4, transmitter=scene.transmitter)
    place = Place(x=0.1, y=0.2, z=0.9, yaw=0.25, pitch=-0.15, roll=1.1)
    made = render_room(Room(lamps=(lamp,), scene=scene, camera=place))

    def about(axis: np.ndarray, angle: float, points: np.ndarray) -> np.ndarray:
        cross = np.cross(axis, points)  # Rodrigues' formula
        along = np.outer(points @ axis, axis)
        return points * np.cos(angle) + cross * np.sin(angle) + along * (1 - np.cos(angle))

    x, y, z = np.eye(3)
    corners = np.array([[-0.3, -0.3, 0], [0.3, -0.3, 0], [0.3, 0.3, 0], [-0.3, 0.3, 0]])
    corners = about(z, 0.4, corners) + np.array([0.2, -0.4, 1.8])
    for axis, angle in ((z, -1.1), (y, -0.25), (x, 0.15)):
        corners = about(axis, angle, corners)
    expected = corners[:, :2] / corners[:, 2:] * scene.camera.focal_length_pixels
    expected += [(800 - 1) / 2, (600 - 1) / 2]
    np.testing.assert_allclose(made.lamps[0].outline, expected, atol=1e-9)


def test_the_plan_of_a_picture_includes_every_effect_that_a_lamp_needs() -> None:
    random = np.random.default_rng([2512, 0])
    scene = occ.load_preset("phone-136us-real").replace(
        rows=300, columns=400, focus_distance=float(random.uniform(0.5, 3.0))
    )
    lamps = tuple(
        RoomLamp(
            name=f"{n}", x=float(random.uniform(-1.5, 1.5)), y=float(random.uniform(-1.0, 1.0)),
            z=float(random.uniform(1.5, 3.5)), pitch=float(random.uniform(-0.4, 0.4)),
            transmitter=scene.transmitter.replace(
                panel_width=float(random.uniform(0.1, 0.6)),
                luminance=float(10.0 ** random.uniform(2.5, 4.0)),
                switching_frequency=float(10.0 ** random.uniform(3.3, 4.5)),
            ),
        )
        for n in range(12)
    )  # fmt: skip
    room = Room(lamps=lamps, scene=scene)
    for tolerance in (0.5, 3.0):
        joined = set(render_room(room, tolerance=tolerance).plan.included)
        views = [seen.view for seen in lamps_in_view(room)]
        assert len(views) > 6
        settings = SimulationSettings(tolerance, "image")
        each = [set(plan_of(view, settings).included) for view in views]
        assert set.union(*each) == joined


@pytest.mark.parametrize(
    ("own", "effect"), [({"lambertian_order": 6.0}, "emission"), ({"edge_time": 2e-5}, "led-edges")]
)
def test_an_effect_of_a_single_lamp_is_planned(own: dict[str, float], effect: str) -> None:
    scene = occ.load_preset("phone-136us").replace(**SMALL)
    lamps = tuple(
        RoomLamp(
            name=f"{n}", x=0.5 * (n % 3 - 1), y=0.4 * (n // 3 - 1), z=1.5, yaw=0.3,
            transmitter=scene.transmitter.replace(
                panel_width=0.3, panel_height=0.3, **(own if n == 4 else {})
            ),
        )
        for n in range(9)
    )  # fmt: skip
    with_it, without = (
        render_room(Room(lamps=some, scene=scene), tolerance=0.2).plan.included
        for some in (lamps, (*lamps[:4], *lamps[5:]))
    )
    assert effect in with_it
    assert effect not in without
