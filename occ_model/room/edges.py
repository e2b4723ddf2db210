"""The straight edges of a rectangular lamp in a picture, to a fraction of a pixel.

Dark chips hide a lamp's edge: it is measured only where the lamp's light, which repeats with the
packet, is bright.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray, IndexArray
from occ_model.camera.coverage import column_spans
from occ_model.camera.photometry import luminance_of
from occ_model.effects.distortion import undistort
from occ_model.room.room import Room, RoomLamp
from occ_model.scene.scene import Scene
from occ_model.transmitter.packet import sent_chips

_EDGE_REACH = 7  # pixels on either side of an edge that is expected: its light is summed there
_LEVEL_PIXELS = 10  # further pixels, from which lamp and surroundings have their light
_MIN_RELATIVE_LIGHT = 0.5  # fraction of the lamp's brightest light from which an edge is measured

_EXCLUDED_END_FRACTION = 0.06  # fraction of an edge's length, and pixels, left out at its ends
_MIN_POINTS = 16  # points from which a line is fitted
_MIN_ROWS = 16  # minimum rows that determine the lamp's light in a column
_MIN_LEVEL_PIXELS = 4  # minimum bright pixels inside a lamp that determine its level
_MAX_DEVIATIONS = 3.5  # deviations beyond which a point is left out of a line
_MIN_VARIANCE = 1e-8  # of a line's point, in square pixels: points can be as straight as a ruler
_PHASES = 16  # places of an edge on the pixel grid that its error is counted over

_BLOCK = 8  # points with correlated errors: the blocks of a JPEG file, the lens's blur


@dataclass(frozen=True, eq=False, slots=True)
class Edge:
    """An edge of a lamp in a picture, by two points on it."""

    side: int  # Which of the quadrilateral's sides, from its corner of that number to the next
    points: FloatArray  # Shape (2, 2): (column, row) of two points, their lens's distortion undone
    normal: FloatArray  # Shape (2,): of the edge
    covariance: FloatArray  # Shape (2, 2): of both points along the normal, in square pixels


@dataclass(frozen=True, eq=False, slots=True)
class _Points:
    """Points of an edge: (column, row) of each, and their common error in pixels."""

    places: FloatArray
    shared: float


_NONE = _Points(np.empty((0, 2)), 0.0)


@dataclass(frozen=True, eq=False, slots=True)
class _OwnLight:
    """A lamp's light in every column, at its middle row, and its fall from row to row."""

    light: FloatArray  # Shape (columns,): above the dark; 0 where it is not known
    fall: float
    middle: float

    def at(self, rows: IndexArray, columns: IndexArray) -> FloatArray:
        """Return the light in some columns of each row, shape as ``columns``."""
        return np.asarray(self.light[columns] * (1.0 + self.fall * (rows - self.middle))[:, None])


class EdgeFinder:
    def __init__(self, image: ByteArray, room: Room) -> None:
        self._scene = room.scene
        self._image = image
        self._light = luminance_of(np.arange(256, dtype=np.float64), room.scene.camera)
        self._dark = float(np.median(self._light[image[::16, ::16]]))

    def edges(self, lamp: RoomLamp, corners: FloatArray) -> list[Edge]:
        lines = []
        own = self._own_light(corners, lamp)
        for side in range(4):
            start, end = corners[side], corners[(side + 1) % 4]
            along = np.abs(end - start)
            axis = int(along[0] < along[1])
            points = self._across(axis, start, end, corners, own)
            if len(points.places) >= _MIN_POINTS:  # the outline was rough: about the edge itself
                course = np.polyfit(points.places[:, axis], points.places[:, 1 - axis], 1)
                start, end = start.copy(), end.copy()
                for point in (start, end):
                    point[1 - axis] = np.polyval(course, point[axis])
                points = self._across(axis, start, end, corners, own)
            line = _fitted(side, points, self._scene)
            if line is not None:
                lines.append(line)
        alike = _variance_ratio(lines)
        return [line.edge(alike) for line in lines]

    def _own_light(self, corners: FloatArray, lamp: RoomLamp) -> _OwnLight:
        """Return the lamp's light in every column of the picture, repeated with its packet."""
        sent = lamp.transmitter
        period = len(sent_chips(sent)) * sent.switching_period / self._scene.camera.readout_time
        shown, light, fall = self._inner_light(corners)
        place = np.arange(self._image.shape[1], dtype=np.float64)
        if not len(shown):
            return _OwnLight(np.zeros(len(place)), 0.0, 0.0)
        first, last = float(shown[0]), float(shown[-1])
        if last - first < period:
            own = np.where((place >= first) & (place <= last), place, -1.0)
        else:
            below = np.ceil(np.maximum(first - place, 0.0) / period)
            above = np.ceil(np.maximum(place - last, 0.0) / period)
            own = place + (below - above) * period
        repeated = np.where(own < 0.0, 0.0, np.interp(own, shown, light))
        return _OwnLight(repeated, fall, float(corners[:, 1].mean()))

    def _inner_light(self, corners: FloatArray) -> tuple[IndexArray, FloatArray, float]:
        """Return the columns well within some corners, the light there above the dark, its fall.

        The light is that at the middle row; per row it grows by a fraction, the fall.
        """
        first, last = column_spans(corners, *self._image.shape)
        first, last = first + _EDGE_REACH, last - _EDGE_REACH
        shown = np.flatnonzero(last - first >= _MIN_ROWS)
        if not len(shown):
            return shown, np.empty(0), 0.0
        shown = np.arange(shown[0], shown[-1] + 1)
        first, last = first[shown], np.maximum(last[shown], first[shown] + 1)
        top, bottom = int(first.min()), int(last.max())
        light = self._light[self._image[top:bottom, shown[0] : shown[-1] + 1]] - self._dark
        row = np.arange(top, bottom)[:, None]
        within = (row >= first) & (row < last)
        light[~within] = 0.0
        mean, middle = light.sum(axis=0) / (last - first), (first + last - 1) / 2.0
        apart = np.where(within, row - middle, 0.0)
        fall = float((apart * light).sum(axis=0) @ mean)
        fall /= max(float(np.square(apart).sum(axis=0) @ np.square(mean)), 1e-12)
        return shown, mean / (1.0 + fall * (middle - corners[:, 1].mean())), fall

    def _across(
        self, axis: int, start: FloatArray, end: FloatArray, corners: FloatArray, own: _OwnLight
    ) -> _Points:
        """Find points of an edge along an axis: 0, nearly level, one a column; 1, one a row."""
        image = self._image if axis == 0 else self._image.T
        begin, base = start[axis], start[1 - axis]
        places = _places(begin, end[axis], image.shape[1])
        line = base + (places - begin) * (end[1 - axis] - base) / (end[axis] - begin)
        inwards = 1 if corners[:, 1 - axis].mean() > (base + end[1 - axis]) / 2.0 else -1
        middle = np.rint(line).astype(np.int64)
        reach = _EDGE_REACH + _LEVEL_PIXELS
        kept = (middle > reach) & (middle < len(image) - reach - 1)
        places, middle = places[kept], middle[kept]
        if len(places) < _MIN_POINTS:
            return _NONE
        across = middle[:, None] + np.arange(-reach, reach + 1) * inwards
        light = self._light[image[across, places[:, None]]]
        if axis == 0:  # a column has one light, which its innermost pixels show
            inside = light[:, -_LEVEL_PIXELS:].mean(axis=1) - float(light[:, :_LEVEL_PIXELS].mean())
            lit = inside > _MIN_RELATIVE_LIGHT * np.percentile(inside, 95)
            if lit.sum() < _MIN_POINTS:
                return _NONE
            count, shared, _ = _counts(light[lit], inside[lit, None], 0.0)
        else:
            bright = _MIN_RELATIVE_LIGHT * np.percentile(own.light, 99)
            count, shared, lit = _counts(light, own.at(places, across), bright)
            count = count[lit]
        found = middle[lit] + inwards * (_EDGE_REACH + 0.5 - count)
        points = np.stack([places[lit].astype(np.float64), found], axis=1)
        return _Points(points if axis == 0 else points[:, ::-1], shared)


def _counts(
    light: FloatArray, expected: FloatArray, bright: float
) -> tuple[FloatArray, float, BoolArray]:
    """Return the lit pixels about an edge, the common error of all counts, and which are valid.

    The light about an edge is as much as its innermost pixels would hold, so many and a part of the
    next; a count is valid only where that one is bright. ``light`` runs from outside to inside;
    ``expected`` is the lamp's own.
    """
    full = np.broadcast_to(expected, light.shape)
    dark = light[:, :_LEVEL_PIXELS].mean(axis=0)
    outside = float(dark.mean())
    inner = full[:, -_LEVEL_PIXELS:].mean(axis=0)
    shows = inner > max(bright, 0.0)
    places = np.arange(_EDGE_REACH + 1, _EDGE_REACH + _LEVEL_PIXELS + 1, dtype=np.float64)[shows]
    none = np.zeros(len(light), dtype=np.bool_)
    if len(places) < _MIN_LEVEL_PIXELS:
        return np.zeros(len(light)), 0.0, none
    level = ((light[:, -_LEVEL_PIXELS:] - outside).mean(axis=0) / np.maximum(inner, 1e-12))[shows]
    # The light falls towards the rim: the level is taken where the lit pixels are.
    apart = places - places.mean()
    slope, gain = np.polyfit(apart, level, 1)
    scatter = float((level - slope * apart).std() * np.sqrt(len(places) / (len(places) - 2)))
    back = places.mean() - _EDGE_REACH / 2.0
    spread = float(apart.std() * np.sqrt(len(places)))
    # from inside to outside
    own = full[:, _LEVEL_PIXELS:-_LEVEL_PIXELS][:, ::-1] * (gain - slope * back)
    held = np.cumsum(own, axis=1)
    total = (light[:, _LEVEL_PIXELS:-_LEVEL_PIXELS] - outside).sum(axis=1)
    last = np.minimum((held < total[:, None]).sum(axis=1), own.shape[1] - 2)
    row = np.arange(len(light))
    before = held[row, last] - own[row, last]
    count = last + (total - before) / np.maximum(own[row, last], 1e-12)
    beside = np.stack([own[row, np.maximum(last + step, 0)] for step in (-1, 0, 1)])
    is_lit = beside.min(axis=0) > bright * gain
    of_level = _EDGE_REACH * scatter / gain * np.hypot(1.0 / np.sqrt(len(places)), back / spread)
    of_pixels = np.sqrt(_EDGE_REACH) * scatter / gain
    of_dark = (
        (2.0 * _EDGE_REACH + 1.0)
        * float(dark.std())
        / np.sqrt(_LEVEL_PIXELS)
        / float((inner * gain).max())
    )
    return count, float(np.sqrt(of_level**2 + of_pixels**2 + of_dark**2)), is_lit


def _places(start: float, end: float, size: int) -> "np.ndarray[tuple[int], np.dtype[np.int64]]":
    low, high = min(start, end), max(start, end)
    cut = max(_EXCLUDED_END_FRACTION * (high - low), _EDGE_REACH + _LEVEL_PIXELS - 2.0)
    return np.arange(int(max(low + cut, 0.0)) + 1, int(min(high - cut, size - 1.0)) + 1)


@dataclass(frozen=True, eq=False, slots=True)
class _Line:
    side: int
    level: bool  # Whether ``x`` counts columns; rows else
    # Shape (points,): the points along the edge's axis and across it
    x: FloatArray
    y: FloatArray
    # Shape (2, 2): covariance at both of the line's points of what the points' scatter does not
    # show
    known: FloatArray

    @property
    def slope(self) -> float:
        return float(self.along @ self.y / (self.along @ self.along))

    @property
    def along(self) -> FloatArray:
        """The points' places from their mean, in standard deviations of them."""
        return np.asarray((self.x - self.x.mean()) / self.x.std())

    @property
    def off(self) -> FloatArray:
        """How far the points are from the line, across the axis."""
        return np.asarray(self.y - self.y.mean() - self.slope * self.along)

    @property
    def variance(self) -> float:
        return float(self.off @ self.off) / (len(self.x) - 2)

    def sums_of_blocks(self) -> tuple[float, float]:
        """Return the squares of both ends' sums over blocks, and those of independent errors."""
        block = ((self.x - self.x.min()) // _BLOCK).astype(np.int64)
        lines = np.stack([np.ones(len(self.x)), self.along]) / math.sqrt(len(self.x))
        found = expected = 0.0
        for weight in (1.0 - self.along, 1.0 + self.along):
            found += float(np.square(np.bincount(block, self.off * weight)).sum())
            taken = [np.bincount(block, own * weight) for own in lines]
            expected += float(weight @ weight - np.square(taken).sum()) * self.variance
        return found, expected

    def edge(self, alike: float) -> Edge:
        """Return the edge; ``alike``: the variance of sums relative to independent errors."""
        ends = self.x.mean() + np.array([-1.0, 1.0]) * self.x.std()
        at = self.y.mean() + np.array([-1.0, 1.0]) * self.slope
        slope = self.slope / float(self.x.std())
        noise = 2.0 * alike * self.variance / len(self.x) + _MIN_VARIANCE
        covariance = (noise * np.eye(2) + self.known) / (1.0 + slope**2)
        points, normal = np.stack([ends, at], axis=1), np.array([-slope, 1.0])
        normal /= np.hypot(1.0, slope)
        if not self.level:
            points, normal = points[:, ::-1], normal[::-1]
        return Edge(self.side, points, normal, covariance)


def _variance_ratio(lines: Sequence[_Line]) -> float:
    """Return the variance of sums over neighbours relative to independent errors, of all edges."""
    sums = np.array([line.sums_of_blocks() for line in lines]).reshape(-1, 2).sum(axis=0)
    return max(1.0, float(sums[0] / sums[1])) if sums[1] > 0.0 else 1.0


def _fitted(side: int, found: _Points, scene: Scene) -> _Line | None:
    """Fit a line through points; None where too few are left near it."""
    if len(found.places) < _MIN_POINTS:
        return None
    points = undistort(found.places, scene)
    level = bool(np.ptp(points[:, 0]) >= np.ptp(points[:, 1]))
    along = 0 if level else 1
    x, y, grid = points[:, along], points[:, 1 - along], found.places[:, along]
    for _ in range(4):
        line = _Line(side, level, x, y, np.zeros((2, 2)))
        off = line.off
        if off.std() < 1e-9:
            break
        spread = 1.48 * float(np.median(np.abs(off))) + 1e-6
        kept = np.abs(off) < _MAX_DEVIATIONS * spread + 0.5
        if kept.sum() < _MIN_POINTS:
            return None
        x, y, grid = x[kept], y[kept], grid[kept]
    line = _Line(side, level, x, y, np.zeros((2, 2)))
    if line.off.std() > 2.0:
        return None
    of_grid = _of_grid(grid, line.slope / float(x.std()), scene.lens.point_spread)
    return replace(line, known=of_grid + found.shared**2)


def _of_grid(grid: FloatArray, slope: float, blur: float) -> FloatArray:
    """Return the covariance that whole pixels leave beyond what the points' scatter shows.

    A pixel is lit, or not, by its centre: where an edge runs along the grid, all points are off by
    the same. A blur of s pixels leaves exp(-2 pi^2 s^2) of the first harmonic of that error.
    """
    apart = grid - grid.mean()
    phase = (np.arange(_PHASES) + 0.5)[:, None] / _PHASES
    off = ((phase + slope * apart) % 1.0 - 0.5) * math.exp(-2.0 * math.pi**2 * blur**2)
    middle, turn = off.mean(axis=1), (off * apart).mean(axis=1) / max(float(grid.std()), 1e-9)
    ends = np.stack([middle - turn, middle + turn])
    scatter = float(np.square(off).mean() - np.square(middle).mean() - np.square(turn).mean())
    beyond = ends @ ends.T / _PHASES - 2.0 * scatter / len(grid) * np.eye(2)
    sizes, axes = np.linalg.eigh(beyond)
    return np.asarray((axes * np.maximum(sizes, 0.0)) @ axes.T)
