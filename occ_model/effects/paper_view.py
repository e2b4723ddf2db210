"""What the bounds of all effects are drawn from: where the panel is seen, and how bright.

Everything here is of the paper's model, without any effect; how far the other effects can move the
light is allowed for, so that a bound holds whichever of them are there.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import (
    FLAT,
    WHITE,
    ColumnLight,
    luminance_levels,
    luminance_of,
    panel_values,
    pixel_value,
    saturate,
)
from occ_model.camera.projection import image_rays, panel_corners
from occ_model.results import Region
from occ_model.scene.scene import Camera, Scene

_BINS = 64
"""Steps between the darkest and the brightest column in which columns are counted."""


@dataclass(frozen=True, eq=False, slots=True)
class PaperView:
    """How the panel is seen.

    Parameters
    ----------
    corners : ndarray of float64, shape (4, 2)
        Of the panel in the image.
    sides
        Left, top, right and bottom of a panel that is pictured level and so fills its bounding
        rectangle, None of any other.
    is_seen
        Whether any of the panel is in the image.
    region
        The panel's bounding rectangle in the image; the whole image where no panel is seen.
    corner_rays : ndarray of float64, shape (4, 2)
        Its corners as rays (x, y), in focal lengths.
    swing
        Largest less smallest column value, at least one grey level.
    levels : ndarray of float64, shape (bins + 1,)
        Pixel values before saturation between which columns are counted.
    shares : ndarray of float64, shape (bins,)
        Share of the region's columns between two of them.
    """

    corners: FloatArray
    sides: tuple[float, float, float, float] | None
    is_seen: bool
    region: Region
    corner_rays: FloatArray
    swing: float
    levels: FloatArray
    shares: FloatArray


def _sides(corners: FloatArray) -> tuple[float, float, float, float] | None:
    left, top = corners.min(axis=0).tolist()
    right, bottom = corners.max(axis=0).tolist()
    slack = 1e-6 * max(right - left, bottom - top, 1.0)
    on_rim = (np.abs(corners - (left, top)) < slack) | (np.abs(corners - (right, bottom)) < slack)
    return (left, top, right, bottom) if on_rim.all() else None


@lru_cache(maxsize=16)
def paper_view_of(scene: Scene) -> PaperView:
    """Look at a scene.

    Raises
    ------
    ProjectionError
        Part of the panel is behind the camera.
    """
    corners = panel_corners(scene)
    values = panel_values(scene, ColumnLight.of(scene))
    seen = saturate(values)
    seen_region = region_of(corners, scene.camera.rows, scene.camera.columns)
    region = seen_region or Region(0, scene.camera.rows, 0, scene.camera.columns)
    inside = values[region.first_column : region.last_column]
    low, high = float(inside.min()), float(inside.max())
    # A little beyond both ends, so that no rounding puts a column outside.
    levels = np.linspace(low * (1 - 1e-9), high * (1 + 1e-9) + 1e-9, _BINS + 1)
    step = levels[1] - levels[0]
    counts = np.bincount(((inside - levels[0]) / step).astype(np.int64), minlength=_BINS)
    return PaperView(
        corners=corners,
        sides=_sides(corners),
        is_seen=seen_region is not None,
        region=region,
        corner_rays=_corner_rays(region, scene.camera),
        swing=max(float(seen.max() - seen.min()), FLAT),
        levels=levels,
        shares=counts[:_BINS] / len(inside),
    )


def _corner_rays(region: Region, camera: Camera) -> FloatArray:
    left, right = region.first_column, region.last_column - 1
    top, bottom = region.first_row, region.last_row - 1
    points = np.array([(left, top), (right, top), (right, bottom), (left, bottom)], np.float64)
    return image_rays(points, camera)


def region_of(corners: FloatArray, rows: int, columns: int) -> Region | None:
    """Give the panel's bounding rectangle in the image, None where there is none.

    Parameters
    ----------
    corners : ndarray of float64, shape (corners, 2)
        (column, row) of each corner of the outline.
    rows, columns
        Size of the image.
    """
    left, top = np.clip(np.ceil(corners.min(axis=0)), 0, (columns, rows)).astype(int).tolist()
    right, bottom = np.clip(np.ceil(corners.max(axis=0)), 0, (columns, rows)).astype(int).tolist()
    if left >= right or top >= bottom:
        return None
    return Region(top, bottom, left, right)


def reachable_luminances(scene: Scene) -> tuple[float, float]:
    """Give the least light of the dark panel and the most of the lit one, flicker included."""
    dark, bright = luminance_levels(scene).tolist()
    depth = scene.surroundings.flicker_depth
    return dark * (1.0 - depth), bright + dark * depth


def shown_value(luminance: float, scene: Scene) -> float:
    """Give the pixel value of a luminance, saturated."""
    return min(float(pixel_value(np.array([luminance]), scene.camera)[0]), WHITE)


def shown_change(low: FloatArray, high: FloatArray, scene: Scene) -> FloatArray:
    """Give the most by which pixel values can differ in a picture, in grey levels.

    Vignetting may dim both by the same factor: they differ most where the higher just saturates.

    Parameters
    ----------
    low, high : ndarray of float64
        Before saturation, none of ``high`` below that of ``low``.
    """
    dimmest = dimmest_light(scene) ** (1.0 / scene.camera.gamma)
    dimmed = np.clip(WHITE / np.maximum(high, WHITE), dimmest, 1.0)
    return saturate(dimmed * high) - saturate(dimmed * low)


def contrast(scene: Scene) -> float:
    """Give the most by which the lit panel can differ from its dark surroundings, grey levels."""
    dark, bright = reachable_luminances(scene)
    return largest_change(dark, bright, scene)


def largest_change(dark: float, bright: float, scene: Scene) -> float:
    """Give the most by which two luminances can differ in a picture, in grey levels."""
    low, high = pixel_value(np.array([[dark], [bright]]), scene.camera)
    return float(shown_change(low, high, scene)[0])


def just_white(scene: Scene) -> float:
    """Give the luminance that still reaches the largest pixel value where most light is lost."""
    return float(luminance_of(np.array([WHITE]), scene.camera)[0]) / dimmest_light(scene)


def dimmest_light(scene: Scene) -> float:
    """Give the least share of the light that vignetting leaves in the observed rectangle."""
    exponent = scene.lens.vignetting_exponent
    return off_axis_factor(scene) ** exponent if exponent else 1.0


def off_axis_factor(scene: Scene) -> float:
    """Give cos of the largest angle off the optical axis within the observed rectangle."""
    x, y = np.abs(paper_view_of(scene).corner_rays).max(axis=0).tolist()
    return 1.0 / math.sqrt(1.0 + x * x + y * y)
