"""The paper's view of a scene: where the panel is seen and how bright, without any effect.

A simulation starts from it, and the bounds of all effects are computed from it. The bounds allow
for what the other effects can do to the light, so that each holds whichever of them are there.
"""

import math
from collections.abc import Callable
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
from occ_model.camera.projection import geometry_of, panel_corners, rays_at
from occ_model.results import Region
from occ_model.scene.scene import Scene

_BINS = 64
"""Steps between the darkest and the brightest column in which columns are counted."""


_EDGES = np.arange(_BINS + 1.0)


@dataclass(frozen=True, eq=False, slots=True)
class PaperView:
    """The picture of a scene by the paper's model.

    Parameters
    ----------
    scene
        The scene.
    corners : ndarray of float64, shape (4, 2)
        Of the panel in the image.
    light
        What reaches each column.
    values : ndarray of float64, shape (columns,)
        Pixel value of each column on the panel before saturation.
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

    scene: Scene
    corners: FloatArray
    light: ColumnLight
    values: FloatArray
    sides: tuple[float, float, float, float] | None
    is_seen: bool
    region: Region
    corner_rays: FloatArray
    swing: float
    levels: FloatArray
    shares: FloatArray

    @property
    def off_axis_factor(self) -> float:
        """The cosine of the largest angle off the optical axis within the observed rectangle."""
        x, y = np.abs(self.corner_rays).max(axis=0).tolist()
        return 1.0 / math.sqrt(1.0 + x * x + y * y)

    @property
    def dimmest_light(self) -> float:
        """The least share of the light that vignetting leaves in the observed rectangle."""
        exponent = self.scene.lens.vignetting_exponent
        return self.off_axis_factor**exponent if exponent else 1.0

    @property
    def just_white(self) -> float:
        """The luminance that still reaches the largest pixel value where most light is lost."""
        white = luminance_of(np.array([WHITE]), self.scene.camera)
        return float(white[0]) / self.dimmest_light

    @property
    def contrast(self) -> float:
        """The most by which the lit panel can differ from its dark surroundings, in grey levels."""
        return self.largest_change(*reachable_luminances(self.scene))

    def largest_change(self, dark: float, bright: float) -> float:
        """Return the most by which two luminances can differ in a picture, in grey levels."""
        low, high = pixel_value(np.array([[dark], [bright]]), self.scene.camera)
        return float(self.largest_changes(low, high)[0])

    def largest_changes(self, low: FloatArray, high: FloatArray) -> FloatArray:
        """Return the most by which pixel values can differ in a picture, in grey levels.

        Vignetting may dim both by the same factor: they differ most where the higher just
        saturates.

        Parameters
        ----------
        low, high : ndarray of float64
            Before saturation, none of ``high`` below that of ``low``.
        """
        dimmest = self.dimmest_light ** (1.0 / self.scene.camera.gamma)
        dimmed = np.clip(WHITE / np.maximum(high, WHITE), dimmest, 1.0)
        return saturate(dimmed * high) - saturate(dimmed * low)


def paper_view_of(
    scene: Scene, stage_ended: Callable[[str], object] = lambda _stage: None
) -> PaperView:
    """Compute the paper's view of a scene: one projection and one exposure.

    Parameters
    ----------
    scene
        The scene.
    stage_ended
        Called with the name of each stage that has just ended.

    Raises
    ------
    ProjectionError
        Part of the panel is behind the camera.
    """
    corners = panel_corners(scene)
    outline = _outline_of(corners.tobytes(), *geometry_of(scene.camera))
    stage_ended("projection")
    light = ColumnLight.of(scene)
    values = panel_values(scene, light)
    stage_ended("exposure")
    lowest, highest = (min(max(float(end), 0.0), WHITE) for end in (values.min(), values.max()))
    region = outline.region
    levels, shares = _histogram(values[region.first_column : region.last_column])
    return PaperView(
        scene=scene,
        corners=corners,
        light=light,
        values=values,
        sides=outline.sides,
        is_seen=outline.is_seen,
        region=region,
        corner_rays=outline.corner_rays,
        swing=max(highest - lowest, FLAT),
        levels=levels,
        shares=shares,
    )


@dataclass(frozen=True, eq=False, slots=True)
class _Outline:
    """What follows from the panel's corners: see :class:`PaperView`."""

    sides: tuple[float, float, float, float] | None
    is_seen: bool
    region: Region
    corner_rays: FloatArray


@lru_cache(maxsize=16)
def _outline_of(corners: bytes, rows: int, columns: int, focal_length: float) -> _Outline:
    """Return what follows from the corners, which stay while pose and lens do."""
    places = np.frombuffer(corners).reshape(-1, 2)
    seen = region_of(places, rows, columns)
    region = seen or Region(0, rows, 0, columns)
    rays = _corner_rays(region, rows, columns, focal_length)
    rays.flags.writeable = False
    return _Outline(_sides(places), seen is not None, region, rays)


def _histogram(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return levels from the least value to the greatest, and the share of values between them."""
    low, high = float(values.min()), float(values.max())
    # A little beyond both ends, so that no rounding puts a column outside.
    least = low * (1 - 1e-9)
    step = (high * (1 + 1e-9) + 1e-9 - least) / _BINS
    levels = least + step * _EDGES
    counts = np.bincount(((values - least) * (1.0 / step)).astype(np.int64), minlength=_BINS)
    return levels, counts[:_BINS] / len(values)


def _sides(corners: FloatArray) -> tuple[float, float, float, float] | None:
    columns, rows = corners.T.tolist()
    left, top, right, bottom = min(columns), min(rows), max(columns), max(rows)
    slack = 1e-6 * max(right - left, bottom - top, 1.0)
    upright = all(min(column - left, right - column) < slack for column in columns)
    level = all(min(row - top, bottom - row) < slack for row in rows)
    return (left, top, right, bottom) if upright and level else None


def _corner_rays(region: Region, rows: int, columns: int, focal_length: float) -> FloatArray:
    left, right = region.first_column, region.last_column - 1
    top, bottom = region.first_row, region.last_row - 1
    points = np.array([(left, top), (right, top), (right, bottom), (left, bottom)], np.float64)
    return rays_at(points, rows, columns, focal_length)


def region_of(corners: FloatArray, rows: int, columns: int) -> Region | None:
    """Return the panel's bounding rectangle in the image, None where there is none.

    Parameters
    ----------
    corners : ndarray of float64, shape (corners, 2)
        (column, row) of each corner of the outline.
    rows, columns
        Size of the image.
    """
    across, down = corners.T.tolist()
    left, right = (_first_from(end(across), columns) for end in (min, max))
    top, bottom = (_first_from(end(down), rows) for end in (min, max))
    if left >= right or top >= bottom:
        return None
    return Region(top, bottom, left, right)


def _first_from(place: float, size: int) -> int:
    return math.ceil(min(max(place, 0.0), float(size)))


def reachable_luminances(scene: Scene) -> tuple[float, float]:
    """Return the least light of the dark panel and the most of the lit one, flicker included."""
    dark, bright = luminance_levels(scene).tolist()
    depth = scene.surroundings.flicker_depth
    return dark * (1.0 - depth), bright + dark * depth


def saturated_value(luminance: float, scene: Scene) -> float:
    """Return the pixel value of a luminance, at most the largest one."""
    return min(float(pixel_value(np.array([luminance]), scene.camera)[0]), WHITE)
