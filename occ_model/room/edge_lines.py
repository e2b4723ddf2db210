"""Fit a line to the measured points of a straight edge as a lens pictures it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.camera.projection import image_points, image_rays
from occ_model.effects.distortion import distort
from occ_model.scene.scene import Scene

_EXCLUDED_END_FRACTION = 0.06  # fraction of an edge's length that is omitted at each end
MIN_POINTS = 16  # minimum number of points to fit a line
_MAX_DEVIATIONS = 3.5  # standard deviations beyond which a point is excluded from a line
_MIN_VARIANCE = 1e-8  # of a line's end in square pixels, as points may lie exactly on a line
_MAX_SCATTER = 2.0  # scatter in pixels beyond which points do not belong to one edge
_PHASES = 16  # positions of an edge on the pixel grid over which its error is averaged

BLOCK = 8  # points with correlated errors, due to the blocks of a JPEG file or the lens's blur


@dataclass(frozen=True, eq=False, slots=True)
class Edge:
    """An edge of a lamp in a picture: its two ends in the order of the lamp's outline."""

    points: FloatArray  # Shape (2, 2): (column, row) of both ends, without the lens's distortion
    covariance: FloatArray  # Shape (2, 2): of both ends' shifts along the normal, in square pixels

    @property
    def normal(self) -> FloatArray:
        """The unit vector across the edge, towards the lamp, shape (2,)."""
        return find_normal(*self.points)


def find_normal(start: FloatArray, end: FloatArray) -> FloatArray:
    along = end - start
    return np.array([-along[1], along[0]]) / max(float(np.hypot(*along)), 1e-12)


@dataclass(frozen=True, eq=False, slots=True)
class Course:
    """The expected curve of a straight edge in the picture: a point in each column or row."""

    # Shape (2, 2): the edge's ends as a lens without distortion would show them
    ends: FloatArray
    axis: int  # 0: a nearly level edge with a point per column; 1: a point per row
    # Shape (points,): columns (or rows), and the edge's row (or column) in each
    places: IndexArray
    across: FloatArray
    # Shape (points, 2): movement of each point when an end moves by a pixel along the normal
    leverage: FloatArray
    steepness: FloatArray  # Shape (points,): length of the edge per pixel along its axis

    @classmethod
    def of(cls, ends: FloatArray, scene: Scene) -> Self:
        """Trace an edge between two ends."""
        start, end = ends
        count = max(3, math.ceil(float(np.hypot(*(end - start)))) + 1)
        fraction = np.linspace(0.0, 1.0, count)
        straight_points = start + fraction[:, None] * (end - start)
        line, shifted_line = (
            distort_points(line_points, scene)
            for line_points in (straight_points, straight_points + find_normal(start, end))
        )
        extent = line[-1] - line[0]
        axis = int(abs(extent[0]) < abs(extent[1]))
        if extent[axis] < 0.0:
            fraction, line, shifted_line = fraction[::-1], line[::-1], shifted_line[::-1]
        size = scene.camera.rows if axis else scene.camera.columns
        low, high = line[[0, -1], axis].tolist()
        places = np.arange(max(math.ceil(low), 0), min(math.floor(high), size - 1) + 1)
        if not (np.diff(line[:, axis]) > 0.0).all():  # the curve turns back
            return cls(ends, axis, places[:0], np.empty(0), np.empty((0, 2)), np.empty(0))
        across, shifted_across = (
            np.interp(places, line_points[:, axis], line_points[:, 1 - axis])
            for line_points in (line, shifted_line)
        )
        fraction_at = np.interp(places, line[:, axis], fraction)
        leverage = (shifted_across - across)[:, None] * np.stack(
            [1.0 - fraction_at, fraction_at], axis=1
        )
        run = np.interp(places, line[:, axis], np.gradient(line[:, axis]))
        rise = np.interp(places, line[:, axis], np.gradient(line[:, 1 - axis]))
        return cls(ends, axis, places, across, leverage, np.hypot(run, rise) / run)

    def cut_ends(self, min_pixels: int) -> Self:
        """Omit a fraction of the length at both ends, but at least ``min_pixels``."""
        count = max(math.ceil(_EXCLUDED_END_FRACTION * len(self.places)), min_pixels)
        return self.take(np.arange(len(self.places))[count : len(self.places) - count])

    def take(self, points: BoolArray | IndexArray | slice) -> Self:
        names = "places", "across", "leverage", "steepness"
        return replace(self, **{name: getattr(self, name)[points] for name in names})

    def move(self, shift: FloatArray) -> FloatArray:
        """Return the ends, each moved along the normal."""
        return np.asarray(self.ends + shift[:, None] * find_normal(*self.ends))


def distort_points(points: FloatArray, scene: Scene) -> FloatArray:
    """Return the distorted positions of points (column, row) of an undistorted picture."""
    if not scene.lens.distorts:
        return points
    return image_points(distort(image_rays(points, scene.camera), scene.lens), scene.camera)


@dataclass(frozen=True, eq=False, slots=True)
class Line:
    """The straight line through the measured points of an edge, by least squares."""

    course: Course
    offsets: FloatArray  # Shape (points,): measured distance of each from the course, in pixels
    # Shape (2, 2): covariance of both ends beyond that of the points' scatter
    extra_covariance: FloatArray = field(default_factory=lambda: np.zeros((2, 2)))

    @property
    def weights(self) -> FloatArray:
        """Weight of each point in the shifts of both ends, shape (2, points)."""
        return np.asarray(np.linalg.pinv(self.course.leverage))

    @property
    def shift(self) -> FloatArray:
        """Distances of both ends from the course's, along its normal, shape (2,)."""
        return np.asarray(self.weights @ self.offsets)

    @property
    def scatter(self) -> FloatArray:
        """Distances of the points from the line, across the axis."""
        return np.asarray(self.offsets - self.course.leverage @ self.shift)

    @property
    def variance(self) -> float:
        return float(self.scatter @ self.scatter) / (len(self.offsets) - 2)

    def sums_of_blocks(self) -> tuple[float, float]:
        """Return the squared sums of errors over blocks, and those expected if independent."""
        places, weights, scatter = self.course.places, self.weights, self.scatter
        block = (places - places.min()) // BLOCK
        lines, _ = np.linalg.qr(self.course.leverage)
        block_sum = independent_sum = 0.0
        for weight in weights / np.sqrt(np.square(weights).mean()):
            block_sum += float(np.square(np.bincount(block, scatter * weight)).sum())
            projections = [np.bincount(block, direction * weight) for direction in lines.T]
            independent_sum += float(weight @ weight - np.square(projections).sum()) * self.variance
        return block_sum, independent_sum

    def make_edge(self, variance_ratio: float) -> Edge:
        """Return the edge; ``variance_ratio``: see :func:`estimate_variance_ratio`."""
        noise = variance_ratio * self.variance * (self.weights @ self.weights.T)
        return Edge(
            self.course.move(self.shift), noise + self.extra_covariance + _MIN_VARIANCE * np.eye(2)
        )


def estimate_variance_ratio(lines: Sequence[Line]) -> float:
    """Return the variance of sums over neighbours, relative to that of independent errors."""
    sums = np.array([line.sums_of_blocks() for line in lines]).reshape(-1, 2).sum(axis=0)
    return max(1.0, float(sums[0] / sums[1])) if sums[1] > 0.0 else 1.0


def fit_line(course: Course, offsets: FloatArray, common_error: float, blur: float) -> Line | None:
    """Fit a line through points; None if too few of them are near it.

    ``common_error``: the error in pixels that all points have in common.
    """
    for _ in range(5):
        if len(offsets) < MIN_POINTS:
            return None
        line = Line(course, offsets)
        distances = np.abs(line.scatter)
        is_near = distances < _MAX_DEVIATIONS * 1.48 * float(np.median(distances)) + 0.5
        if is_near.all():
            break
        course, offsets = course.take(is_near), offsets[is_near]
    if line.scatter.std() > _MAX_SCATTER:
        return None
    end_errors = common_error * line.weights.sum(axis=1)
    return replace(
        line, extra_covariance=_grid_covariance(line, blur) + np.outer(end_errors, end_errors)
    )


def _grid_covariance(line: Line, blur: float) -> FloatArray:
    """Return the covariance due to the pixel grid, in addition to that of the points' scatter.

    A sharp pixel is lit or dark depending on its centre, so all points of an edge along the grid
    have the same error. A blur of s pixels leaves exp(-2 pi^2 s^2) of the first harmonic of this
    error.
    """
    leverage, weights = line.course.leverage, line.weights
    phase = (np.arange(_PHASES) + 0.5)[:, None] / _PHASES
    across = line.course.across + leverage @ line.shift
    offsets = ((phase + across) % 1.0 - 0.5) * math.exp(-2.0 * math.pi**2 * blur**2)
    end_shifts = weights @ offsets.T
    scatter = float(np.square(offsets.T - leverage @ end_shifts).mean())
    excess = end_shifts @ end_shifts.T / _PHASES - scatter * (weights @ weights.T)
    sizes, axes = np.linalg.eigh(excess)
    return np.asarray((axes * np.maximum(sizes, 0.0)) @ axes.T)
