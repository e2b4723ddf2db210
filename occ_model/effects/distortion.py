"""Lens distortion: it bends the panel's outline, but not the stripes.

The shutter makes a stripe out of all pixels of a column, so that it stays straight behind any lens.
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
from occ_model.scene.scene import Camera, Lens, Scene

_PARTS = 64  # fewest straight parts into which each edge of the panel is divided
_MOST_PARTS = 1024  # most parts
_CURVE_TOLERANCE = 0.01  # largest distance in pixels of a straight part from the curve
_DIRECTIONS = 64  # directions in which to search for a fold of the image

_MOST_STEPS = 30  # Newton steps of the inverse distortion; 22,000 varied lenses needed at most 14
_ROUNDING = 1e-15  # rounding error of the inverse, as a fraction of the half diagonal
_LARGEST_ERROR = 1e-12  # largest error of the inverse, as a fraction of the half diagonal

_RADII = np.linspace(0.0, 4.0, 129)[1:]
"""Radii at which to search for a fold, in multiples of the corner's radius and of the radius that
blurred light reaches."""


class Distortion(OpticsEffect):
    """Radial and tangential distortion of the panel's outline.

    A ray (x, y) in focal lengths, with r^2 = x^2 + y^2, is pictured at
    x (1 + k1 r^2 + k2 r^4) + 2 p1 x y + p2 (r^2 + 2 x^2), and alike for y with p1 and p2 exchanged
    (D. C. Brown, "Decentering distortion of lenses", Photogrammetric Engineering 32, 1966).
    """

    name = "distortion"
    label = "Lens distortion"
    parameters = ("radial_k1", "radial_k2", "tangential_p1", "tangential_p2")
    cost = Cost(picture=1.2e-3)

    def is_present(self, scene: Scene) -> bool:
        return scene.lens.distorts

    def apply(self, scene: Scene, optics: Optics) -> Optics:
        """Bend the panel's outline; ProjectionError if the lens folds the picture's corners."""
        if not self.is_present(scene):
            return optics
        return replace(optics, outline=_outlines(scene, optics.outline)[1], cover_stage=self.name)


def distort(rays: FloatArray, lens: Lens) -> FloatArray:
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


def undistort(points: FloatArray, scene: Scene) -> FloatArray:
    """Return where a lens without distortion would show points (column, row) of the picture.

    The result is exact to rounding, by Newton's method from the picture's middle. A point outside
    the picture that no ray reaches becomes not a number.

    Raises
    ------
    ProjectionError
        The lens folds the picture before its corners.
    """
    lens, camera = scene.lens, scene.camera
    if not lens.distorts:
        return points
    corner = _corner_radius(camera)
    radius = _find_visible_rays(lens, corner, corner).radius
    rays = image_rays(points, camera)
    straight = np.zeros_like(rays)
    for _ in range(_MOST_STEPS):
        error = rays - distort(straight, lens)
        if np.abs(error).max(initial=0.0) <= _ROUNDING * corner:
            break
        along_x, along_y, across = _slopes(straight, lens)
        area = along_x * along_y - across * across
        x, y = error[..., 0] / area, error[..., 1] / area
        straight = straight + np.stack([along_y * x - across * y, along_x * y - across * x], -1)
        # Within this radius the lens does not fold.
        distance = np.hypot(straight[..., 0], straight[..., 1])
        straight *= np.minimum(1.0, radius / np.maximum(distance, radius))[..., None]
    error = np.abs(rays - distort(straight, lens)).max(axis=-1, keepdims=True)
    return image_points(np.where(error <= _LARGEST_ERROR * corner, straight, np.nan), camera)


def undistort_frame(scene: Scene) -> FloatArray:
    """Return where a lens without distortion shows the picture's rim, in order round it.

    The shape is (points, 2), (column, row) of each; ProjectionError as for :func:`undistort`.
    """
    right, bottom = scene.camera.columns - 1.0, scene.camera.rows - 1.0
    corners = np.array([[0.0, 0.0], [right, 0.0], [right, bottom], [0.0, bottom]])
    if not scene.lens.distorts:
        return corners
    return undistort(subdivide(corners, np.full(4, _PARTS)), scene)


def _outlines(scene: Scene, corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return points of the outline of a panel with these corners, without and with distortion."""
    lens = scene.lens, *geometry_of(scene.camera), blur_of(scene)
    key = "outlines", corners.tobytes(), *lens
    return MEMORY.recall(key, lambda: _trace_outlines(scene, corners), tuple)


def _trace_outlines(scene: Scene, corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Trace both outlines as far as light can reach the picture; farther out may be a fold."""
    camera = scene.camera
    rays = image_rays(corners, camera)
    focal = camera.focal_length_pixels
    corner = _corner_radius(camera)
    needed = corner + 4.0 * blur_of(scene) / focal
    view = _find_visible_rays(scene.lens, corner, needed)
    if np.hypot(*rays.T).max() > view.radius:
        rays = clip_polygon(rays, view.rim)
    if len(rays) == 0:
        rays = np.full((3, 2), 2.0 * view.radius)  # a panel of no area, outside the picture
        return image_points(rays, camera), image_points(rays, camera)
    rays = subdivide(rays, _count_parts(rays, scene))
    bent = distort(rays, scene.lens)
    # A panel that extends beyond the fold continues as far as light can still reach the picture.
    beyond = np.hypot(*rays.T) >= view.radius
    scale = np.maximum(needed / np.hypot(*bent[beyond].T), 1.0)
    bent[beyond] *= scale[:, None]
    return image_points(rays, camera), image_points(bent, camera)


def _corner_radius(camera: Camera) -> float:
    """Return how far a pixel beyond the picture's corner is from its middle, in focal lengths."""
    return (math.hypot(camera.rows, camera.columns) / 2 + 1.0) / camera.focal_length_pixels


def _count_parts(rays: FloatArray, scene: Scene) -> IndexArray:
    """Return the number of parts that each edge of a polygon is divided into."""
    halves = subdivide(rays, np.full(len(rays), 2 * _PARTS))
    halves = distort(halves, scene.lens) * scene.camera.focal_length_pixels
    starts, middles = halves[::2], halves[1::2]
    distance = np.hypot(*(middles - (starts + np.roll(starts, -1, axis=0)) / 2.0).T)
    # The distance from the curve falls as the square of the number of parts.
    wanted = _PARTS * np.sqrt(distance.reshape(len(rays), _PARTS).max(axis=1) / _CURVE_TOLERANCE)
    parts: IndexArray = np.ceil(np.clip(wanted, _PARTS, _MOST_PARTS)).astype(np.int64)
    return parts


@dataclass(frozen=True, eq=False, slots=True)
class _VisibleRays:
    """The rays that can reach the picture: their largest radius, and a polygon to clip by."""

    radius: float
    rim: FloatArray


@lru_cache(maxsize=16)
def _find_visible_rays(lens: Lens, corner: float, needed: float) -> _VisibleRays:
    """Find the rays that are pictured up to ``needed`` focal lengths from the centre.

    If the lens folds the image before that radius, they end at the fold; a fold before the
    picture's ``corner`` is a ProjectionError.
    """
    if needed > corner:
        _find_visible_rays(lens, corner, corner)  # refuse a lens whatever the blur
    angle = 2.0 * math.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    radii = np.union1d(_RADII * corner, _RADII * needed)
    rays = radii[:, None, None] * circle
    bent = distort(rays, lens)
    # A ray whose image is on the other side of the middle lies beyond a fold.
    reversed_rays = (bent * rays).sum(axis=-1) <= 0.0
    folded = np.asarray((reversed_rays | (_area_scale(rays, lens) <= 0.0)).any(axis=1))
    distances = np.hypot(*np.moveaxis(bent, -1, 0)).min(axis=1)
    last = int(np.argmax(distances >= needed)) if (distances >= needed).any() else len(radii) - 2
    if folded[: last + 2].any():
        last = int(np.argmax(folded)) - 2
    if last < 0 or distances[last] < corner:
        raise ProjectionError(
            f"A lens with k_1 = {lens.radial_k1:g}, k_2 = {lens.radial_k2:g}, "
            f"p_1 = {lens.tangential_p1:g} and p_2 = {lens.tangential_p2:g} folds the picture "
            "before its corners; choose values nearer to 0.",
            parameters=("radial_k1", "radial_k2", "tangential_p1", "tangential_p2"),
        )
    radius = float(radii[last])
    # Include the rays that a lens without distortion would need, since an estimate compares both.
    kept = max(radius, needed)
    return _VisibleRays(radius, circle * kept / math.cos(math.pi / _DIRECTIONS))


def _area_scale(rays: FloatArray, lens: Lens) -> FloatArray:
    """Return the magnification of area at each ray; it is 0 or less where the picture folds."""
    along_x, along_y, across = _slopes(rays, lens)
    return along_x * along_y - across * across


def _slopes(rays: FloatArray, lens: Lens) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the derivatives of :func:`distort`: x by x, y by y, and either by the other."""
    x, y = rays[..., 0], rays[..., 1]
    square = x * x + y * y
    k1, k2, p1, p2 = lens.radial_k1, lens.radial_k2, lens.tangential_p1, lens.tangential_p2
    radial, slope = 1.0 + square * (k1 + k2 * square), 2.0 * (k1 + 2.0 * k2 * square)
    return (
        radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x,
        radial + slope * y * y + 2.0 * p2 * x + 6.0 * p1 * y,
        slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y,
    )


def clip_polygon(polygon: FloatArray, window: FloatArray) -> FloatArray:
    """Clip a polygon by a convex window, whose corners (corners, 2) run counter-clockwise.

    The parts outside the window's edges are removed one by one (I. E. Sutherland and G. W. Hodgman,
    "Reentrant polygon clipping", Comm. ACM 17, 1974).
    """
    for start, end in zip(window, np.roll(window, -1, axis=0), strict=True):
        if len(polygon) == 0:
            break
        edge = end - start
        # It is positive inside the window.
        side = edge[0] * (polygon[:, 1] - start[1]) - edge[1] * (polygon[:, 0] - start[0])
        if (side >= 0.0).all():
            continue
        polygon = part_inside(polygon, side)
    return polygon


def part_inside(polygon: FloatArray, side: FloatArray) -> FloatArray:
    """Return the part of a polygon where ``side``, linear between its corners, is not negative."""
    corners = []
    for index in range(len(polygon)):
        following = (index + 1) % len(polygon)
        if side[index] >= 0.0:
            corners.append(polygon[index])
        if (side[index] >= 0.0) != (side[following] >= 0.0):
            fraction = side[index] / (side[index] - side[following])
            corners.append(polygon[index] * (1.0 - fraction) + polygon[following] * fraction)
    return np.array(corners, dtype=np.float64).reshape(-1, polygon.shape[1])


def subdivide(polygon: FloatArray, parts: IndexArray) -> FloatArray:
    """Divide each edge of a polygon into its number of equal ``parts``."""
    edge = np.repeat(np.arange(len(polygon)), parts)
    first = np.cumsum(parts) - parts
    fraction = ((np.arange(len(edge)) - first[edge]) / parts[edge])[:, None]
    following = np.roll(polygon, -1, axis=0)
    return np.asarray(polygon[edge] * (1.0 - fraction) + following[edge] * fraction)
