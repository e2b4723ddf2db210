"""Find where a photo of a room was taken, and what is assumed of its camera."""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.camera.projection import check_size
from occ_model.photo.photo_scene import with_notes
from occ_model.photo.reading.load import Photo
from occ_model.room.locate import RoomReading, read_room
from occ_model.room.room import Room
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND

_SHAPE_ERROR = 0.01  # relative difference of aspect ratios above which a picture is not just scaled


@dataclass(frozen=True, eq=False, slots=True)
class RoomPhoto:
    room: Room  # The room used for reading, whose camera has the photo's size and settings
    # Shape (rows, columns): the photo as it was read, with the columns in the order of exposure
    image: ByteArray
    reading: RoomReading
    assumed: tuple[str, ...]  # Sentences on what is assumed about camera and lens, with the source


def read_room_photo(photo: Photo, room: Room, focal_length: float | None = None) -> RoomPhoto:
    """Name the lamps in a photo of a room, and find where it was taken.

    Exposure time, ISO speed, aperture and, unless given, the equivalent focal length (in metres)
    are taken from the EXIF data, or else from the room; the errors include the rounding of the
    focal length. A photo is turned by a right angle if the stripes are horizontal, and by half a
    turn if no lamp is named. Raises ParameterError for a focal length out of range, and
    ProjectionError for a photo that is too large.
    """
    upright: ByteArray = np.ascontiguousarray(photo.image[::-1] if photo.turned else photo.image)
    scene, assumed = _camera_of(photo, upright, room.scene)
    scene, fraction, focal_note = _with_focal_length(photo, scene, focal_length)
    photo_room = room.replace(scene=scene)
    check_size(scene.camera)
    reading, image = read_room(upright, photo_room, fraction), upright
    turned = 90 if photo.turned else 0
    if not any(lamp.name for lamp in reading.lamps):
        upside_down = np.ascontiguousarray(upright[::-1, ::-1])
        other_reading = read_room(upside_down, photo_room, fraction)
        if any(lamp.name for lamp in other_reading.lamps):
            reading, image, turned = other_reading, upside_down, turned + 180
    if turned:
        assumed.append(f"The photo is turned by {turned}° for reading; the angles refer to that.")
    return RoomPhoto(photo_room, image, reading, (focal_note, *assumed))


def _camera_of(photo: Photo, image: ByteArray, scene: Scene) -> tuple[Scene, list[str]]:
    camera, (rows, columns) = scene.camera, image.shape
    readout, scale_note = camera.readout_time, ""
    is_scaled = math.isclose(rows / columns, camera.rows / camera.columns, rel_tol=_SHAPE_ERROR)
    if is_scaled and columns != camera.columns:
        readout *= camera.columns / columns
        scale_note = f", scaled to a picture of {columns} columns instead of {camera.columns}"
    scene = with_notes(scene.replace(rows=rows, columns=columns, readout_time=readout), photo)
    if photo.is_linear:
        scene = scene.replace(gamma=1.0)
    source = "EXIF data say" if photo.exposure_time == scene.camera.exposure_time else "room says"
    distortion = "that of the room" if scene.lens.distorts else "none"
    return scene, [
        f"Readout time: {SECOND.format(readout)} a column, as the room says{scale_note}.",
        f"Exposure time: {SECOND.format(scene.camera.exposure_time)}, as the {source}.",
        f"Distortion: {distortion}; the lens's axis passes through the middle of the picture.",
    ]


def _with_focal_length(
    photo: Photo, scene: Scene, focal_length: float | None
) -> tuple[Scene, float, str]:
    exif_length, fraction = photo.equivalent_focal_length, 0.0
    if focal_length is not None:
        PARAMETERS["equivalent_focal_length"].check(focal_length)
        value, source = focal_length, "as given"
    elif exif_length is not None:
        error = photo.focal_length_step / math.sqrt(12.0)  # of rounding to this step
        value, fraction = exif_length, error / exif_length
        source = f"± {1e3 * error:.2g} mm, as the EXIF data say, if the picture is not cropped"
    else:
        value = scene.camera.equivalent_focal_length
        source = "as the room says, because the photo has no EXIF data on it"
    scene = scene.replace(equivalent_focal_length=value)
    return scene, fraction, f"Focal length: {1e3 * value:.4g} mm equivalent, {source}."
