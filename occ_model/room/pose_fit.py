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
_MIN_DEPTH = 1e-6  # minimum depth in metres at which a corner is visible
_DIFFERENCE = 1e-6  # step of each coordinate for numerical derivatives, in metres or radians
_CHECKED_ERRORS = 2.0  # distance from the place at which linearity is checked, in standard errors
_MAX_GROWTH = 2.0  # maximum ratio there of the deviations to the prediction, or the inverse
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
        Number of measured values minus number of fitted values.
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
class OutlineEdges:
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
        edges = [edge for _, lamp_edges in measured for edge in lamp_edges]
        return cls(
            np.array([room_outline(lamp) for lamp, _ in measured]),
            np.repeat(np.arange(len(measured)), [len(lamp_edges) for _, lamp_edges in measured]),
            np.array([edge.points for edge in edges]).reshape(-1, 2, 2),
            np.array([np.linalg.inv(np.linalg.cholesky(edge.covariance)) for edge in edges]),
            room.scene.camera,
            focal_share,
        )

    def omit_edge(self, edge: int) -> "OutlineEdges":
        others = np.arange(len(self.lamp)) != edge
        return replace(
            self,
            lamp=self.lamp[others],
            points=self.points[others],
            whitening=self.whitening[others],
        )

    def fit(self, start: FloatArray) -> tuple[Located, FloatArray] | None:
        """Refine a place; return it with the edges' squared deviations, or None on failure."""
        numbers = np.append(start, 0.0) if self.focal_share else start
        inverse = np.eye(len(numbers))
        for _ in range(_ROUNDS):
            sides = self._sides(numbers)
            if sides is None:
                return None
            trials = numbers + np.vstack(
                [np.zeros_like(numbers), _DIFFERENCE * np.eye(len(numbers))]
            )
            deviations = self._deviations(trials, sides)
            if deviations is None:
                return None
            slope = (deviations[1:] - deviations[0]).T / _DIFFERENCE
            normal = slope.T @ slope
            if not np.isfinite(normal).all() or np.linalg.cond(normal) > _MAX_CONDITION_NUMBER:
                return None
            inverse = np.linalg.inv(normal)
            change = -inverse @ (slope.T @ deviations[0])
            length = float(np.abs(change).max())
            numbers = numbers + change * min(1.0, 0.5 / max(length, 1e-12))
            if length < 1e-7:
                break
        sides = self._sides(numbers)
        deviations = None if sides is None else self._deviations(numbers[None], sides)
        place = None if deviations is None else _make_place(numbers)
        if sides is None or deviations is None or place is None:
            return None
        final = deviations[0]
        total, freedom = float(final @ final), len(final) - len(numbers)
        scale = max(1.0, total / freedom) if freedom > 0 else 1.0
        covariance = inverse * scale
        focal, error = self.camera.equivalent_focal_length, 0.0
        if self.focal_share:
            error = focal * math.sqrt(covariance[6, 6])
            focal *= 1.0 + float(numbers[6])
        is_linear = self._is_linear(numbers, sides, inverse, total)
        located = Located(place, covariance[:6, :6], total, freedom, focal, error, is_linear)
        return located, (final[: 2 * len(self.lamp)] ** 2).reshape(-1, 2).sum(axis=1)

    def _is_linear(
        self, numbers: FloatArray, sides: IndexArray, inverse: FloatArray, least: float
    ) -> bool:
        """Return whether deviations grow as predicted within a few errors in all directions."""
        sizes, axes = np.linalg.eigh(inverse)
        steps = _CHECKED_ERRORS * np.sqrt(np.maximum(sizes, 0.0))[:, None] * axes.T
        deviations = self._deviations(numbers + np.vstack([steps, -steps]), sides)
        if deviations is None:
            return False
        growth = (np.square(deviations).sum(axis=1) - least) / _CHECKED_ERRORS**2
        return bool(growth.min() > 1.0 / _MAX_GROWTH and growth.max() < _MAX_GROWTH)

    def _outlines_at(self, numbers: FloatArray) -> FloatArray | None:
        """Return corners in the picture, shape (places, lamps, 4, 2); None if behind the camera."""
        relative = self.outlines[None] - numbers[:, None, None, :3]
        relative = np.einsum("plci,pij->plcj", relative, rotations(*numbers[:, 3:6].T))
        depth = relative[..., 2:]
        if not depth.min() > _MIN_DEPTH:
            return None
        rays = relative[..., :2] / depth
        if numbers.shape[1] > 6:
            rays = rays * (1.0 + numbers[:, 6, None, None, None])
        return image_points(rays, self.camera)

    def _sides(self, numbers: FloatArray) -> IndexArray | None:
        """Return which side of its lamp each edge is, from a place; None if behind the camera.

        It is the nearest of the sides that run in the same direction as the edge.
        """
        outlines = self._outlines_at(numbers[None])
        if outlines is None:
            return None
        edge_outlines = outlines[0][self.lamp]
        distances = np.abs(_distances(edge_outlines, self.points)).max(axis=-1)
        alignment = np.einsum(
            "esk,ek->es",
            np.roll(edge_outlines, -1, axis=-2) - edge_outlines,
            self.points[:, 1] - self.points[:, 0],
        )
        return np.asarray(np.argmin(np.where(alignment > 0.0, distances, np.inf), axis=-1))

    def _deviations(self, numbers: FloatArray, sides: IndexArray) -> FloatArray | None:
        """Return the deviations of edges, and of the focal length, in standard errors."""
        outlines = self._outlines_at(numbers)
        if outlines is None:
            return None
        distances = _distances(outlines[:, self.lamp], self.points)
        side_distances = distances[:, np.arange(len(sides)), sides]
        whitened = np.einsum("eij,pej->pei", self.whitening, side_distances).reshape(
            len(numbers), -1
        )
        if not self.focal_share:
            return np.asarray(whitened)
        return np.column_stack([whitened, numbers[:, 6] / self.focal_share])


def _distances(outlines: FloatArray, points: FloatArray) -> FloatArray:
    """Return the signed distances of both points of each edge from the sides of an outline."""
    directions = np.roll(outlines, -1, axis=-2) - outlines
    directions = directions / np.hypot(directions[..., 0], directions[..., 1])[..., None]
    relative = points[:, None] - outlines[..., None, :]
    return np.asarray(
        relative[..., 1] * directions[..., None, 0] - relative[..., 0] * directions[..., None, 1]
    )


def _make_place(numbers: FloatArray) -> Place | None:
    if not np.isfinite(numbers).all():
        return None
    yaw, pitch, roll = angles_of(rotations(*numbers[3:6]))
    x, y, z = numbers[:3].tolist()
    try:
        return Place(x=x, y=y, z=z, yaw=yaw, pitch=pitch, roll=roll)
    except ValueError:  # out of the range of a room's camera
        return None
