"""Where am I: the camera's place and angles from the named lamps in its picture."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.projection import image_points, image_rays
from occ_model.room.edges import Edge, EdgeFinder, quadrilateral
from occ_model.room.reading import ReadLamp, check_picture, find_and_name
from occ_model.room.room import Place, Room, RoomLamp, check_room
from occ_model.room.view import angles_of, room_outline, rotation

_ROUNDS = 12
"""Rounds of the refinement; it ends sooner where a step is negligible."""

_AS_GOOD = 9.0
"""Sum of squared deviations within which another place explains the picture as well."""

_LEAST_EDGES = 4
"""Edges of lamps below which there is no place.

Each gives two numbers; what three give, many places explain exactly."""

_MOST_MEAN_SQUARE = 4.0
"""Mean squared deviation, in standard errors, above which a place does not explain the edges."""

_LEFT_OUT = 3
"""Edges that may be left out, one after the other, where no place explains all."""

_ONE_LAMP = "Only one lamp tells the place: it can be farther off than the stated errors."

_PLACE_TOLERANCE = 1e-3
"""Metres and radians within which two places are the same."""


@dataclass(frozen=True, eq=False, slots=True)
class Located:
    """A place of the camera that explains a picture.

    Parameters
    ----------
    covariance : ndarray of float64, shape (6, 6)
        Of x, y, z, yaw, pitch and roll, in metres and radians.
    deviations
        Sum of the squared deviations of the lamps' edges, in their standard errors.
    freedom
        How many numbers were measured beyond the six that were wanted.
    """

    place: Place
    covariance: FloatArray
    deviations: float
    freedom: int

    @property
    def errors(self) -> FloatArray:
        """Standard errors of x, y, z, yaw, pitch and roll, shape (6,)."""
        return np.sqrt(np.diag(self.covariance))


@dataclass(frozen=True, eq=False, slots=True)
class RoomReading:
    """What a picture says of its room.

    Parameters
    ----------
    lamps
        The lamps found, from the largest to the smallest.
    located
        The place of the camera that explains the picture best, None where ``reasons`` say why.
    alternatives
        Other places that explain it as well.
    reasons
        Why there is no place, more than one, or one that is not sure; sentences.
    """

    lamps: tuple[ReadLamp, ...]
    located: Located | None
    alternatives: tuple[Located, ...]
    reasons: tuple[str, ...]

    @property
    def is_sure(self) -> bool:
        """Whether there is one place, and nothing speaks against it."""
        return self.located is not None and not self.reasons


def read_room(image: NDArray[Any], room: Room) -> RoomReading:
    """Name the lamps in a picture of a room, and find where it was taken.

    The receiver knows the room but for the camera's place and angles: the lamps, and the camera's
    settings and lens. The place follows from the straight edges of the named rectangles; discs are
    named only.

    Parameters
    ----------
    image : ndarray of uint8, shape (rows, columns)
        The camera's picture.
    room
        The room; its camera's place is not used.

    Returns
    -------
    RoomReading

    Raises
    ------
    DecodeInputError
        The array is no picture of the room's camera.
    """
    check_room(room)
    picture = check_picture(image, room)
    lamps = find_and_name(picture, room)
    by_name = {lamp.name: lamp for lamp in room.lamps}
    finder = EdgeFinder(picture, room)
    measured = []
    for read in lamps:
        lamp = by_name.get(read.name or "")
        if lamp is None or lamp.shape != "rectangle":
            continue
        corners = quadrilateral(read.hull)
        edges = finder.edges(read, lamp, corners)
        measured.append(_Measured(lamp, corners, edges, read.is_cut))
    whole = [(by_name[one.name], one) for one in lamps if one.name and not one.is_cut]
    found, why = _located(measured, room, len(lamps), _start_of_centres(whole, room))
    return RoomReading(lamps, found[0] if found else None, tuple(found[1:]), why)


@dataclass(frozen=True, eq=False, slots=True)
class _Measured:
    """A named lamp, its rough corners and its edges in the picture."""

    lamp: RoomLamp
    corners: FloatArray
    edges: list[Edge]
    is_cut: bool


def _located(
    measured: Sequence[_Measured], room: Room, found: int, more: Sequence[FloatArray]
) -> tuple[list[Located], tuple[str, ...]]:
    if not measured:
        what = "No lamp was found" if not found else "No rectangular lamp was named"
        return [], (f"{what}: there is nothing to tell the place from.",)
    whole = [one for one in measured if not one.is_cut]
    if not whole:
        return [], ("Every named lamp is cut by the picture's edge; one has to be whole.",)
    edges = sum(len(one.edges) for one in measured)
    if edges < _LEAST_EDGES:
        return [], (
            f"Only {edges} edges of named lamps are bright enough to be measured; "
            f"allowed: from {_LEAST_EDGES}.",
        )
    tried = _explanations(measured, [*more, *_starts_of(whole, room)], room)
    if not tried:
        return [], (
            "No place of the camera follows from the edges of the named lamps: those that are "
            "bright are all parallel, or they are not where the room's lamps are.",
        )
    tried.sort(key=lambda one: one.deviations)
    best = tried[0]
    limit = best.deviations + _AS_GOOD * max(1.0, best.deviations / max(best.freedom, 1))
    kept: list[Located] = []
    for one in tried:
        if one.deviations <= limit and not any(_is_same(one, other) for other in kept):
            kept.append(one)
    if len(kept) == 1:
        return kept, (_ONE_LAMP,) if len(measured) == 1 else ()
    return kept, (
        f"{len(kept)} places explain the picture alike: a panel looks the same when it is turned, "
        "and a small one when it is tilted the other way. More lamps would tell.",
    )


def _explanations(
    measured: Sequence[_Measured], starts: Sequence[FloatArray], room: Room
) -> list[Located]:
    """Return the places that explain the edges, or all but a few of them."""
    for _ in range(_LEFT_OUT + 1):
        tried = [
            fitted for start in starts if (fitted := _refined(start, measured, room)) is not None
        ]
        fits = [one for one in tried if one.deviations <= _MOST_MEAN_SQUARE * (one.freedom + 4)]
        if fits or not tried:
            return fits
        best = min(tried, key=lambda one: one.deviations)
        measured = _without_worst(best, measured, room)
        if sum(len(one.edges) for one in measured) < _LEAST_EDGES + 1:
            return []
    return []


def _without_worst(
    located: Located, measured: Sequence[_Measured], room: Room
) -> Sequence[_Measured]:
    """Leave out the edge that is farthest from where a place puts it."""
    numbers = _numbers(located.place)
    assigned = _assigned(numbers, measured, room)
    off = None if assigned is None else _deviations(numbers, assigned, room)
    if assigned is None or off is None:
        return []
    worst = assigned[int(np.argmax((off**2).reshape(-1, 2).sum(axis=1)))][2]
    return [
        replace(one, edges=[edge for edge in one.edges if edge is not worst]) for one in measured
    ]


def _is_same(one: Located, other: Located) -> bool:
    return bool(np.abs(_numbers(one.place) - _numbers(other.place)).max() < _PLACE_TOLERANCE)


def _numbers(place: Place) -> FloatArray:
    return np.array([place.x, place.y, place.z, place.yaw, place.pitch, place.roll])


def _start_of_centres(whole: Sequence[tuple[RoomLamp, ReadLamp]], room: Room) -> list[FloatArray]:
    """Return a place that explains the centres of four lamps or more, discs among them."""
    if len(whole) < 4:
        return []
    centres = np.array([[lamp.x, lamp.y, lamp.z] for lamp, _ in whole])
    seen = np.array([(read.hull.min(axis=0) + read.hull.max(axis=0)) / 2.0 for _, read in whole])
    rays = image_rays(seen, room.scene.camera)
    found, vector, move = cv2.solvePnP(
        centres[:, None, :], rays[:, None, :], np.eye(3), None, flags=cv2.SOLVEPNP_SQPNP
    )
    if not found:
        return []
    camera = np.asarray(cv2.Rodrigues(vector)[0], dtype=np.float64).T
    place = -camera @ np.asarray(move, dtype=np.float64).ravel()
    return [np.concatenate([place, angles_of(camera)])]


def _starts_of(whole: Sequence[_Measured], room: Room) -> list[FloatArray]:
    return [start for anchor in whole[:3] for start in _starts(anchor, room)]


def _starts(anchor: _Measured, room: Room) -> list[FloatArray]:
    """Return places, six numbers each, that explain the corners of one lamp roughly."""
    rays = image_rays(anchor.corners, room.scene.camera)
    outline = room_outline(anchor.lamp)
    turned = rotation(anchor.lamp)
    middle = outline.mean(axis=0)
    starts = []
    for shift in range(4):
        order = np.roll(np.arange(4), -shift)
        local = (outline - middle) @ turned
        _, vectors, moves, _ = cv2.solvePnPGeneric(
            local[:, None, :], rays[order][:, None, :], np.eye(3), None, flags=cv2.SOLVEPNP_IPPE
        )
        for vector, move in zip(vectors, moves, strict=True):
            # From the lamp's own axes to the camera's.
            seen = np.asarray(cv2.Rodrigues(vector)[0], dtype=np.float64)
            camera = turned @ seen.T
            place = middle - camera @ np.asarray(move, dtype=np.float64).ravel()
            starts.append(np.concatenate([place, angles_of(camera)]))
    return starts


def _outline_at(numbers: FloatArray, lamp: RoomLamp, room: Room) -> FloatArray | None:
    """Return a lamp's corners in the picture from a place, None where it is behind the camera."""
    turned = rotation_at(numbers)
    placed = (room_outline(lamp) - numbers[:3]) @ turned
    if placed[:, 2].min() <= 1e-6:
        return None
    return image_points(placed[:, :2] / placed[:, 2:], room.scene.camera)


def rotation_at(numbers: FloatArray) -> FloatArray:
    """Return the camera's rotation from six numbers, whose angles may be any."""
    yaw, pitch, roll = numbers[3:].tolist()
    (sx, cx), (sy, cy), (sz, cz) = ((math.sin(a), math.cos(a)) for a in (pitch, yaw, roll))
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return np.asarray(about_z @ about_y @ about_x, dtype=np.float64)


def _assigned(
    numbers: FloatArray, measured: Sequence[_Measured], room: Room
) -> list[tuple[RoomLamp, int, Edge]] | None:
    """Say which side of which lamp each edge is, seen from a place."""
    assigned: list[tuple[RoomLamp, int, Edge]] = []
    for one in measured:
        expected = _outline_at(numbers, one.lamp, room)
        if expected is None:
            return None
        starts, ends = expected, np.roll(expected, -1, axis=0)
        along = (ends - starts) / np.hypot(*(ends - starts).T)[:, None]
        across = np.stack([-along[:, 1], along[:, 0]], axis=1)
        for edge in one.edges:
            off = np.abs(np.einsum("psk,sk->ps", edge.points[:, None, :] - starts, across))
            assigned.append((one.lamp, int(np.argmin(off.max(axis=0))), edge))
    return assigned


def _deviations(
    numbers: FloatArray, assigned: Sequence[tuple[RoomLamp, int, Edge]], room: Room
) -> FloatArray | None:
    """Return how far the edges' points are from the expected edges, in their errors."""
    outlines: dict[str, FloatArray] = {}
    off = []
    for lamp, side, edge in assigned:
        if lamp.name not in outlines:
            expected = _outline_at(numbers, lamp, room)
            if expected is None:
                return None
            outlines[lamp.name] = expected
        start, end = outlines[lamp.name][side], outlines[lamp.name][(side + 1) % 4]
        along = (end - start) / np.hypot(*(end - start))
        across = np.array([-along[1], along[0]])
        off += edge.whitened((edge.points - start) @ across).tolist()
    return np.array(off)


def _refined(start: FloatArray, measured: Sequence[_Measured], room: Room) -> Located | None:
    """Refine a place over the edges of all lamps, by Gauss and Newton's steps."""
    numbers = start
    steps = np.full(6, 1e-6)
    inverse = np.eye(6)
    for _ in range(_ROUNDS):
        assigned = _assigned(numbers, measured, room)
        off = None if assigned is None else _deviations(numbers, assigned, room)
        if assigned is None or off is None:
            return None
        slopes = []
        for axis, step in enumerate(steps):
            moved = numbers.copy()
            moved[axis] += step
            other = _deviations(moved, assigned, room)
            if other is None:
                return None
            slopes.append((other - off) / step)
        slope = np.array(slopes).T
        normal = slope.T @ slope
        if np.linalg.cond(normal) > 1e14:
            return None
        inverse = np.linalg.inv(normal)
        change = -inverse @ (slope.T @ off)
        length = float(np.abs(change).max())
        numbers = numbers + change * min(1.0, 0.5 / max(length, 1e-12))
        if length < 1e-7:
            break
    assigned = _assigned(numbers, measured, room)
    off = None if assigned is None else _deviations(numbers, assigned, room)
    if off is None or not np.isfinite(numbers).all():
        return None
    place = _place(numbers)
    freedom = len(off) - 6
    total = float(off @ off)
    wider = max(1.0, total / freedom) if freedom > 0 else 1.0
    return None if place is None else Located(place, inverse * wider, total, freedom)


def _place(numbers: FloatArray) -> Place | None:
    yaw, pitch, roll = angles_of(rotation_at(numbers))
    try:
        return replace(
            Place(), x=float(numbers[0]), y=float(numbers[1]), z=float(numbers[2]),
            yaw=yaw, pitch=pitch, roll=roll,
        )  # fmt: skip
    except ValueError:  # beyond what a room's camera can be at
        return None
