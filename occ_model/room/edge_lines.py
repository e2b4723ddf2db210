"""Fit a line to the measured points of a straight edge as a lens pictures it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.camera.projection import image_points, image_rays
from occ_model.effects.distortion import distort
from occ_model.scene.scene import Scene

_EXCLUDED_END_FRACTION = 0.06  # fraction of an edge's length that is omitted at each end
MIN_POINTS = 16  # minimum number of points to fit a line
_MAX_DEVIATIONS = 3.5  # standard deviations beyond which a point is excluded from a line
_MIN_VARIANCE = 1e-8  # of a line's end in square pixels, because points can lie perfectly straight
_MAX_SCATTER = 2.0  # scatter in pixels beyond which points do not belong to one edge
_PHASES = 16  # places of an edge on the pixel grid over which its error is averaged

_BLOCK = 8  # points with correlated errors, due to the blocks of a JPEG file or the lens's blur


@dataclass(frozen=True, eq=False, slots=True)
class Edge:
    """An edge of a lamp in a picture, given by its ends in the order of the lamp's outline."""

    points: FloatArray  # Shape (2, 2): (column, row) of both ends, without the lens's distortion
    covariance: FloatArray  # Shape (2, 2): of both ends along the edge's normal, in square pixels

    @property
    def normal(self) -> FloatArray:
        """The unit vector across the edge, towards the lamp, shape (2,)."""
        return find_normal(*self.points)


def find_normal(start: FloatArray, end: FloatArray) -> FloatArray:
    along = end - start
    return np.array([-along[1], along[0]]) / max(float(np.hypot(*along)), 1e-12)


@dataclass(frozen=True, eq=False, slots=True)
class Course:
    """The expected course of a straight edge in the picture: a point in each column or row."""

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
        share = np.linspace(0.0, 1.0, count)
        flat = start + share[:, None] * (end - start)
        line, beside = (
            distort_points(one, scene) for one in (flat, flat + find_normal(start, end))
        )
        extent = line[-1] - line[0]
        axis = int(abs(extent[0]) < abs(extent[1]))
        if extent[axis] < 0.0:
            share, line, beside = share[::-1], line[::-1], beside[::-1]
        size = scene.camera.rows if axis else scene.camera.columns
        low, high = line[[0, -1], axis].tolist()
        places = np.arange(max(math.ceil(low), 0), min(math.floor(high), size - 1) + 1)
        if not (np.diff(line[:, axis]) > 0.0).all():  # the curve turns back
            return cls(ends, axis, places[:0], np.empty(0), np.empty((0, 2)), np.empty(0))
        across, moved = (
            np.interp(places, one[:, axis], one[:, 1 - axis]) for one in (line, beside)
        )
        part = np.interp(places, line[:, axis], share)
        leverage = (moved - across)[:, None] * np.stack([1.0 - part, part], axis=1)
        along = np.interp(places, line[:, axis], np.gradient(line[:, axis]))
        below = np.interp(places, line[:, axis], np.gradient(line[:, 1 - axis]))
        return cls(ends, axis, places, across, leverage, np.hypot(along, below) / along)

    def cut_ends(self, excluded: int) -> Self:
        """Omit a fraction of the length at both ends, but at least ``excluded`` pixels."""
        cut = max(math.ceil(_EXCLUDED_END_FRACTION * len(self.places)), excluded)
        return self.take(np.arange(len(self.places))[cut : len(self.places) - cut])

    def take(self, kept: BoolArray | IndexArray | slice) -> Self:
        names = "places", "across", "leverage", "steepness"
        return replace(self, **{name: getattr(self, name)[kept] for name in names})

    def move(self, shift: FloatArray) -> FloatArray:
        """Return the ends, each moved along the normal."""
        return np.asarray(self.ends + shift[:, None] * find_normal(*self.ends))


def distort_points(points: FloatArray, scene: Scene) -> FloatArray:
    """Return where the lens shows points (column, row) of an undistorted picture."""
    if not scene.lens.distorts:
        return points
    return image_points(distort(image_rays(points, scene.camera), scene.lens), scene.camera)


@dataclass(frozen=True, eq=False, slots=True)
class Line:
    """The straight line through the measured points of an edge, by least squares."""

    course: Course
    off: FloatArray  # Shape (points,): measured distance of each from the course, in pixels
    # Shape (2, 2): covariance of both ends beyond that of the points' scatter
    known: FloatArray

    @property
    def weights(self) -> FloatArray:
        """Weight of each point in the shifts of both ends, shape (2, points)."""
        return np.asarray(np.linalg.pinv(self.course.leverage))

    @property
    def shift(self) -> FloatArray:
        """Distances of both ends from the course's, along its normal, shape (2,)."""
        return np.asarray(self.weights @ self.off)

    @property
    def scatter(self) -> FloatArray:
        """Distances of the points from the line, across the axis."""
        return np.asarray(self.off - self.course.leverage @ self.shift)

    @property
    def variance(self) -> float:
        return float(self.scatter @ self.scatter) / (len(self.off) - 2)

    def sums_of_blocks(self) -> tuple[float, float]:
        """Return the squared sums over blocks for both ends, and those of independent errors."""
        places, weights, scatter = self.course.places, self.weights, self.scatter
        block = (places - places.min()) // _BLOCK
        lines, _ = np.linalg.qr(self.course.leverage)
        found = expected = 0.0
        for weight in weights / np.sqrt(np.square(weights).mean()):
            found += float(np.square(np.bincount(block, scatter * weight)).sum())
            taken = [np.bincount(block, own * weight) for own in lines.T]
            expected += float(weight @ weight - np.square(taken).sum()) * self.variance
        return found, expected

    def make_edge(self, alike: float) -> Edge:
        """Return the edge; ``alike``: variance of sums relative to that of independent errors."""
        noise = alike * self.variance * (self.weights @ self.weights.T)
        return Edge(self.course.move(self.shift), noise + self.known + _MIN_VARIANCE * np.eye(2))


def estimate_variance_ratio(lines: Sequence[Line]) -> float:
    """Return the variance of sums over neighbours relative to that of independent errors."""
    sums = np.array([line.sums_of_blocks() for line in lines]).reshape(-1, 2).sum(axis=0)
    return max(1.0, float(sums[0] / sums[1])) if sums[1] > 0.0 else 1.0


def fit_line(course: Course, off: FloatArray, shared: float, blur: float) -> Line | None:
    """Fit a line through points; None if too few are left near it.

    ``shared``: the common error of all points in pixels.
    """
    unknown = np.zeros((2, 2))
    for _ in range(5):
        if len(off) < MIN_POINTS:
            return None
        line = Line(course, off, unknown)
        apart = np.abs(line.scatter)
        kept = apart < _MAX_DEVIATIONS * 1.48 * float(np.median(apart)) + 0.5
        if kept.all():
            break
        course, off = course.take(kept), off[kept]
    if line.scatter.std() > _MAX_SCATTER:
        return None
    common = shared * line.weights.sum(axis=1)
    return replace(line, known=_grid_covariance(line, blur) + np.outer(common, common))


def _grid_covariance(line: Line, blur: float) -> FloatArray:
    """Return the covariance due to whole pixels, beyond that of the points' scatter.

    A sharp pixel is lit or dark depending on its centre, so all points of an edge along the grid
    have the same error. A blur of s pixels leaves exp(-2 pi^2 s^2) of the first harmonic of this
    error.
    """
    leverage, weights = line.course.leverage, line.weights
    phase = (np.arange(_PHASES) + 0.5)[:, None] / _PHASES
    across = line.course.across + leverage @ line.shift
    off = ((phase + across) % 1.0 - 0.5) * math.exp(-2.0 * math.pi**2 * blur**2)
    ends = weights @ off.T
    scatter = float(np.square(off.T - leverage @ ends).mean())
    beyond = ends @ ends.T / _PHASES - scatter * (weights @ weights.T)
    sizes, axes = np.linalg.eigh(beyond)
    return np.asarray((axes * np.maximum(sizes, 0.0)) @ axes.T)
