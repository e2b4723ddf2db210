"""The command ``occ-model room``: draw a room's picture, or say where a picture was taken."""

import argparse
import math
from pathlib import Path

import numpy as np

from occ_model.commands.options import (
    Commands,
    add_simulation_options,
    number,
    simulation_settings_of,
)
from occ_model.errors import one_line
from occ_model.files.writing import check_replaceable, write_image
from occ_model.photo.reading.load import load_photo
from occ_model.program import EXIT_FAILURE
from occ_model.room.locate import Located, RoomReading, read_room
from occ_model.room.render import render_room
from occ_model.room.room import Place, Room
from occ_model.room.rooms import load_room, rooms

_AXES = tuple(Place.__dataclass_fields__)


def add_to(commands: Commands) -> None:
    """Add the command."""
    parser = commands.add_parser("room", help="many lamps in one picture: which, and from where")
    kinds = parser.add_subparsers(required=True, metavar="ACTION")
    render = kinds.add_parser("render", help="simulate the camera's picture of a room")
    _add_room(render)
    add_simulation_options(render)
    render.add_argument("-o", "--out", type=Path, required=True, help="image file to write")
    render.set_defaults(command=_render)
    locate = kinds.add_parser(
        "locate", help="name the lamps in a picture and say where it was taken"
    )
    _add_room(locate)
    locate.add_argument(
        "file", nargs="?", type=Path, help="the picture; default: simulate it and compare"
    )
    add_simulation_options(locate)
    locate.set_defaults(command=_locate)


def _add_room(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--room", default="office", help=f"{', '.join(rooms())}, or a room file; default: office"
    )
    for name in _AXES:
        unit = "metres" if name in "xyz" else "degrees"
        parser.add_argument(f"--{name}", type=number, help=f"of the camera, in {unit}")


def _room_of(options: argparse.Namespace) -> Room:
    given = {name: getattr(options, name) for name in _AXES if getattr(options, name) is not None}
    return load_room(options.room).replace(
        **{name: v if name in "xyz" else math.radians(v) for name, v in given.items()}
    )


def _render(options: argparse.Namespace) -> int:
    room, settings = _room_of(options), simulation_settings_of(options)
    check_replaceable(options.out)
    frame = render_room(
        room, tolerance=settings.tolerance, seed=settings.seed, observable=settings.observable,
        force=settings.force, noise=settings.noise,
    )  # fmt: skip
    write_image(options.out, frame.camera_image, "Camera's picture")
    shown = [one.lamp.name + (" (cut)" if one.is_cut else "") for one in frame.lamps]
    seconds = sum(frame.timings.values())
    print(
        f"{one_line(str(options.out))}: {len(shown)} of {len(room.lamps)} lamps in the picture, "
        f"simulated in {1e3 * seconds:.1f} ms: {one_line(', '.join(shown)) or 'none'}"
    )
    return 0


def _locate(options: argparse.Namespace) -> int:
    room, settings = _room_of(options), simulation_settings_of(options)
    if options.file is None:
        image = render_room(
            room, tolerance=settings.tolerance, seed=settings.seed, observable=settings.observable,
            force=settings.force, noise=settings.noise,
        ).camera_image  # fmt: skip
    else:
        image = load_photo(options.file).image
        focal = room.scene.camera.equivalent_focal_length
        bends = "with the room's distortion" if room.scene.lens.distorts else "without distortion"
        print(f"Assumed of the lens: {1e3 * focal:.3g} mm equivalent, {bends}, as the room says.")
    reading = read_room(image, room)
    _print(reading)
    if options.file is None:
        print("True place: " + _numbers_of(room.camera))
    return 0 if reading.located else EXIT_FAILURE


def _print(reading: RoomReading) -> None:
    for lamp in reading.lamps:
        at = f"columns {lamp.region.first_column} to {lamp.region.last_column - 1}"
        code = "no code" if lamp.code is None else f"code {lamp.code}"
        print(f"{one_line(lamp.name or 'unnamed')}: {code}, {at}. {one_line(lamp.note)}".rstrip())
    for reason in reading.reasons:
        print(reason)
    for one in filter(None, (reading.located, *reading.alternatives)):
        print("I am here:  " + _numbers_of(one.place, one))


def _numbers_of(place: Place, located: Located | None = None) -> str:
    texts = []
    errors = np.zeros(len(_AXES)) if located is None else located.errors
    for name, error in zip(_AXES, errors.tolist(), strict=True):
        value = getattr(place, name)
        scale, unit, digits = (1.0, "m", 4) if name in "xyz" else (180.0 / math.pi, "°", 2)
        own = f" ± {error * scale:.{digits}f}" if located else ""
        texts.append(f"{name} {value * scale:.{digits}f}{own} {unit}")
    return ", ".join(texts)
