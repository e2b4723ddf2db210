"""Lens distortion: straight lines are bent, the panel's outline but not the stripes.

A stripe is made by the shutter when the light changes, and stays a straight column whatever the
lens does.
"""

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.camera.optics import Optics
from occ_model.camera.projection import geometry_of, image_points, image_rays
from occ_model.camera.row_memory import MEMORY
from occ_model.effects.effect import Cost, OpticsEffect
from occ_model.effects.optics_effects import blur_of
from occ_model.errors import ProjectionError
from occ_model.scene.scene import Lens, Scene

_PARTS = 64  # fewest parts that each edge of the panel is divided into
_MOST_PARTS = 1024  # most parts of an edge
_CURVE_TOLERANCE = 0.01  # largest distance of the straight parts from the curve, in pixels
_DIRECTIONS = 64  # directions in which a fold of the lens's image is searched for

_ITERATIONS = 40  # of the inverse distortion; each leaves a few percent of the error
_MOST_OFF = 1e-6  # largest error of an inverse, in focal lengths

_RADII = np.linspace(0.0, 4.0, 129)[1:]
"""Radii at which a fold is searched for, in multiples of the picture's corner and of the radius
needed."""


class Distortion(OpticsEffect):
    """Radial and tangential distortion of the panel's outline.

    A ray (x, y), r^2 = x^2 + y^2, in focal lengths, is pictured at
    x (1 + k1 r^2 + k2 r^4) + 2 p1 x y + p2 (r^2 + 2 x^2), and y alike with p1 and p2 exchanged
    (D. C. Brown, "Decentering distortion of lenses", Photogrammetric Engineering 32, 1966).
    """

    name = "distortion"
    label = "Lens distortion"
    parameters = ("radial_k1", "radial_k2", "tangential_p1", "tangential_p2")
    cost = Cost(picture=1.2e-3)

    def is_present(self, scene: Scene) -> bool:
        return scene.lens.distorts

    def apply(self, scene: Scene, optics: Optics) -> Optics:
        """Bend the panel's outline; ProjectionError where that folds the picture's corners back."""
        if not self.is_present(scene):
            return optics
        return replace(optics, outline=_outlines(scene, optics.outline)[1], cover_stage=self.name)


def distorted(rays: FloatArray, lens: Lens) -> FloatArray:
    """Return the image points of rays (x, y), in focal lengths, shape as ``rays``."""
    x, y = rays[..., 0], rays[..., 1]
    square = x * x + y * y
    radial = 1.0 + square * (lens.radial_k1 + lens.radial_k2 * square)
    p1, p2 = lens.tangential_p1, lens.tangential_p2
    return np.stack(
        [
            x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x * x),
            y * radial + 2.0 * p2 * x * y + p1 * (square + 2.0 * y * y),
        ],
        axis=-1,
    )


def undistorted(points: FloatArray, scene: Scene) -> FloatArray:
    """Return points of the picture, (column, row), where a lens without distortion shows them.

    Points without an inverse are returned unchanged. OpenCV's ``undistortPoints`` ends after five
    iterations: with k1 = -0.25 it was off by up to 3.5 pixels.
    """
    lens, camera = scene.lens, scene.camera
    if not lens.distorts:
        return points
    rays = straight = image_rays(points, camera)
    for _ in range(_ITERATIONS):
        straight = straight - (distorted(straight, lens) - rays)
    off = np.abs(distorted(straight, lens) - rays)
    found = np.isfinite(off) & (off < _MOST_OFF)
    return image_points(np.where(found, straight, rays), camera)


def _outlines(scene: Scene, corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the outline of a panel with these corners, without and with distortion, by points."""
    lens = scene.lens, *geometry_of(scene.camera), blur_of(scene)
    key = "outlines", corners.tobytes(), *lens
    return MEMORY.recall(key, lambda: _traced(scene, corners), tuple)


def _traced(scene: Scene, corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Trace both outlines, cut off beyond all light in the picture, where equations may fail."""
    camera = scene.camera
    rays = image_rays(corners, camera)
    focal = camera.focal_length_pixels
    corner = (math.hypot(camera.rows, camera.columns) / 2 + 1.0) / focal
    needed = corner + 4.0 * blur_of(scene) / focal
    view = _view(scene.lens, corner, needed)
    if np.hypot(*rays.T).max() > view.radius:
        rays = clipped(rays, view.rim)
    if len(rays) == 0:
        rays = np.full((3, 2), 2.0 * view.radius)  # a panel without area, outside the picture
        return image_points(rays, camera), image_points(rays, camera)
    rays = subdivided(rays, _parts(rays, scene))
    bent = distorted(rays, scene.lens)
    # A panel that extends beyond the fold is continued as far as light can reach the picture.
    beyond = np.hypot(*rays.T) >= view.radius
    far = np.maximum(needed / np.hypot(*bent[beyond].T), 1.0)
    bent[beyond] *= far[:, None]
    return image_points(rays, camera), image_points(bent, camera)


def _parts(rays: FloatArray, scene: Scene) -> IndexArray:
    """Return the number of parts that each edge of a polygon is divided into."""
    halves = subdivided(rays, np.full(len(rays), 2 * _PARTS))
    halves = distorted(halves, scene.lens) * scene.camera.focal_length_pixels
    starts, middles = halves[::2], halves[1::2]
    off = np.hypot(*(middles - (starts + np.roll(starts, -1, axis=0)) / 2.0).T)
    # The distance from the curve falls with the square of the number of parts.
    wanted = _PARTS * np.sqrt(off.reshape(len(rays), _PARTS).max(axis=1) / _CURVE_TOLERANCE)
    parts: IndexArray = np.ceil(np.clip(wanted, _PARTS, _MOST_PARTS)).astype(np.int64)
    return parts


@dataclass(frozen=True, eq=False, slots=True)
class _View:
    """The rays that can reach the picture: their radius, and a polygon to clip by."""

    radius: float
    rim: FloatArray


@lru_cache(maxsize=16)
def _view(lens: Lens, corner: float, needed: float) -> _View:
    """Find the rays that are pictured up to ``needed`` focal lengths from the centre.

    Where the lens folds before that, they end at the fold; before the picture's ``corner`` it is a
    ProjectionError.
    """
    angle = 2.0 * math.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    radii = np.union1d(_RADII * corner, _RADII * needed)
    rays = radii[:, None, None] * circle
    folded = np.asarray((_area_scale(rays, lens) <= 0.0).any(axis=1))
    far = np.hypot(*np.moveaxis(distorted(rays, lens), -1, 0)).min(axis=1)
    last = int(np.argmax(far >= needed)) if (far >= needed).any() else len(radii) - 2
    if folded[: last + 2].any():
        last = int(np.argmax(folded)) - 2
    if last < 0 or far[last] < corner:
        raise ProjectionError(
            f"A lens with k_1 = {lens.radial_k1:g}, k_2 = {lens.radial_k2:g}, "
            f"p_1 = {lens.tangential_p1:g} and p_2 = {lens.tangential_p2:g} folds the picture back "
            "before its corners are reached; bring them nearer to 0.",
            parameters=("radial_k1", "radial_k2", "tangential_p1", "tangential_p2"),
        )
    radius = float(radii[last])
    # The rays that a lens without distortion would need are included: an estimate compares both.
    kept = max(radius, needed)
    return _View(radius, circle * kept / math.cos(math.pi / _DIRECTIONS))


def _area_scale(rays: FloatArray, lens: Lens) -> FloatArray:
    """Return the magnification of area at each ray; 0 or less where the picture folds."""
    x, y = rays[..., 0], rays[..., 1]
    square = x * x + y * y
    k1, k2, p1, p2 = lens.radial_k1, lens.radial_k2, lens.tangential_p1, lens.tangential_p2
    radial, slope = 1.0 + square * (k1 + k2 * square), 2.0 * (k1 + 2.0 * k2 * square)
    along_x = radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x
    along_y = radial + slope * y * y + 2.0 * p2 * x + 6.0 * p1 * y
    across = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y
    return np.asarray(along_x * along_y - across * across)


def clipped(polygon: FloatArray, window: FloatArray) -> FloatArray:
    """Clip a polygon by a convex one whose corners, (corners, 2), are in counter-clockwise order.

    Edge by edge of the window, the part outside is removed (I. E. Sutherland and
    G. W. Hodgman, "Reentrant polygon clipping", Comm. ACM 17, 1974).
    """
    for start, end in zip(window, np.roll(window, -1, axis=0), strict=True):
        if len(polygon) == 0:
            break
        edge = end - start
        # Above 0 inside.
        side = edge[0] * (polygon[:, 1] - start[1]) - edge[1] * (polygon[:, 0] - start[0])
        if (side >= 0.0).all():
            continue
        polygon = part_inside(polygon, side)
    return polygon


def part_inside(polygon: FloatArray, side: FloatArray) -> FloatArray:
    """Return the part of a polygon where a number, linear between its corners, is not negative."""
    kept = []
    for here in range(len(polygon)):
        there = (here + 1) % len(polygon)
        if side[here] >= 0.0:
            kept.append(polygon[here])
        if (side[here] >= 0.0) != (side[there] >= 0.0):
            fraction = side[here] / (side[here] - side[there])
            kept.append(polygon[here] * (1.0 - fraction) + polygon[there] * fraction)
    return np.array(kept, dtype=np.float64).reshape(-1, polygon.shape[1])


def subdivided(polygon: FloatArray, parts: IndexArray) -> FloatArray:
    """Divide each edge of a polygon, from its corner to the next, into so many equal parts."""
    edge = np.repeat(np.arange(len(polygon)), parts)
    before = np.cumsum(parts) - parts
    fraction = ((np.arange(len(edge)) - before[edge]) / parts[edge])[:, None]
    following = np.roll(polygon, -1, axis=0)
    return np.asarray(polygon[edge] * (1.0 - fraction) + following[edge] * fraction)
