"""What the pane of the room shows: the picture from a place, and what is read of it."""

from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np

from occ_gui.background.task import Reporter
from occ_model.arrays import ByteArray, FloatArray
from occ_model.room.locate import RoomReading, read_room
from occ_model.room.render import RoomFrame, render_room
from occ_model.room.room import Room
from occ_model.room.view import aim_of, room_outline, seen_outline
from occ_model.study.room_map import RoomMapRequest, RoomPoint, floor_under, room_map

_WIDTH = 900
"""Columns of the picture that is shown: area means, as a coarser one would show false stripes."""

SIDE = 5
"""Places of the map on each side of the floor."""


@dataclass(frozen=True, eq=False, slots=True)
class RoomPlan:
    """A room from above: x and y in metres.

    Parameters
    ----------
    outlines
        Of the lamps, by name, each of shape (corners, 2).
    seen
        What the camera sees at the lamps' height; empty where it does not look up.
    aim
        The middle of what it sees.
    height
        The lamps' mean height.
    """

    outlines: dict[str, FloatArray]
    seen: FloatArray
    aim: tuple[float, float]
    height: float


@dataclass(frozen=True, eq=False, slots=True)
class ShownRoom:
    """A picture of a room, small enough for the screen, and its reading once it is there."""

    room: Room
    frame: RoomFrame
    picture: ByteArray
    scale: float
    reading: RoomReading | None


@dataclass(frozen=True, eq=False, slots=True)
class FloorMap:
    """A map over the floor of a room."""

    request: RoomMapRequest
    points: tuple[RoomPoint, ...]


def plan_of(room: Room) -> RoomPlan:
    """Draw up a room from above."""
    height = float(np.mean([lamp.z for lamp in room.lamps]))
    outlines = {lamp.name: room_outline(lamp)[:, :2] for lamp in room.lamps}
    return RoomPlan(outlines, seen_outline(room, height), aim_of(room.camera, height), height)


def show_room(room: Room, report: Reporter) -> ShownRoom:
    """Take the picture, report it, and read it."""
    frame = render_room(room, noise="reused")
    image = frame.camera_image
    scale = min(1.0, _WIDTH / image.shape[1])
    size = (round(image.shape[1] * scale), max(1, round(image.shape[0] * scale)))
    small = np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
    report(ShownRoom(room, frame, small, scale, None))
    return ShownRoom(room, frame, small, scale, read_room(image, room))


def map_room(room: Room, report: Callable[[float], object]) -> FloorMap:
    """Measure a map over the floor below a room's lamps."""
    request = RoomMapRequest(room, *floor_under(room, SIDE))
    found = room_map(request, progress=lambda done, total, _: report(done / total))
    return FloorMap(request, found)
