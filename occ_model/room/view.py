"""Find the lamps in view of a room's camera, each as a scene of its own."""

import dataclasses
import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.projection import image_points, image_rays, rotation_of
from occ_model.effects.distortion import part_inside, undistort_frame
from occ_model.effects.effect import PaperView, paper_view_of, region_of
from occ_model.effects.optics_effects import blur_of
from occ_model.errors import ParameterError, ProjectionError, one_line
from occ_model.light.cosine import Cosine
from occ_model.light.sent import light_of
from occ_model.room.room import Place, Room, RoomLamp
from occ_model.scene.scene import Pose, Scene, Surroundings

_DISC_CORNERS = 96  # of a disc's polygon, which is within 0.06 % of the radius of the circle
_MIN_DEPTH = 1e-3  # depth in metres below which nothing is visible


@dataclass(frozen=True, eq=False, slots=True)
class LampView:
    lamp: RoomLamp
    # The paper's view of the scene whose panel is the lamp, with the lamp's outline as corners
    view: PaperView


def rotation(place: Place | RoomLamp) -> FloatArray:
    return rotation_of(Pose(yaw=place.yaw, pitch=place.pitch, roll=place.roll))


def own_outline(lamp: RoomLamp) -> FloatArray:
    """Return a lamp's outline in its own plane in metres, shape (corners, 2), in order."""
    width, height = lamp.size
    if lamp.shape == "disc":
        angle = np.arange(_DISC_CORNERS) * (2.0 * math.pi / _DISC_CORNERS)
        return np.stack([np.cos(angle), np.sin(angle)], axis=1) * (width / 2.0)
    return np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * [width / 2, height / 2]


def room_outline(lamp: RoomLamp) -> FloatArray:
    """Return a lamp's outline in the room in metres, shape (corners, 3)."""
    return own_outline(lamp) @ rotation(lamp)[:, :2].T + [lamp.x, lamp.y, lamp.z]


def lamp_scene(room: Room, lamp: RoomLamp) -> Scene:
    """Return the scene whose panel is a lamp of the room, or the square around a disc.

    Raises ParameterError if the lamp's plane is turned too far from the picture's for a scene.
    """
    camera = room.camera
    if camera.yaw == camera.pitch == camera.roll == 0.0:
        angles = lamp.yaw, lamp.pitch, lamp.roll
        x, y, z = lamp.x - camera.x, lamp.y - camera.y, lamp.z - camera.z
    else:
        relative_rotation = rotation(camera).T @ rotation(lamp)
        angles = angles_of(relative_rotation)
        place = [lamp.x - camera.x, lamp.y - camera.y, lamp.z - camera.z]
        x, y, z = (rotation(camera).T @ place).tolist()
    pose = Pose(distance=z, offset_x=x, offset_y=y, yaw=angles[0], pitch=angles[1], roll=angles[2])
    return dataclasses.replace(scene_with_lamp(room, lamp), pose=pose)


def scene_with_lamp(room: Room, lamp: RoomLamp) -> Scene:
    """Return the room's scene with a lamp's light at the room's time; its pose has no meaning."""
    scene = room.scene
    width, height = lamp.size
    surroundings = _surroundings_of(room)
    if lamp.start_time and surroundings.flicker_depth:  # it follows the room's time, not the lamp's
        cycles = Fraction(surroundings.flicker_frequency) * Fraction(lamp.start_time)
        phase = surroundings.flicker_phase - 2.0 * math.pi * float(cycles % 1)
        phase = math.remainder(phase, 2.0 * math.pi)
        surroundings = dataclasses.replace(surroundings, flicker_phase=phase)
    return dataclasses.replace(
        scene,
        surroundings=surroundings,
        transmitter=lamp.transmitter.replace(panel_width=width, panel_height=height),
        model=scene.model.replace(start_time=scene.model.start_time + lamp.start_time),
    )


def _surroundings_of(room: Room) -> Surroundings:
    """Return the surroundings, which the room's first lamp on the mains lights."""
    for lamp in room.lamps:
        light = light_of(lamp.transmitter)
        if isinstance(light, Cosine):
            cycles = Fraction(light.frequency) * Fraction(lamp.start_time)
            turn = math.remainder(2.0 * math.pi * float(cycles % 1), 2.0 * math.pi)
            return room.scene.surroundings.replace(
                flicker_depth=light.depth, flicker_frequency=light.frequency, flicker_phase=turn
            )
    return room.scene.surroundings


def angles_of(matrix: FloatArray) -> tuple[float, float, float]:
    """Return yaw, pitch and roll of a rotation, the inverse of :func:`rotation_of`."""
    yaw = math.asin(min(1.0, max(-1.0, -float(matrix[2, 0]))))
    pitch = math.atan2(matrix[2, 1], matrix[2, 2])
    return yaw, pitch, math.atan2(matrix[1, 0], matrix[0, 0])


def lamps_in_view(room: Room) -> tuple[LampView, ...]:
    """Return the lamps whose front a pixel can show, in the room's order.

    Raises ProjectionError if one of them is partly behind the camera or turned by 90 degrees or
    more, or if the lens folds the picture.
    """
    frame = undistort_frame(room.scene)
    return tuple(
        lamp_view for lamp in room.lamps if (lamp_view := _view_lamp(room, lamp, frame)) is not None
    )


def _view_lamp(room: Room, lamp: RoomLamp, frame: FloatArray) -> LampView | None:
    camera_rotation = rotation(room.camera)
    camera_position = [room.camera.x, room.camera.y, room.camera.z]
    outline = (room_outline(lamp) - camera_position) @ camera_rotation
    facing = rotation(lamp)[:, 2] @ (np.array([lamp.x, lamp.y, lamp.z]) - camera_position)
    visible_part = part_inside(outline, outline[:, 2] - _MIN_DEPTH)  # in front of the camera
    if facing <= 0.0 or len(visible_part) == 0:
        return None
    camera = room.scene.camera
    corners = image_points(visible_part[:, :2] / visible_part[:, 2:], camera)
    first, size = frame.min(axis=0), np.ptp(frame, axis=0) + 1.0
    try:
        scene = lamp_scene(room, lamp)
        margin = float(4.0 * blur_of(scene) * size.max() / max(camera.rows, camera.columns))
    except ParameterError:
        scene, margin = None, 0.0
    columns, rows = np.ceil(size + 2.0 * margin).astype(int).tolist()
    if region_of(corners - first + margin, rows, columns) is None:
        return None
    if scene is None or outline[:, 2].min() < _MIN_DEPTH:
        raise ProjectionError(
            f"Lamp {one_line(lamp.name)} reaches into the picture and is partly behind the camera, "
            "or its plane is turned by 90° or more from the picture's; move or turn the camera.",
            parameters=("yaw", "pitch"),
        )
    view = paper_view_of(scene)
    if lamp.shape == "disc":
        region = region_of(corners, camera.rows, camera.columns)
        view = dataclasses.replace(
            view, corners=corners, sides=None, is_visible=region is not None,
            region=region or view.region,
        )  # fmt: skip
    return LampView(lamp, view)


def seen_outline(room: Room, height: float) -> FloatArray:
    """Return the outline in x and y of the part of a level plane that the camera sees.

    It is empty if a part of the picture shows nothing above the camera, or if the lens folds the
    picture.
    """
    camera, place = room.scene.camera, room.camera
    try:
        rays = image_rays(undistort_frame(room.scene), camera)
    except ProjectionError:
        return np.empty((0, 2))
    directions = np.column_stack([rays, np.ones(len(rays))]) @ rotation(place).T
    distance = height - place.z
    if distance <= 0.0 or directions[:, 2].min() <= _MIN_DEPTH:
        return np.empty((0, 2))
    return np.asarray([place.x, place.y] + directions[:, :2] / directions[:, 2:] * distance)


def aim_of(place: Place, height: float) -> tuple[float, float]:
    """Return the point of a level plane above the camera in the middle of its picture."""
    x, y, z = rotation(place)[:, 2].tolist()
    distance = (height - place.z) / max(z, _MIN_DEPTH)
    return place.x + distance * x, place.y + distance * y


def aim_at(place: Place, x: float, y: float, height: float) -> Place:
    """Return a camera turned to have a point in the middle of its picture, with the same roll."""
    direction = np.array([x - place.x, y - place.y, height - place.z])
    direction /= np.linalg.norm(direction)
    camera_direction = rotation_of(Pose(roll=place.roll)).T @ direction
    pitch, yaw = (
        -math.asin(float(camera_direction[1])),
        math.atan2(float(camera_direction[0]), float(camera_direction[2])),
    )
    return dataclasses.replace(place, yaw=yaw, pitch=pitch)
