"""The command ``occ-model room``: simulate a room's picture, or find where one was taken."""

import argparse
import math
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from occ_model.commands.bars import run_study
from occ_model.commands.files import PICTURE, TABLE
from occ_model.commands.options import (
    Commands,
    add_option,
    add_simulation_options,
    add_work_options,
    number,
    simulation_settings_of,
)
from occ_model.errors import inflect, one_line
from occ_model.files.writing import write_image
from occ_model.photo.reading.load import load_photo
from occ_model.program import EXIT_FAILURE, EXIT_INTERRUPTED
from occ_model.room.locate import RoomReading, read_room
from occ_model.room.locate_photo import read_room_photo
from occ_model.room.place_text import AXES, format_place
from occ_model.room.render import RoomFrame, render_room
from occ_model.room.room import Room
from occ_model.room.rooms import load_room, rooms
from occ_model.scene.from_text import change_scene
from occ_model.scene.scene import TOLERANCE, SimulationSettings
from occ_model.study.room_map import (
    RoomMapRequest,
    RoomMapText,
    RoomPoint,
    places_under,
    room_map,
)
from occ_model.study.sweep.measure import Progress

_FOCAL_LENGTH = "equivalent_focal_length"


def add_to(commands: Commands) -> None:
    parser = commands.add_parser(
        "room", help="many lamps in one picture: their names, and the camera's place"
    )
    kinds = parser.add_subparsers(required=True, metavar="ACTION")
    render = kinds.add_parser("render", help="simulate the camera's picture of a room")
    _add_room(render)
    add_simulation_options(render)
    render.add_argument("-o", "--out", type=Path, required=True, help="image file to write")
    render.set_defaults(command=_run_render, writes={"out": PICTURE})
    locate = kinds.add_parser(
        "locate", help="name the lamps in a picture and say where it was taken"
    )
    _add_room(locate)
    locate.add_argument(
        "file",
        nargs="?",
        type=Path,
        help="a photo, with the focal length in its EXIF data or else that of the room; "
        "default: a simulated picture, with its true place",
    )
    add_simulation_options(locate)
    locate.set_defaults(command=_run_locate)
    floor = kinds.add_parser(
        "map",
        help="measure across the floor how many lamps are read, and how well the place is known",
    )
    _add_room(floor, AXES[2:])  # x and y are those of places on the floor
    add_option(floor, "--side", 5, "places on each side of the floor below the lamps", metavar="N")
    add_option(floor, "--images", 1, "a place")
    add_option(floor, "--seed", 1)
    floor.add_argument("--tolerance", type=number, default=TOLERANCE.default, metavar="LEVELS")
    add_work_options(floor)
    floor.set_defaults(command=_run_map, writes={"out": TABLE})


def _add_room(parser: argparse.ArgumentParser, axes: Sequence[str] = AXES) -> None:
    parser.add_argument(
        "--room", default="office", help=f"{', '.join(rooms())}, or a room file; default: office"
    )
    parser.add_argument(
        "--set", action="append", default=[], dest="settings", metavar="NAME=VALUE",
        help="a parameter of the camera, or of all lamps; may be repeated",
    )  # fmt: skip
    for name in axes:
        unit = "metres" if name in "xyz" else "degrees"
        parser.add_argument(f"--{name}", type=number, help=f"of the camera, in {unit}")


def _room_of(options: argparse.Namespace) -> Room:
    room = load_room(options.room)
    changed = change_scene(room.scene, options.settings)
    names = [text.split("=", 1)[0].strip() for text in options.settings]
    room = room.with_sent(**{name: changed.value(name) for name in names})
    given = {name: value for name in AXES if (value := getattr(options, name, None)) is not None}
    return room.replace(
        **{name: v if name in "xyz" else math.radians(v) for name, v in given.items()}
    )


def _run_render(options: argparse.Namespace) -> int:
    room, settings = _room_of(options), simulation_settings_of(options)
    frame = _render_with_settings(room, settings)
    write_image(options.out, frame.camera_image, "Camera's picture")
    shown = [result.lamp.name + (" (cut)" if result.is_cut else "") for result in frame.lamps]
    seconds = sum(frame.timings.values())
    print(
        f"{one_line(str(options.out))}: {len(shown)} of {len(room.lamps)} lamps in the picture, "
        f"simulated in {1e3 * seconds:.1f} ms: {one_line(', '.join(shown)) or 'none'}"
    )
    return 0


def _render_with_settings(room: Room, settings: SimulationSettings) -> RoomFrame:
    return render_room(
        room, tolerance=settings.tolerance, seed=settings.seed, observable=settings.observable,
        force=settings.force,
    )  # fmt: skip


def _run_map(options: argparse.Namespace) -> int:
    room = _room_of(options)
    places = places_under(room, options.side)
    request = RoomMapRequest(room, *places, options.images, options.seed, options.tolerance)

    def run(progress: Progress) -> tuple[RoomPoint, ...]:
        return room_map(request, jobs=options.jobs, progress=progress, results=options.out)

    points = run_study(run, options)
    if points is None:
        return EXIT_INTERRUPTED
    if not options.out:
        text = RoomMapText(request)
        sys.stdout.writelines([text.header, *map(text.text, points)])
        return 0
    pictures = request.point_count * request.images
    sure, named, wrong, shown = (
        sum(getattr(point, count) for point in points)
        for count in ("sure_places", "named", "named_wrongly", "whole")
    )
    errors = [point.error for point in points if point.sure_places]
    median = f", median error {1e3 * float(np.median(errors)):.3g} mm" if errors else ""
    print(
        f"{one_line(str(options.out))}: {inflect(request.point_count, 'place')}, "
        f"{inflect(pictures, 'picture')}: {named} of {shown} whole lamps named, "
        f"{inflect(wrong, 'lamp')} named wrongly; {inflect(sure, 'place')} sure{median}"
    )
    return 0


def _run_locate(options: argparse.Namespace) -> int:
    room, settings = _room_of(options), simulation_settings_of(options)
    if options.file is None:
        reading = read_room(_render_with_settings(room, settings).camera_image, room)
    else:
        given = any(text.split("=")[0].strip() == _FOCAL_LENGTH for text in options.settings)
        focal_length = room.scene.camera.equivalent_focal_length if given else None
        photo_reading = read_room_photo(load_photo(options.file), room, focal_length)
        reading = photo_reading.reading
        for sentence in photo_reading.assumed:
            print(f"Assumed. {sentence}")
    _print_reading(reading)
    if options.file is None:
        print("True place: " + format_place(room.camera))
    return 0 if reading.located else EXIT_FAILURE


def _print_reading(reading: RoomReading) -> None:
    for lamp in reading.lamps:
        at = f"columns {lamp.region.first_column} to {lamp.region.last_column - 1}"
        name = one_line(lamp.name or "unnamed")
        print(f"{name}: {lamp.light_words}, {at}. {one_line(lamp.note)}".rstrip())
    for reason in reading.reasons:
        print(reason)
    for result in filter(None, (reading.located, *reading.alternatives)):
        print("I am here:  " + format_place(result.place, result))
        if result.focal_error:
            focal, error = 1e3 * result.focal_length, 1e3 * result.focal_error
            print(f"Focal length that fits: {focal:.2f} ± {error:.2g} mm equivalent.")
