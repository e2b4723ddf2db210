"""Find a camera's place and angles from the identified lamps in its picture or photo."""

from collections.abc import Sequence
from dataclasses import astuple, dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.projection import image_rays
from occ_model.effects.distortion import undistort
from occ_model.errors import ParameterError, inflect
from occ_model.room.edge_lines import Edge
from occ_model.room.edges import find_edges
from occ_model.room.pose_fit import Located, OutlineEdges
from occ_model.room.reading import ReadLamp, check_picture, read_lamps
from occ_model.room.room import Room, RoomLamp
from occ_model.room.view import angles_of, room_outline, rotation

_MAX_DEVIATION_EXCESS = 9.0  # of chi-squared, up to which another place fits equally well
_MIN_EDGES = 4
"""Minimum number of edges: each gives two numbers, and many places explain three edges."""

_MAX_MEAN_SQUARE = 4.0  # in squared standard errors, up to which a place explains the edges
_MAX_ANCHORS = 3  # maximum number of lamps whose corners give starting values
_MAX_EXCLUDED_EDGES = 3  # maximum number of edges omitted one by one if no place explains all
_ONE_LAMP = "Only one lamp determines the place, so its error may exceed the stated errors."

_POOR_FIT = (
    "The measured edges determine the place so poorly that its error may exceed the stated errors."
)

_PLACE_TOLERANCE = 1e-3  # metres and radians up to which two places are the same


@dataclass(frozen=True, eq=False, slots=True)
class RoomReading:
    """The lamps and the place found in a picture of a room.

    Parameters
    ----------
    lamps
        The lamps that were found, the largest first.
    located
        The place of the camera that explains the picture best; None if there is none.
    alternatives
        Other places that explain the picture as well.
    reasons
        Sentences on why there is no place, more than one, or an uncertain one.
    """

    lamps: tuple[ReadLamp, ...]
    located: Located | None
    alternatives: tuple[Located, ...]
    reasons: tuple[str, ...]

    @property
    def is_sure(self) -> bool:
        """Whether there is exactly one place, and no doubt about it."""
        return self.located is not None and not self.reasons


def read_room(image: NDArray[Any], room: Room, focal_share: float = 0.0) -> RoomReading:
    """Name the lamps in a picture of a room, and find where it was taken.

    The receiver knows the room except for the camera's place and angles: the lamps, and the
    camera's settings and lens. Lamps are named by their codes, or by the measured frequency of
    light without a code. The place follows from the straight edges of the named rectangles; discs
    are only named.

    Parameters
    ----------
    image : ndarray, shape (rows, columns)
        The camera's picture, with pixels as for :func:`occ_model.decode`.
    room
        The room; its camera's place is not used.
    focal_share
        Standard error of the room's focal length, as a fraction of it; the errors of the place
        include it.

    Raises
    ------
    DecodeInputError
        The array is not a picture of the room's camera.
    ParameterError
        The fraction is not from 0 to below 1.
    """
    if not 0.0 <= focal_share < 1.0:
        raise ParameterError.of("focal_share", f"{focal_share:g}", "from 0 to below 1")
    picture = check_picture(image, room)
    lamps = read_lamps(picture, room)
    by_name = {lamp.name: lamp for lamp in room.lamps}
    measured = []
    for read_lamp in lamps:
        lamp = by_name.get(read_lamp.name or "")
        if lamp is None or lamp.shape != "rectangle":
            continue
        corners = fit_quadrilateral(undistort(read_lamp.hull, room.scene))
        edges = find_edges(picture, room, lamp, corners)
        measured.append(_MeasuredLamp(lamp, corners, edges, read_lamp.is_cut))
    complete_lamps = [
        (by_name[read_lamp.name], read_lamp)
        for read_lamp in lamps
        if read_lamp.name and not read_lamp.is_cut
    ]
    places, reasons = _locate(
        measured, room, len(lamps), _start_of_centres(complete_lamps, room), focal_share
    )
    return RoomReading(lamps, places[0] if places else None, tuple(places[1:]), reasons)


def fit_quadrilateral(hull: FloatArray) -> FloatArray:
    """Return the quadrilateral around a convex outline, its corners in the order of a lamp's."""
    quadrilateral = cv2.approxPolyN(hull.astype(np.float32).reshape(-1, 1, 2), 4)
    corners = np.asarray(quadrilateral, dtype=np.float64).reshape(4, 2)
    x, y = corners.T
    area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
    return corners if area > 0.0 else corners[::-1].copy()


@dataclass(frozen=True, eq=False, slots=True)
class _MeasuredLamp:
    lamp: RoomLamp
    corners: FloatArray
    edges: list[Edge]
    is_cut: bool


def _locate(
    measured: Sequence[_MeasuredLamp],
    room: Room,
    lamp_count: int,
    extra_starts: Sequence[FloatArray],
    focal_share: float = 0.0,
) -> tuple[list[Located], tuple[str, ...]]:
    if not measured:
        problem = "No lamp was found" if not lamp_count else "No rectangular lamp was named"
        return [], (f"{problem}: nothing determines the place.",)
    complete = [each for each in measured if not each.is_cut]
    if not complete:
        return [], ("Every named lamp is cut by the picture's edge; at least one must be whole.",)
    edges = sum(len(each.edges) for each in measured)
    if edges < _MIN_EDGES:
        return [], (
            f"Only {inflect(edges, 'edge')} of the named lamps can be measured, because the others "
            f"are too faint; at least {_MIN_EDGES} are needed.",
        )
    table = OutlineEdges.of([(each.lamp, each.edges) for each in measured], room, focal_share)
    starts = [start for anchor in complete[:_MAX_ANCHORS] for start in _starts(anchor, room)]
    places = find_places(table, [*extra_starts, *starts])
    if not places:
        return [], (
            "No place of the camera explains the edges of the named lamps: the bright edges are "
            "all parallel, the lamps are not where the room states, or the picture is mirrored.",
        )
    return select_places(places, len(measured))


def select_places(places: list[Located], lamps: int) -> tuple[list[Located], tuple[str, ...]]:
    """Return the distinct places that explain a picture best, and why they are not sure.

    ``lamps``: the number of lamps whose edges gave the places, of which there is at least one.
    """
    places = sorted(places, key=lambda place: place.deviations)
    best = places[0]
    scale = max(1.0, best.deviations / max(best.freedom, 1))
    limit = best.deviations + _MAX_DEVIATION_EXCESS * scale
    distinct: list[Located] = []
    for place in places:
        is_known = any(_is_same(place, other) for other in distinct)
        if place.deviations <= limit and not is_known:
            distinct.append(place)
    if len(distinct) == 1:
        reasons = (_ONE_LAMP,) if lamps == 1 else ()
        return distinct, reasons if distinct[0].is_linear else (*reasons, _POOR_FIT)
    return distinct, (
        f"{len(distinct)} places explain the picture equally well: a panel looks the same when it "
        "is turned, and a small one when it is tilted the other way. More lamps would decide.",
    )


def find_places(edges: OutlineEdges, starts: Sequence[FloatArray]) -> list[Located]:
    """Return the places that explain all edges, or all except a few."""
    for _ in range(_MAX_EXCLUDED_EDGES + 1):
        fits = [fit for start in starts if (fit := edges.fit(start)) is not None]
        good = [one for one, _ in fits if one.deviations <= _MAX_MEAN_SQUARE * (one.freedom + 4)]
        if good or not fits:
            return good
        _, squared_deviations = min(fits, key=lambda fit: fit[0].deviations)
        if len(squared_deviations) < _MIN_EDGES + 2:
            return []
        edges = edges.omit_edge(int(np.argmax(squared_deviations)))
    return []


def _is_same(one: Located, other: Located) -> bool:
    difference = np.array(astuple(one.place)) - np.array(astuple(other.place))
    difference[3:] = np.angle(np.exp(1j * difference[3:]))
    return bool(np.abs(difference).max() < _PLACE_TOLERANCE)


def _start_of_centres(
    named_lamps: Sequence[tuple[RoomLamp, ReadLamp]], room: Room
) -> list[FloatArray]:
    """Return a place that explains the centres of at least four lamps, including discs."""
    if len(named_lamps) < 4:
        return []
    centres = np.array([[lamp.x, lamp.y, lamp.z] for lamp, _ in named_lamps])
    image_centres = np.array(
        [
            (read_lamp.hull.min(axis=0) + read_lamp.hull.max(axis=0)) / 2.0
            for _, read_lamp in named_lamps
        ]
    )
    rays = image_rays(undistort(image_centres, room.scene), room.scene.camera)
    is_solved, vector, move = cv2.solvePnP(
        centres[:, None, :], rays[:, None, :], np.eye(3), None, flags=cv2.SOLVEPNP_SQPNP
    )
    if not is_solved:
        return []
    camera = np.asarray(cv2.Rodrigues(vector)[0], dtype=np.float64).T
    place = -camera @ np.asarray(move, dtype=np.float64).ravel()
    return [np.concatenate([place, angles_of(camera)])]


def _starts(anchor: _MeasuredLamp, room: Room) -> list[FloatArray]:
    """Return places, as six numbers each, that roughly explain the corners of one lamp."""
    rays = image_rays(anchor.corners, room.scene.camera)
    outline = room_outline(anchor.lamp)
    lamp_axes = rotation(anchor.lamp)
    middle = outline.mean(axis=0)
    starts = []
    for shift in range(4):
        order = np.roll(np.arange(4), -shift)
        local = (outline - middle) @ lamp_axes
        _, vectors, moves, _ = cv2.solvePnPGeneric(
            local[:, None, :], rays[order][:, None, :], np.eye(3), None, flags=cv2.SOLVEPNP_IPPE
        )
        for vector, move in zip(vectors, moves, strict=True):
            # From the lamp's own axes to the camera's.
            lamp_to_camera = np.asarray(cv2.Rodrigues(vector)[0], dtype=np.float64)
            camera = lamp_axes @ lamp_to_camera.T
            place = middle - camera @ np.asarray(move, dtype=np.float64).ravel()
            starts.append(np.concatenate([place, angles_of(camera)]))
    return starts
