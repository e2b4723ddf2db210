"""Polygons: clip one by another, and divide their edges."""

import numpy as np

from occ_model.arrays import FloatArray, IndexArray


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
        polygon = _inside(polygon, side)
    return polygon


def _inside(polygon: FloatArray, side: FloatArray) -> FloatArray:
    kept = []
    for here in range(len(polygon)):
        there = (here + 1) % len(polygon)
        if side[here] >= 0.0:
            kept.append(polygon[here])
        if (side[here] >= 0.0) != (side[there] >= 0.0):
            share = side[here] / (side[here] - side[there])
            kept.append(polygon[here] * (1.0 - share) + polygon[there] * share)
    return np.array(kept, dtype=np.float64).reshape(-1, 2)


def subdivided(polygon: FloatArray, parts: IndexArray) -> FloatArray:
    """Divide the edge of a polygon from each corner to the next into so many equal parts."""
    edge = np.repeat(np.arange(len(polygon)), parts)
    before = np.cumsum(parts) - parts
    share = ((np.arange(len(edge)) - before[edge]) / parts[edge])[:, None]
    following = np.roll(polygon, -1, axis=0)
    return np.asarray(polygon[edge] * (1.0 - share) + following[edge] * share)
