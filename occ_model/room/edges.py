"""The straight edges of a rectangular lamp in a picture, to a fraction of a pixel.

Dark chips hide a lamp's edge: it is measured only where the lamp's light, which repeats with the
packet, is bright.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.photometry import luminance_of
from occ_model.camera.projection import image_points, image_rays
from occ_model.room.reading import ReadLamp
from occ_model.room.room import Room, RoomLamp
from occ_model.scene.scene import Camera, Scene
from occ_model.transmitter.packet import packet

_REACH = 7
"""Pixels on either side of an edge that is expected: its light is summed there."""

_INSIDE = 10
"""Further pixels that tell the light of the lamp, and that of its surroundings."""

_BRIGHT = 0.5
"""Share of the lamp's brightest light from which an edge is measured."""

_ENDS = 0.06
"""Share of an edge's length, and pixels, that are left out at its ends."""

_LEAST_POINTS = 16
"""Points from which a line is fitted."""

_MOST_DEVIATIONS = 3.5
"""Deviations beyond which a point is left out of a line."""


_UPRIGHT = 0.1
"""Pixels that an upright edge is off as a whole, beside the scatter of its points: its lamp's light
is known from other columns. In 28 pictures of an office and 28 of a hall half of the 670 points
were off by more than 0.06, and their errors had been stated as 0.04."""


@dataclass(frozen=True, eq=False, slots=True)
class Edge:
    """An edge of a lamp in a picture, by two points on it.

    Parameters
    ----------
    side
        Which of the quadrilateral's sides, from its corner of that number to the next.
    points : ndarray of float64, shape (2, 2)
        (column, row) of two points, their lens's distortion undone.
    normal : ndarray of float64, shape (2,)
        Of the edge.
    errors
        Standard deviation of each point along the normal, in pixels: they are independent.
    """

    side: int
    points: FloatArray
    normal: FloatArray
    errors: tuple[float, float]


def quadrilateral(hull: FloatArray) -> FloatArray:
    """Return the quadrilateral round a convex outline, corners in the sense of a lamp's own."""
    found = cv2.approxPolyN(hull.astype(np.float32).reshape(-1, 1, 2), 4)
    corners = np.asarray(found, dtype=np.float64).reshape(4, 2)
    x, y = corners.T
    area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
    return corners if area > 0.0 else corners[::-1].copy()


class EdgeFinder:
    """Measures the edges of lamps in a picture."""

    def __init__(self, image: ByteArray, room: Room) -> None:
        self._scene = room.scene
        levels = np.arange(256, dtype=np.float64)
        self._light = luminance_of(levels, room.scene.camera)[image]

    def edges(self, read: ReadLamp, lamp: RoomLamp, corners: FloatArray) -> list[Edge]:
        """Measure the edges of a lamp that is expected between some corners."""
        found = []
        own = self._own_light(read, lamp)
        for side in range(4):
            start, end = corners[side], corners[(side + 1) % 4]
            along = end - start
            points = (
                self._across_rows(start, end, corners)
                if abs(along[0]) >= abs(along[1])
                else self._across_columns(start, end, corners, own)
            )
            edge = _fitted(side, points, self._scene)
            if edge is not None:
                found.append(edge)
        return found

    def _own_light(self, read: ReadLamp, lamp: RoomLamp) -> FloatArray:
        """Return the lamp's light in every column of the picture, repeated with its packet."""
        columns = self._light.shape[1]
        sent = self._scene.replace(
            switching_frequency=lamp.transmitter.switching_frequency,
            bits=lamp.transmitter.bits, code=lamp.transmitter.code,
            line_code=lamp.transmitter.line_code, framing=lamp.transmitter.framing,
            pattern=lamp.transmitter.pattern, payload=lamp.transmitter.payload,
        )  # fmt: skip
        period = len(packet(sent)) * sent.transmitter.switching_period
        period /= sent.camera.readout_time
        place = np.arange(columns, dtype=np.float64)
        first, last = read.region.first_column + 4, read.region.last_column - 5
        if last - first < period:
            own = np.where((place >= first) & (place <= last), place, -1.0)
        else:
            below = np.ceil(np.maximum(first - place, 0.0) / period)
            above = np.ceil(np.maximum(place - last, 0.0) / period)
            own = place + (below - above) * period
        shown = np.arange(read.region.first_column, read.region.last_column)
        dark = float(np.median(self._light[::16, ::16]))
        light = np.interp(own, shown, read.signal - dark)
        return np.asarray(np.where(own < 0.0, 0.0, light))

    def _across_rows(self, start: FloatArray, end: FloatArray, corners: FloatArray) -> FloatArray:
        """Find the row of a nearly level edge in each column, shape (points, 2)."""
        rows, columns = self._light.shape
        places = _places(start[0], end[0], columns)
        line = start[1] + (places - start[0]) * (end[1] - start[1]) / (end[0] - start[0])
        inwards = 1 if corners[:, 1].mean() > (start[1] + end[1]) / 2.0 else -1
        middle = np.rint(line).astype(np.int64)
        kept = (middle > _REACH + _INSIDE) & (middle < rows - _REACH - _INSIDE - 1)
        places, middle = places[kept], middle[kept]
        if len(places) < _LEAST_POINTS:
            return np.empty((0, 2))
        near = np.arange(-_REACH - _INSIDE, _REACH + _INSIDE + 1) * inwards
        light = self._light[middle[:, None] + near, places[:, None]]
        outside = float(light[:, :_INSIDE].mean())
        inside = light[:, -_INSIDE:].mean(axis=1) - outside
        lit = inside > _BRIGHT * np.percentile(inside, 95)
        window = light[lit, _INSIDE:-_INSIDE] - outside
        share = window.sum(axis=1) / inside[lit]
        found = middle[lit] + inwards * (_REACH + 0.5 - share)
        return np.stack([places[lit].astype(np.float64), found], axis=1)

    def _across_columns(
        self, start: FloatArray, end: FloatArray, corners: FloatArray, own: FloatArray
    ) -> FloatArray:
        """Find the column of a nearly upright edge in each row, shape (points, 2)."""
        rows, columns = self._light.shape
        places = _places(start[1], end[1], rows)
        line = start[0] + (places - start[1]) * (end[0] - start[0]) / (end[1] - start[1])
        inwards = 1 if corners[:, 0].mean() > (start[0] + end[0]) / 2.0 else -1
        middle = np.rint(line).astype(np.int64)
        kept = (middle > _REACH + _INSIDE) & (middle < columns - _REACH - _INSIDE - 1)
        places, middle = places[kept], middle[kept]
        if len(places) < _LEAST_POINTS:
            return np.empty((0, 2))
        outer = np.arange(-_REACH - _INSIDE, -_REACH) * inwards
        outside = float(self._light[places[:, None], middle[:, None] + outer].mean())
        near = np.arange(-_REACH, _REACH + 1) * inwards
        across = middle[:, None] + near
        lit = own[across].min(axis=1) > _BRIGHT * np.percentile(own, 99)
        if lit.sum() < _LEAST_POINTS:
            return np.empty((0, 2))
        across, places = across[lit], places[lit]
        share = (self._light[places[:, None], across] - outside) / own[across]
        found = middle[lit] + inwards * (_REACH + 0.5 - share.sum(axis=1))
        return np.stack([found, places.astype(np.float64)], axis=1)


def _places(start: float, end: float, size: int) -> "np.ndarray[tuple[int], np.dtype[np.int64]]":
    low, high = min(start, end), max(start, end)
    cut = max(_ENDS * (high - low), _REACH + 1.0)
    return np.arange(int(max(low + cut, 0.0)) + 1, int(min(high - cut, size - 1.0)) + 1)


def _fitted(side: int, points: FloatArray, scene: Scene) -> Edge | None:
    """Fit a line through points, and give it by two points on it."""
    if len(points) < _LEAST_POINTS:
        return None
    points = undistorted(points, scene)
    level = np.ptp(points[:, 0]) >= np.ptp(points[:, 1])
    x, y = points.T if level else points.T[::-1]
    for _ in range(3):
        slope, offset = np.polyfit(x - x.mean(), y, 1)
        off = y - offset - slope * (x - x.mean())
        spread = 1.48 * float(np.median(np.abs(off))) + 1e-6
        kept = np.abs(off) < _MOST_DEVIATIONS * spread + 0.5
        if kept.sum() < _LEAST_POINTS:
            return None
        x, y = x[kept], y[kept]
    slope, offset = np.polyfit(x - x.mean(), y, 1)
    off = y - offset - slope * (x - x.mean())
    if off.std() > 2.0:
        return None
    stretch = float(x.std())
    places = x.mean() + np.array([-stretch, stretch])
    at = offset + slope * (places - x.mean())
    # A pixel is lit whole or not at all: along an edge of few steps its place is rounded.
    steps = abs(slope) * float(np.ptp(x))
    rounding = 2.0 / 12.0 / (1.0 + steps**2)
    error = float(np.sqrt(2.0 * off.var() / len(x) + rounding)) / float(np.hypot(1.0, slope))
    if not level:
        error = float(np.hypot(error, _UPRIGHT))
    ends = np.stack([places, at], axis=1)
    normal = np.array([-slope, 1.0]) / np.hypot(1.0, slope)
    if not level:
        ends, normal = ends[:, ::-1], normal[::-1]
    return Edge(side, ends, normal, (error, error))


def undistorted(points: FloatArray, scene: Scene) -> FloatArray:
    """Return points of the picture, (column, row), where a lens without distortion shows them."""
    lens = scene.lens
    if not lens.distorts:
        return points
    camera: Camera = scene.camera
    rays = image_rays(points, camera)
    bent = np.array([lens.radial_k1, lens.radial_k2, lens.tangential_p1, lens.tangential_p2])
    flat = cv2.undistortPoints(rays[:, None, :], np.eye(3), bent)
    return image_points(np.asarray(flat, dtype=np.float64)[:, 0], camera)
