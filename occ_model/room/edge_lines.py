"""A straight edge behind a lens: where it is pictured, and the line through its measured points."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from occ_model.arrays import BoolArray, FloatArray, IndexArray
from occ_model.camera.projection import image_points, image_rays
from occ_model.effects.distortion import distort
from occ_model.scene.scene import Scene

_EXCLUDED_END_FRACTION = 0.06  # fraction of an edge's length that is left out at its ends
MIN_POINTS = 16  # points from which a line is fitted
_MAX_DEVIATIONS = 3.5  # deviations beyond which a point is left out of a line
_MIN_VARIANCE = 1e-8  # of a line's end, in square pixels: points can be as straight as a ruler
_MAX_SCATTER = 2.0  # pixels beyond which points are not those of one edge
_PHASES = 16  # places of an edge on the pixel grid that its error is counted over

_BLOCK = 8  # points with correlated errors: the blocks of a JPEG file, the lens's blur


@dataclass(frozen=True, eq=False, slots=True)
class Edge:
    """An edge of a lamp in a picture, by its ends, in the sense of the lamp's own outline."""

    points: FloatArray  # Shape (2, 2): (column, row) of both, their lens's distortion undone
    covariance: FloatArray  # Shape (2, 2): of both along the edge's normal, in square pixels

    @property
    def normal(self) -> FloatArray:
        """The unit vector across the edge, towards the lamp, shape (2,)."""
        return find_normal(*self.points)


def find_normal(start: FloatArray, end: FloatArray) -> FloatArray:
    along = end - start
    return np.array([-along[1], along[0]]) / max(float(np.hypot(*along)), 1e-12)


@dataclass(frozen=True, eq=False, slots=True)
class Course:
    """Where a straight edge is expected in the picture, a point in each of its columns or rows."""

    # Shape (2, 2): the edge's ends where a lens without distortion shows them
    ends: FloatArray
    axis: int  # 0: an edge nearly level, a point a column; 1: a point a row
    # Shape (points,): the columns, or rows, and the row, or column, of the edge in each
    places: IndexArray
    across: FloatArray
    # Shape (points, 2): how far each moves across where an end moves by a pixel along the normal
    leverage: FloatArray
    steepness: FloatArray  # Shape (points,): length of the edge for a pixel along its axis

    @classmethod
    def of(cls, ends: FloatArray, scene: Scene) -> Self:
        """Trace an edge between two ends."""
        start, end = ends
        count = max(3, math.ceil(float(np.hypot(*(end - start)))) + 1)
        share = np.linspace(0.0, 1.0, count)
        flat = start + share[:, None] * (end - start)
        line, beside = (
            picture_points(one, scene) for one in (flat, flat + find_normal(start, end))
        )
        extent = line[-1] - line[0]
        axis = int(abs(extent[0]) < abs(extent[1]))
        if extent[axis] < 0.0:
            share, line, beside = share[::-1], line[::-1], beside[::-1]
        size = scene.camera.rows if axis else scene.camera.columns
        low, high = line[[0, -1], axis].tolist()
        places = np.arange(max(math.ceil(low), 0), min(math.floor(high), size - 1) + 1)
        if not (np.diff(line[:, axis]) > 0.0).all():  # it turns back
            return cls(ends, axis, places[:0], np.empty(0), np.empty((0, 2)), np.empty(0))
        across, moved = (
            np.interp(places, one[:, axis], one[:, 1 - axis]) for one in (line, beside)
        )
        part = np.interp(places, line[:, axis], share)
        leverage = (moved - across)[:, None] * np.stack([1.0 - part, part], axis=1)
        along = np.interp(places, line[:, axis], np.gradient(line[:, axis]))
        below = np.interp(places, line[:, axis], np.gradient(line[:, 1 - axis]))
        return cls(ends, axis, places, across, leverage, np.hypot(along, below) / along)

    def without_ends(self, excluded: int) -> Self:
        """Return it without a fraction of its length, and at least some pixels, at both ends."""
        cut = max(math.ceil(_EXCLUDED_END_FRACTION * len(self.places)), excluded)
        return self.take(np.arange(len(self.places))[cut : len(self.places) - cut])

    def take(self, kept: BoolArray | IndexArray | slice) -> Self:
        names = "places", "across", "leverage", "steepness"
        return replace(self, **{name: getattr(self, name)[kept] for name in names})

    def move(self, shift: FloatArray) -> FloatArray:
        """Return the ends, each moved along the normal."""
        return np.asarray(self.ends + shift[:, None] * find_normal(*self.ends))


def picture_points(points: FloatArray, scene: Scene) -> FloatArray:
    """Return where the lens shows points, (column, row), of a picture without distortion."""
    if not scene.lens.distorts:
        return points
    return image_points(distort(image_rays(points, scene.camera), scene.lens), scene.camera)


@dataclass(frozen=True, eq=False, slots=True)
class Line:
    """The straight line through the measured points of an edge: least squares in the picture."""

    course: Course
    off: FloatArray  # Shape (points,): how far each was found across the course, in pixels
    # Shape (2, 2): covariance of both ends that the points' scatter does not show
    known: FloatArray

    @property
    def weights(self) -> FloatArray:
        """What each point weighs in the shift of both ends, shape (2, points)."""
        return np.asarray(np.linalg.pinv(self.course.leverage))

    @property
    def shift(self) -> FloatArray:
        """How far the ends are from the course's, along its normal, shape (2,)."""
        return np.asarray(self.weights @ self.off)

    @property
    def scatter(self) -> FloatArray:
        """How far the points are from the line, across the axis."""
        return np.asarray(self.off - self.course.leverage @ self.shift)

    @property
    def variance(self) -> float:
        return float(self.scatter @ self.scatter) / (len(self.off) - 2)

    def sums_of_blocks(self) -> tuple[float, float]:
        """Return the squares of both ends' sums over blocks, and those of independent errors."""
        places, weights, scatter = self.course.places, self.weights, self.scatter
        block = (places - places.min()) // _BLOCK
        lines, _ = np.linalg.qr(self.course.leverage)
        found = expected = 0.0
        for weight in weights / np.sqrt(np.square(weights).mean()):
            found += float(np.square(np.bincount(block, scatter * weight)).sum())
            taken = [np.bincount(block, own * weight) for own in lines.T]
            expected += float(weight @ weight - np.square(taken).sum()) * self.variance
        return found, expected

    def edge(self, alike: float) -> Edge:
        """Return the edge; ``alike``: the variance of sums relative to independent errors."""
        noise = alike * self.variance * (self.weights @ self.weights.T)
        return Edge(self.course.move(self.shift), noise + self.known + _MIN_VARIANCE * np.eye(2))


def estimate_variance_ratio(lines: Sequence[Line]) -> float:
    """Return the variance of sums over neighbours relative to independent errors, of all edges."""
    sums = np.array([line.sums_of_blocks() for line in lines]).reshape(-1, 2).sum(axis=0)
    return max(1.0, float(sums[0] / sums[1])) if sums[1] > 0.0 else 1.0


def fit_line(course: Course, off: FloatArray, shared: float, blur: float) -> Line | None:
    """Fit a line through points; None where too few are left near it.

    ``shared``: error in pixels that all have in common.
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
    return replace(line, known=_of_grid(line, blur) + np.outer(common, common))


def _of_grid(line: Line, blur: float) -> FloatArray:
    """Return the covariance that whole pixels leave beyond what the points' scatter shows.

    A pixel is lit, or not, by its centre: where an edge runs along the grid, all points are off by
    the same. A blur of s pixels leaves exp(-2 pi^2 s^2) of the first harmonic of that error.
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
