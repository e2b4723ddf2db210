"""Projecting the panel onto the image, and painting the image."""

from functools import lru_cache

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray, Pixels
from occ_model.camera.coverage import column_spans
from occ_model.errors import ProjectionError
from occ_model.scene.scene import Camera, Pose, Scene
from occ_model.scene.units import METRE

MAX_PIXELS = 170_000_000  # of the largest image made or read, as a larger one could fill the memory
_MIN_RELATIVE_DEPTH = 1e-6
"""Depth, as a fraction of the distance, below which a corner counts as beside the camera.

Depth is a difference of two numbers; a smaller one has too few exact digits.
"""


def panel_corners(scene: Scene) -> FloatArray:
    """Project the panel's corners onto the image.

    Without offsets, the optical axis meets the panel's centre. The centre of the pixel in row ``r``
    and column ``c`` has the coordinates (c, r).

    Returns
    -------
    ndarray of float64, shape (4, 2)
        (column, row) of each corner, in order around the panel.

    Raises
    ------
    ProjectionError
        Part of the panel is beside or behind the camera.
    """
    size = scene.transmitter.panel_width, scene.transmitter.panel_height
    return image_points(_corner_rays(scene.pose, *size), scene.camera)


@lru_cache(maxsize=16)
def _corner_rays(pose: Pose, width: float, height: float) -> FloatArray:
    """Return the rays (x, y) to the panel's corners, in focal lengths, shape (4, 2)."""
    x, y = width / 2, height / 2
    corners = np.array([[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]])
    points = corners @ rotation_of(pose).T + [pose.offset_x, pose.offset_y, pose.distance]
    nearest = float(points[:, 2].min())
    if nearest <= pose.distance * _MIN_RELATIVE_DEPTH:
        place = f"{METRE.format(-nearest)} behind" if nearest < 0.0 else "beside"
        raise ProjectionError(
            f"With these angles at a distance of {METRE.format(pose.distance)}, part of the panel "
            f"is {place} the camera; move it away or turn it back.",
            parameters=("distance", "yaw", "pitch"),
        )
    return np.asarray(points[:, :2] / points[:, 2:])


def image_points(rays: FloatArray, camera: Camera) -> FloatArray:
    """Return where rays (x, y), in focal lengths, meet the image, as (column, row)."""
    return np.asarray(rays * camera.focal_length_pixels + _centre(camera))


def image_rays(points: FloatArray, camera: Camera) -> FloatArray:
    """Return the rays (x, y), in focal lengths, to points (column, row) of the image."""
    return np.asarray((points - _centre(camera)) / camera.focal_length_pixels)


def pixel_rays(camera: Camera, rows: FloatArray) -> tuple[Pixels, Pixels]:
    """Return x, shape (1, columns), and y, shape (rows, 1), of pixels' rays in focal lengths."""
    column, row = _centre(camera)
    x = (np.arange(camera.columns) - column) / camera.focal_length_pixels
    y = (rows - row) / camera.focal_length_pixels
    return x.astype(np.float32)[None, :], y.astype(np.float32)[:, None]


def geometry_of(camera: Camera) -> tuple[int, int, float]:
    return camera.rows, camera.columns, camera.focal_length_pixels


def _centre(camera: Camera) -> FloatArray:
    return np.array([(camera.columns - 1) / 2, (camera.rows - 1) / 2])


def rotation_of(pose: Pose) -> FloatArray:
    """Return the rotation about the columns axis, then the rows axis, then the optical axis."""
    return rotations(*(np.array(angle) for angle in (pose.yaw, pose.pitch, pose.roll)))


def rotations(yaw: FloatArray, pitch: FloatArray, roll: FloatArray) -> FloatArray:
    """Return the matrices of :func:`rotation_of` for many angles, shape (*angles, 3, 3)."""
    angles = (pitch, yaw, roll)
    (sx, cx), (sy, cy), (sz, cz) = ((np.sin(angle), np.cos(angle)) for angle in angles)
    one, zero = np.ones_like(sx), np.zeros_like(sx)
    about_x = np.array([[one, zero, zero], [zero, cx, -sx], [zero, sx, cx]])
    about_y = np.array([[cy, zero, sy], [zero, one, zero], [-sy, zero, cy]])
    about_z = np.array([[cz, -sz, zero], [sz, cz, zero], [zero, zero, one]])
    x, y, z = (np.moveaxis(about, (0, 1), (-2, -1)) for about in (about_x, about_y, about_z))
    return np.asarray(z @ y @ x, dtype=np.float64)


def row_spans(corners: FloatArray, rows: int, columns: int) -> tuple[IndexArray, IndexArray]:
    """Return each row's first column inside a convex polygon, and the column after the last.

    They are equal if the row has none. ``corners`` are (column, row), in order.

    A pixel is inside if its centre is, or if that is on the left or upper rim, so that it belongs
    to only one of two adjacent panels. Corners may be at any distance outside the image.
    """
    return column_spans(corners[:, ::-1], columns, rows)


def check_size(camera: Camera) -> None:
    rows, columns = camera.rows, camera.columns
    if rows * columns > MAX_PIXELS:
        raise ProjectionError(
            f"An image of {rows} rows and {columns} columns has {rows * columns / 1e6:.0f} million "
            f"pixels; allowed: up to {MAX_PIXELS // 1_000_000} million.",
            parameters=("rows", "columns"),
        )


def paint(
    enhanced: ByteArray, corners: FloatArray, rows: range, surroundings: ByteArray
) -> ByteArray:
    """Paint the image: the profile in every row of the panel, and the surroundings beside it."""
    columns = len(enhanced)
    spans = row_spans(corners, rows.stop, columns)
    first, last = (ends[rows.start :: rows.step] for ends in spans)
    image = np.empty((len(rows), columns), dtype=np.uint8)
    # Rows with the same span are painted as one block; an upright panel is a single block.
    changes = np.flatnonzero((first[1:] != first[:-1]) | (last[1:] != last[:-1])) + 1
    starts = [0, *changes.tolist()]
    for top, bottom in zip(starts, [*starts[1:], len(rows)], strict=True):
        a, b = int(first[top]), int(last[top])
        block = image[top:bottom]
        block[:, :a] = surroundings[:a]
        block[:, a:b] = enhanced[a:b]
        block[:, b:] = surroundings[b:]
    return image
