"""Jobs of the room's pane: make a picture from a place and read it, or map the floor."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np

from occ_gui.background.task import TaskReporter
from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.reading.load import load_photo
from occ_model.room.locate import RoomReading, read_room, read_room_photo
from occ_model.room.render import render_room
from occ_model.room.room import Room
from occ_model.room.view import aim_of, room_outline, seen_outline
from occ_model.study.room_map import RoomMapRequest, RoomPoint, places_under, room_map

_WIDTH = 900
"""Columns of the reduced picture, in area means, because samples would show false stripes."""

SIDE = 5  # places of the map on each side of the floor


@dataclass(frozen=True, eq=False, slots=True)
class RoomPlan:
    """A room from above: x and y in metres."""

    outlines: dict[str, FloatArray]  # of the lamps, by name, each of shape (corners, 2)
    # Corners of what the camera sees at the lamps' height; empty if it does not look up
    view: FloatArray
    aim: tuple[float, float]  # the middle of what it sees
    height: float  # the lamps' mean height


@dataclass(frozen=True, slots=True)
class Look:
    """Source of the picture: the room's camera, or a photo of the room."""

    room: Room
    photo: Path | None = None
    # Equivalent focal length of the photo in metres; None for that in its file, or the room's
    focal_length: float | None = None


@dataclass(frozen=True, eq=False, slots=True)
class ShownRoom:
    """A picture of a room, a reduced copy for the screen, and its reading once there is one."""

    look: Look
    room: Room  # as used for reading, but with the camera of a photo at the place that was found
    image: ByteArray
    picture: ByteArray  # the reduced copy
    reading: RoomReading | None
    assumed: tuple[str, ...] = ()  # sentences on what is assumed about a photo's camera


@dataclass(frozen=True, eq=False, slots=True)
class FloorMap:
    request: RoomMapRequest
    points: tuple[RoomPoint, ...]


def plan_of(room: Room) -> RoomPlan:
    height = float(np.mean([lamp.z for lamp in room.lamps]))
    outlines = {lamp.name: room_outline(lamp)[:, :2] for lamp in room.lamps}
    return RoomPlan(outlines, seen_outline(room, height), aim_of(room.camera, height), height)


def show_room(look: Look, report: TaskReporter) -> ShownRoom:
    if look.photo is not None:
        return _show_photo(look, look.photo, report)
    room = look.room
    image = render_room(room, noise="reused").camera_image
    shown = ShownRoom(look, room, image, _reduce(image), None)
    report(shown)
    return replace(shown, reading=read_room(image, room))


def _show_photo(look: Look, path: Path, report: TaskReporter) -> ShownRoom:
    photo = load_photo(path)
    report(ShownRoom(look, look.room, photo.image, _reduce(photo.image), None))
    read = read_room_photo(photo, look.room, look.focal_length)
    located = read.reading.located
    room = read.room if located is None else read.room.replace(camera=located.place)
    return ShownRoom(look, room, read.image, _reduce(read.image), read.reading, read.assumed)


def _reduce(image: ByteArray) -> ByteArray:
    scale = min(1.0, _WIDTH / image.shape[1])
    size = (round(image.shape[1] * scale), max(1, round(image.shape[0] * scale)))
    return np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)


def map_room(room: Room, report: Callable[[float], object]) -> FloorMap:
    request = RoomMapRequest(room, *places_under(room, SIDE))
    points = room_map(request, progress=lambda done, total, _: report(done / total))
    return FloorMap(request, points)
