"""Localization: the camera's place and angles from the named lamps in its picture."""

from collections.abc import Sequence
from dataclasses import astuple, dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.projection import image_rays
from occ_model.effects.distortion import undistort
from occ_model.errors import ParameterError, counted
from occ_model.room.edge_lines import Edge
from occ_model.room.edges import find_edges
from occ_model.room.pose_fit import LampEdges, Located
from occ_model.room.reading import ReadLamp, check_picture, find_and_name
from occ_model.room.room import Room, RoomLamp
from occ_model.room.view import angles_of, room_outline, rotation

_MAX_DEVIATION_EXCESS = 9.0  # of chi-squared, within which another place explains the picture too
_MIN_EDGES = 4
"""Edges of lamps below which there is no place.

Each has two numbers; those of three are explained exactly by many places."""

_MAX_MEAN_SQUARE = 4.0  # in standard errors squared; above it a place does not explain the edges
_MAX_ANCHORS = 3  # maximum number of lamps whose corners are starting values
_MAX_EXCLUDED_EDGES = 3  # maximum edges left out, one after the other, where no place explains all
_ONE_LAMP = "Only one lamp determines the place: it can be farther off than the stated errors."

_LOOSE = (
    "The edges that were measured determine the place so loosely that it can be farther off than "
    "the stated errors."
)

_PLACE_TOLERANCE = 1e-3  # metres and radians within which two places are the same


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


def read_room(image: NDArray[Any], room: Room, focal_share: float = 0.0) -> RoomReading:
    """Name the lamps in a picture of a room, and find where it was taken.

    The receiver knows the room but for the camera's place and angles: the lamps, and the camera's
    settings and lens. The place follows from the straight edges of the named rectangles; discs are
    named only.

    Parameters
    ----------
    image : ndarray, shape (rows, columns)
        The camera's picture, of pixels as :func:`occ_model.decode` takes them.
    room
        The room; its camera's place is not used.
    focal_share
        Standard error of the room's focal length, as a fraction of it: the place's errors include
        it.

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
    lamps = find_and_name(picture, room)
    by_name = {lamp.name: lamp for lamp in room.lamps}
    measured = []
    for read in lamps:
        lamp = by_name.get(read.name or "")
        if lamp is None or lamp.shape != "rectangle":
            continue
        corners = quadrilateral(undistort(read.hull, room.scene))
        edges = find_edges(picture, room, lamp, corners)
        measured.append(_Measured(lamp, corners, edges, read.is_cut))
    whole = [(by_name[one.name], one) for one in lamps if one.name and not one.is_cut]
    found, why = _located(measured, room, len(lamps), _start_of_centres(whole, room), focal_share)
    return RoomReading(lamps, found[0] if found else None, tuple(found[1:]), why)


def quadrilateral(hull: FloatArray) -> FloatArray:
    """Return the quadrilateral round a convex outline, corners in the sense of a lamp's own."""
    found = cv2.approxPolyN(hull.astype(np.float32).reshape(-1, 1, 2), 4)
    corners = np.asarray(found, dtype=np.float64).reshape(4, 2)
    x, y = corners.T
    area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
    return corners if area > 0.0 else corners[::-1].copy()


@dataclass(frozen=True, eq=False, slots=True)
class _Measured:
    lamp: RoomLamp
    corners: FloatArray
    edges: list[Edge]
    is_cut: bool


def _located(
    measured: Sequence[_Measured],
    room: Room,
    found: int,
    more: Sequence[FloatArray],
    focal_share: float = 0.0,
) -> tuple[list[Located], tuple[str, ...]]:
    if not measured:
        what = "No lamp was found" if not found else "No rectangular lamp was named"
        return [], (f"{what}: nothing determines the place.",)
    whole = [one for one in measured if not one.is_cut]
    if not whole:
        return [], ("Every named lamp is cut by the picture's edge; one has to be whole.",)
    edges = sum(len(one.edges) for one in measured)
    if edges < _MIN_EDGES:
        return [], (
            f"Of named lamps only {counted(edges, 'edge')} can be measured, the others being too "
            f"faint; allowed: from {_MIN_EDGES}.",
        )
    table = LampEdges.of([(one.lamp, one.edges) for one in measured], room, focal_share)
    starts = [start for anchor in whole[:_MAX_ANCHORS] for start in _starts(anchor, room)]
    tried = _explanations(table, [*more, *starts])
    if not tried:
        return [], (
            "No place of the camera follows from the edges of the named lamps: those that are "
            "bright are all parallel, or they are not where the room's lamps are, or the picture "
            "is mirrored.",
        )
    tried.sort(key=lambda one: one.deviations)
    best = tried[0]
    limit = best.deviations + _MAX_DEVIATION_EXCESS * max(
        1.0, best.deviations / max(best.freedom, 1)
    )
    kept: list[Located] = []
    for one in tried:
        if one.deviations <= limit and not any(_is_same(one, other) for other in kept):
            kept.append(one)
    if len(kept) == 1:
        why = (_ONE_LAMP,) if len(measured) == 1 else ()
        return kept, why if kept[0].is_linear else (*why, _LOOSE)
    return kept, (
        f"{len(kept)} places explain the picture alike: a panel looks the same when it is turned, "
        "and a small one when it is tilted the other way. More lamps would resolve it.",
    )


def _explanations(edges: LampEdges, starts: Sequence[FloatArray]) -> list[Located]:
    """Return the places that explain the edges, or all but a few of them."""
    for _ in range(_MAX_EXCLUDED_EDGES + 1):
        tried = [fitted for start in starts if (fitted := edges.fitted(start)) is not None]
        fits = [one for one, _ in tried if one.deviations <= _MAX_MEAN_SQUARE * (one.freedom + 4)]
        if fits or not tried:
            return fits
        _, off = min(tried, key=lambda each: each[0].deviations)
        if len(off) < _MIN_EDGES + 2:
            return []
        edges = edges.without(int(np.argmax(off)))
    return []


def _is_same(one: Located, other: Located) -> bool:
    apart = np.array(astuple(one.place)) - np.array(astuple(other.place))
    apart[3:] = np.angle(np.exp(1j * apart[3:]))
    return bool(np.abs(apart).max() < _PLACE_TOLERANCE)


def _start_of_centres(whole: Sequence[tuple[RoomLamp, ReadLamp]], room: Room) -> list[FloatArray]:
    """Return a place that explains the centres of four lamps or more, discs among them."""
    if len(whole) < 4:
        return []
    centres = np.array([[lamp.x, lamp.y, lamp.z] for lamp, _ in whole])
    seen = np.array([(read.hull.min(axis=0) + read.hull.max(axis=0)) / 2.0 for _, read in whole])
    rays = image_rays(undistort(seen, room.scene), room.scene.camera)
    found, vector, move = cv2.solvePnP(
        centres[:, None, :], rays[:, None, :], np.eye(3), None, flags=cv2.SOLVEPNP_SQPNP
    )
    if not found:
        return []
    camera = np.asarray(cv2.Rodrigues(vector)[0], dtype=np.float64).T
    place = -camera @ np.asarray(move, dtype=np.float64).ravel()
    return [np.concatenate([place, angles_of(camera)])]


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
