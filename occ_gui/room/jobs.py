"""Jobs of the room's pane: make a picture from a place and read it, or map the floor."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np

from occ_gui.background.task import TaskReporter
from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.reading.load import load_photo
from occ_model.room.locate import RoomReading, read_room
from occ_model.room.locate_photo import read_room_photo
from occ_model.room.render import render_room
from occ_model.room.room import Room
from occ_model.room.view import aim_of, room_outline, seen_outline
from occ_model.study.room_map import RoomMapRequest, RoomPoint, places_under, room_map

_REDUCED_COLUMNS = 900
"""Columns of the reduced picture, whose pixels are area means, to avoid aliasing."""

PLACES_PER_SIDE = 5  # places of the map on each side of the floor


@dataclass(frozen=True, eq=False, slots=True)
class RoomPlan:
    """A room from above: x and y in metres."""

    outlines: dict[str, FloatArray]  # of the lamps, by name, each of shape (corners, 2)
    # Corners of the field of view at the lamps' height; empty if the camera does not look up
    view: FloatArray
    aim: tuple[float, float]  # the middle of the field of view
    height: float  # the lamps' mean height


@dataclass(frozen=True, slots=True)
class PictureSource:
    """Source of the picture: the room's camera, or a photo of the room."""

    room: Room
    photo: Path | None = None
    # Equivalent focal length of the photo in metres; None for that in its file, or the room's
    focal_length: float | None = None


@dataclass(frozen=True, eq=False, slots=True)
class RoomPicture:
    """A picture of a room, a reduced copy for the screen, and its reading once there is one."""

    source: PictureSource
    room: Room  # as used for reading, but with the camera of a photo at the place that was found
    image: ByteArray
    reduced: ByteArray  # the copy for the screen
    reading: RoomReading | None
    assumptions: tuple[str, ...] = ()  # sentences on what is assumed about a photo's camera


@dataclass(frozen=True, eq=False, slots=True)
class FloorMap:
    request: RoomMapRequest
    points: tuple[RoomPoint, ...]


def plan_of(room: Room) -> RoomPlan:
    height = float(np.mean([lamp.z for lamp in room.lamps]))
    outlines = {lamp.name: room_outline(lamp)[:, :2] for lamp in room.lamps}
    return RoomPlan(outlines, seen_outline(room, height), aim_of(room.camera, height), height)


def make_picture(source: PictureSource, report: TaskReporter) -> RoomPicture:
    if source.photo is not None:
        return _read_photo(source, source.photo, report)
    room = source.room
    image = render_room(room).camera_image
    picture = RoomPicture(source, room, image, _reduce(image), None)
    report(picture)
    return replace(picture, reading=read_room(image, room))


def _read_photo(source: PictureSource, path: Path, report: TaskReporter) -> RoomPicture:
    photo = load_photo(path)
    report(RoomPicture(source, source.room, photo.image, _reduce(photo.image), None))
    result = read_room_photo(photo, source.room, source.focal_length)
    located = result.reading.located
    room = result.room if located is None else result.room.replace(camera=located.place)
    return RoomPicture(
        source, room, result.image, _reduce(result.image), result.reading, result.assumed
    )


def _reduce(image: ByteArray) -> ByteArray:
    scale = min(1.0, _REDUCED_COLUMNS / image.shape[1])
    size = (round(image.shape[1] * scale), max(1, round(image.shape[0] * scale)))
    return np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)


def map_room(room: Room, report: Callable[[float], object]) -> FloorMap:
    request = RoomMapRequest(room, *places_under(room, PLACES_PER_SIDE))
    points = room_map(request, progress=lambda done, total, _: report(done / total))
    return FloorMap(request, points)
