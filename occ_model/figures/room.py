"""Draw a room for print: its plan, and the camera's picture with the names of its lamps."""

from collections.abc import Iterable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from occ_model import colours
from occ_model.arrays import ByteArray
from occ_model.figures.drawing import Drawing
from occ_model.room.locate import RoomReading
from occ_model.room.room import Place, Room
from occ_model.room.view import room_outline, seen_outline
from occ_model.scene.provenance import Provenance

_TITLE = "Room, its picture and the place found"
_NUMBERS = tuple(Place.__dataclass_fields__)


def room_drawing(
    room: Room, image: ByteArray, reading: RoomReading, *, is_photo: bool = False
) -> Drawing:
    """Draw a room and what was read of its picture, or of a photo of an unknown place."""

    def rows() -> Iterable[tuple[object, ...]]:
        found = reading.located
        errors = [None] * 6 if found is None else found.errors.tolist()
        for name, error in zip(_NUMBERS, errors, strict=True):
            value = None if found is None else getattr(found.place, name)
            true = None if is_photo else getattr(room.camera, name)
            yield name, true, value, error, None, None
        for read in reading.lamps:
            column, row = read.hull.mean(axis=0).tolist()
            yield read.name or "unnamed", None, None, None, column, row

    header = ("what", "true (m, rad)", "found", "standard deviation", "column", "row")
    return Drawing(
        "room", _TITLE, lambda: _draw(room, image, reading, is_photo), header, rows,
        lambda date: _provenance(room, date),
    )  # fmt: skip


def _provenance(room: Room, date: str) -> Provenance:
    notes = tuple(line for line in room.to_toml().splitlines() if line)
    return Provenance(_TITLE, {"the camera's": room.scene}, 1, notes, date)


def _draw(room: Room, image: ByteArray, reading: RoomReading, is_photo: bool) -> Figure:
    figure = Figure(figsize=(7.2, 3.8))
    plan, picture = figure.subplots(1, 2)
    _draw_plan(plan, room, reading, is_photo)
    step = max(1, image.shape[1] // 900)
    rows, columns = image.shape
    picture.imshow(
        image[::step, ::step], cmap="gray", vmin=0, vmax=255,
        extent=(-0.5, columns - 0.5, rows - 0.5, -0.5), interpolation="antialiased",
    )  # fmt: skip
    for read in reading.lamps:
        colour = colours.RIGHT if read.name else colours.WRONG
        column, row = read.hull.mean(axis=0).tolist()
        picture.text(
            column, row, read.name or "?", color="white", fontsize=6, ha="center", va="center",
            backgroundcolor=colour, parse_math=False,
        )  # fmt: skip
    picture.set_xlabel("column")
    picture.set_ylabel("row")
    return figure


def _draw_plan(ax: Axes, room: Room, reading: RoomReading, is_photo: bool) -> None:
    for lamp in room.lamps:
        outline = room_outline(lamp)[:, :2]
        ax.fill(outline[:, 0], outline[:, 1], facecolor="none", edgecolor=colours.SIMULATION)
        x, y = outline.mean(axis=0).tolist()
        ax.text(x, y, lamp.name, fontsize=6, ha="center", va="center", parse_math=False)
    height = float(np.mean([lamp.z for lamp in room.lamps]))
    seen = seen_outline(room, height)
    if len(seen):
        ax.fill(seen[:, 0], seen[:, 1], fill=False, linestyle="--", edgecolor=colours.PHOTO)
    camera = room.camera
    if not is_photo:
        ax.plot(
            [camera.x], [camera.y], "o", color=colours.PHOTO, fillstyle="none", label="true place"
        )
    if reading.located is not None:
        found, errors = reading.located.place, reading.located.errors
        ax.errorbar(
            [found.x], [found.y], [2.0 * errors[1]], [2.0 * errors[0]], fmt="x",
            color=colours.BAND, label="found, two standard deviations",
        )  # fmt: skip
    ax.set_aspect("equal")
    ax.set_xlabel("x (m)")
    ax.set_ylabel("y (m)")
    ax.legend(fontsize=7)
