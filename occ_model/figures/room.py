"""Draw a room for print: its plan, and the camera's picture with the lamps' names."""

from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from occ_model import colours
from occ_model.arrays import ByteArray
from occ_model.figures.drawing import Drawing
from occ_model.figures.window_panes import show_picture
from occ_model.room.locate import RoomReading
from occ_model.room.room import Place, Room
from occ_model.room.view import room_outline, seen_outline
from occ_model.scene.provenance import Provenance

_TITLE = "Room, its picture and the place found"
_EDGE = 0.07  # half the size of a name, as a fraction of the picture's side
_PADDING = 5  # points between a name and the edge of its box, and of the picture
_MAX_SPACED_LAMPS = 40  # number of lamps in a plan up to which their names have the usual size
_NUMBERS = tuple(Place.__dataclass_fields__)


def room_drawing(
    room: Room, image: ByteArray, reading: RoomReading, *, is_photo: bool = False
) -> Drawing:
    """Draw a room and what was read from its picture, or from a photo of an unknown place."""

    def rows() -> Iterable[tuple[object, ...]]:
        located = reading.located
        errors = [None] * 6 if located is None else located.errors.tolist()
        for name, error in zip(_NUMBERS, errors, strict=True):
            value = None if located is None else getattr(located.place, name)
            true_value = None if is_photo else getattr(room.camera, name)
            yield name, true_value, value, error, None, None
        for lamp in reading.lamps:
            column, row = lamp.hull.mean(axis=0).tolist()
            yield lamp.name or "unnamed", None, None, None, column, row

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
    show_picture(picture, image)
    for lamp in reading.lamps:
        colour = colours.RIGHT if lamp.name else colours.WRONG
        _write_name(picture, lamp.name or "?", lamp.hull.mean(axis=0).tolist(), image.shape, colour)
    if reading.located is None and reading.reasons:
        picture.set_title(f"No place found: {reading.reasons[0]}", fontsize=7, parse_math=False)
    figure.legend(loc="outside upper left", ncols=4, frameon=False, fontsize=7)
    return figure


def _write_name(
    ax: Axes, name: str, middle: Sequence[float], shape: tuple[int, ...], colour: str
) -> None:
    """Write a lamp's name at its middle, or beside the picture's edge if that is near."""
    rows, columns = shape
    (column, across), (row, down) = (
        _place_from_edge(middle[0], columns - 1), _place_from_edge(middle[1], rows - 1)
    )  # fmt: skip
    ax.annotate(
        name, (column, row), (_PADDING * across, -_PADDING * down), textcoords="offset points",
        color="white", fontsize=6, backgroundcolor=colour, parse_math=False,
        ha=("center", "left", "right")[across], va=("center", "top", "bottom")[down],
    )  # fmt: skip


def _place_from_edge(place: float, last: int) -> tuple[float, int]:
    """Return a name's place, and 1 if it starts at the first edge, -1 if it ends at the last."""
    if place < _EDGE * last:
        return 0.0, 1
    if place > (1.0 - _EDGE) * last:
        return float(last), -1
    return place, 0


def _draw_plan(ax: Axes, room: Room, reading: RoomReading, is_photo: bool) -> None:
    size = 6 if len(room.lamps) <= _MAX_SPACED_LAMPS else 5
    for number, lamp in enumerate(room.lamps):
        outline = room_outline(lamp)[:, :2]
        ax.fill(
            outline[:, 0], outline[:, 1], facecolor="none", edgecolor=colours.SIMULATION,
            label="" if number else "lamp",
        )  # fmt: skip
        right_edge = (outline[:, 0].max(), outline[:, 1].mean())
        ax.annotate(
            lamp.name, right_edge, (1, 0), textcoords="offset points", fontsize=size, va="center",
            parse_math=False,
        )  # fmt: skip
    height = float(np.mean([lamp.z for lamp in room.lamps]))
    visible = seen_outline(room, height)
    if len(visible) and not is_photo:
        ax.fill(
            visible[:, 0], visible[:, 1], fill=False, linestyle="--", edgecolor=colours.PHOTO,
            label="in view",
        )  # fmt: skip
    camera = room.camera
    if not is_photo:
        ax.plot(
            [camera.x], [camera.y], "o", color=colours.PHOTO, fillstyle="none", label="true place"
        )
    if reading.located is not None:
        place, errors = reading.located.place, reading.located.errors
        ax.errorbar(
            [place.x], [place.y], [2.0 * errors[1]], [2.0 * errors[0]], fmt="x",
            color=colours.BAND, label="found, two standard deviations",
        )  # fmt: skip
    # A corridor's plan becomes wider than its lamps, as the axis's numbers need the space.
    ax.set_aspect("equal", adjustable="datalim")
    ax.set(xlabel="x (m)", ylabel="y (m)")
