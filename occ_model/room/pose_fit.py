"""Fit a camera's place to the edges of lamps by least squares, with Gauss-Newton steps."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.projection import image_points, rotations
from occ_model.room.edge_lines import Edge
from occ_model.room.room import Place, Room, RoomLamp
from occ_model.room.view import angles_of, room_outline
from occ_model.scene.scene import Camera

_ROUNDS = 12  # maximum number of steps; refinement ends earlier once a step is negligible
_MIN_DEPTH = 1e-6  # minimum depth in metres at which a corner is seen
_DIFFERENCE = 1e-6  # step of each coordinate for numerical derivatives, in metres or radians
_CHECKED_ERRORS = 2.0  # distance from the place at which errors are checked, in errors
_MAX_GROWTH = 2.0  # of the deviations there relative to the prediction, and its inverse
_MAX_CONDITION_NUMBER = 1e14  # above this some parameters are undetermined


@dataclass(frozen=True, eq=False, slots=True)
class Located:
    """A place of the camera that explains a picture.

    Parameters
    ----------
    covariance : ndarray of float64, shape (6, 6)
        Covariance of x, y, z, yaw, pitch and roll, in metres and radians.
    deviations
        Sum of the squared deviations of the lamps' edges, in standard errors.
    freedom
        Number of measured values minus that of fitted ones.
    focal_length, focal_error
        The equivalent focal length that explains the picture, in metres, and its standard error; 0
        if it was known.
    """

    place: Place
    covariance: FloatArray
    deviations: float
    freedom: int
    focal_length: float = 0.0
    focal_error: float = 0.0
    is_linear: bool = True

    @property
    def errors(self) -> FloatArray:
        """Standard errors of x, y, z, yaw, pitch and roll, shape (6,)."""
        return np.sqrt(np.diag(self.covariance))


@dataclass(frozen=True, eq=False, slots=True)
class LampEdges:
    """The edges of some lamps in a picture, as arrays.

    A place is given by the six numbers of :class:`occ_model.Place`, and by a seventh if the focal
    length is not known exactly: its relative excess over the assumed one.
    """

    outlines: FloatArray  # Shape (lamps, 4, 3): the lamps' corners in the room
    lamp: IndexArray  # Shape (edges,): the lamp of each edge
    points: FloatArray  # Shape (edges, 2, 2): two points of each edge
    # Shape (edges, 2, 2): matrix that turns both points' deviations into independent standard
    # errors
    whitening: FloatArray
    camera: Camera
    focal_share: float  # Standard error of the focal length, as a fraction of it

    @classmethod
    def of(
        cls, measured: Sequence[tuple[RoomLamp, Sequence[Edge]]], room: Room, focal_share: float
    ) -> Self:
        edges = [edge for _, own in measured for edge in own]
        return cls(
            np.array([room_outline(lamp) for lamp, _ in measured]),
            np.repeat(np.arange(len(measured)), [len(own) for _, own in measured]),
            np.array([edge.points for edge in edges]).reshape(-1, 2, 2),
            np.array([np.linalg.inv(np.linalg.cholesky(edge.covariance)) for edge in edges]),
            room.scene.camera,
            focal_share,
        )

    def omit_edge(self, edge: int) -> "LampEdges":
        kept = np.arange(len(self.lamp)) != edge
        return replace(
            self, lamp=self.lamp[kept], points=self.points[kept], whitening=self.whitening[kept]
        )

    def fit(self, start: FloatArray) -> tuple[Located, FloatArray] | None:
        """Refine a place; return it with the edges' squared deviations, or None if it fails."""
        numbers = np.append(start, 0.0) if self.focal_share else start
        inverse = np.eye(len(numbers))
        for _ in range(_ROUNDS):
            sides = self._sides(numbers)
            if sides is None:
                return None
            moved = numbers + np.vstack(
                [np.zeros_like(numbers), _DIFFERENCE * np.eye(len(numbers))]
            )
            found = self._deviations(moved, sides)
            if found is None:
                return None
            slope = (found[1:] - found[0]).T / _DIFFERENCE
            normal = slope.T @ slope
            if not np.isfinite(normal).all() or np.linalg.cond(normal) > _MAX_CONDITION_NUMBER:
                return None
            inverse = np.linalg.inv(normal)
            change = -inverse @ (slope.T @ found[0])
            length = float(np.abs(change).max())
            numbers = numbers + change * min(1.0, 0.5 / max(length, 1e-12))
            if length < 1e-7:
                break
        sides = self._sides(numbers)
        found = None if sides is None else self._deviations(numbers[None], sides)
        place = None if found is None else _make_place(numbers)
        if sides is None or found is None or place is None:
            return None
        off = found[0]
        total, freedom = float(off @ off), len(off) - len(numbers)
        wider = max(1.0, total / freedom) if freedom > 0 else 1.0
        covariance = inverse * wider
        focal, error = self.camera.equivalent_focal_length, 0.0
        if self.focal_share:
            error = focal * math.sqrt(covariance[6, 6])
            focal *= 1.0 + float(numbers[6])
        is_linear = self._is_linear(numbers, sides, inverse, total)
        located = Located(place, covariance[:6, :6], total, freedom, focal, error, is_linear)
        return located, (off[: 2 * len(self.lamp)] ** 2).reshape(-1, 2).sum(axis=1)

    def _is_linear(
        self, numbers: FloatArray, sides: IndexArray, inverse: FloatArray, least: float
    ) -> bool:
        """Return whether deviations grow as predicted up to a few errors in all directions."""
        sizes, axes = np.linalg.eigh(inverse)
        steps = _CHECKED_ERRORS * np.sqrt(np.maximum(sizes, 0.0))[:, None] * axes.T
        found = self._deviations(numbers + np.vstack([steps, -steps]), sides)
        if found is None:
            return False
        growth = (np.square(found).sum(axis=1) - least) / _CHECKED_ERRORS**2
        return bool(growth.min() > 1.0 / _MAX_GROWTH and growth.max() < _MAX_GROWTH)

    def _outlines_at(self, numbers: FloatArray) -> FloatArray | None:
        """Return corners in the picture, shape (places, lamps, 4, 2); None if behind the camera."""
        placed = self.outlines[None] - numbers[:, None, None, :3]
        placed = np.einsum("plci,pij->plcj", placed, rotations(*numbers[:, 3:6].T))
        depth = placed[..., 2:]
        if not depth.min() > _MIN_DEPTH:
            return None
        rays = placed[..., :2] / depth
        if numbers.shape[1] > 6:
            rays = rays * (1.0 + numbers[:, 6, None, None, None])
        return image_points(rays, self.camera)

    def _sides(self, numbers: FloatArray) -> IndexArray | None:
        """Return which side of its lamp each edge is, seen from a place; None if none is in view.

        It is the nearest of the sides that have the lamp on the same side as the edge.
        """
        outlines = self._outlines_at(numbers[None])
        if outlines is None:
            return None
        own = outlines[0][self.lamp]
        off = np.abs(_distances(own, self.points)).max(axis=-1)
        along = np.einsum(
            "esk,ek->es", np.roll(own, -1, axis=-2) - own, self.points[:, 1] - self.points[:, 0]
        )
        return np.asarray(np.argmin(np.where(along > 0.0, off, np.inf), axis=-1))

    def _deviations(self, numbers: FloatArray, sides: IndexArray) -> FloatArray | None:
        """Return the deviations of edges, and of the focal length, in standard errors."""
        outlines = self._outlines_at(numbers)
        if outlines is None:
            return None
        off = _distances(outlines[:, self.lamp], self.points)
        own = off[:, np.arange(len(sides)), sides]
        whitened = np.einsum("eij,pej->pei", self.whitening, own).reshape(len(numbers), -1)
        if not self.focal_share:
            return np.asarray(whitened)
        return np.column_stack([whitened, numbers[:, 6] / self.focal_share])


def _distances(outlines: FloatArray, points: FloatArray) -> FloatArray:
    """Return how far both points of each edge are to the left of an outline's sides."""
    along = np.roll(outlines, -1, axis=-2) - outlines
    along = along / np.hypot(along[..., 0], along[..., 1])[..., None]
    apart = points[:, None] - outlines[..., None, :]
    return np.asarray(apart[..., 1] * along[..., None, 0] - apart[..., 0] * along[..., None, 1])


def _make_place(numbers: FloatArray) -> Place | None:
    if not np.isfinite(numbers).all():
        return None
    yaw, pitch, roll = angles_of(rotations(*numbers[3:6]))
    x, y, z = numbers[:3].tolist()
    try:
        return Place(x=x, y=y, z=z, yaw=yaw, pitch=pitch, roll=roll)
    except ValueError:  # out of the range of a room's camera
        return None
