"""A scene as the paper models it, without any effect: where the panel is, and how bright.

Simulations start from it, and so do the estimates of what each effect changes.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import (
    FLAT_SPAN,
    WHITE,
    ColumnLight,
    panel_values,
)
from occ_model.camera.projection import panel_corners
from occ_model.results.decoding import Region
from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class PaperView:
    """The picture of a scene by the paper's model; it follows from the scene and the corners."""

    scene: Scene
    corner_bytes: bytes  # The corners as bytes, by which views are compared
    corners: FloatArray = field(compare=False)  # (column, row) of each of the panel's four

    light: ColumnLight = field(compare=False)
    values: FloatArray = field(compare=False)
    """Pixel value of each column on the panel before saturation."""

    sides: tuple[float, float, float, float] | None = field(compare=False)
    """Left, top, right and bottom of a panel whose image is an upright rectangle, else None."""

    is_seen: bool = field(compare=False)  # Whether any part of the panel is in the image

    region: Region = field(compare=False)
    """The panel's bounding rectangle in the image; the whole image if no panel is in it."""

    swing: float = field(compare=False)
    """Largest minus smallest column value, at least one grey level."""


def paper_view_of(
    scene: Scene, stage_ended: Callable[[str], object] = lambda _stage: None
) -> PaperView:
    """Compute the paper's view of a scene: one projection and one exposure.

    ``end_stage`` is called with the name of each stage at its end.
    """
    corners = panel_corners(scene)
    corner_bytes = corners.tobytes()
    outline = _outline_of(corner_bytes, scene.camera.rows, scene.camera.columns)
    stage_ended("projection")
    light = ColumnLight.of(scene)
    values = panel_values(scene, light)
    stage_ended("exposure")
    lowest, highest = (min(max(float(end), 0.0), WHITE) for end in (values.min(), values.max()))
    region = outline.region
    return PaperView(
        scene=scene,
        corner_bytes=corner_bytes,
        corners=corners,
        light=light,
        values=values,
        sides=outline.sides,
        is_seen=outline.is_seen,
        region=region,
        swing=max(highest - lowest, FLAT_SPAN),
    )


@dataclass(frozen=True, eq=False, slots=True)
class _Outline:
    sides: tuple[float, float, float, float] | None
    is_seen: bool
    region: Region


@lru_cache(maxsize=16)
def _outline_of(corners: bytes, rows: int, columns: int) -> _Outline:
    """Return what follows from the corners alone, cached while pose and lens stay."""
    places = np.frombuffer(corners).reshape(-1, 2)
    seen = region_of(places, rows, columns)
    region = seen or Region(0, rows, 0, columns)
    return _Outline(_sides(places), seen is not None, region)


def _sides(corners: FloatArray) -> tuple[float, float, float, float] | None:
    columns, rows = corners.T.tolist()
    left, top, right, bottom = min(columns), min(rows), max(columns), max(rows)
    slack = 1e-6 * max(right - left, bottom - top, 1.0)
    upright = all(min(column - left, right - column) < slack for column in columns)
    level = all(min(row - top, bottom - row) < slack for row in rows)
    return (left, top, right, bottom) if upright and level else None


def region_of(corners: FloatArray, rows: int, columns: int) -> Region | None:
    """Return the bounding rectangle in the image of (column, row) corners, None if it is empty."""
    across, down = corners.T.tolist()
    left, right = (_first_pixel(end(across), columns) for end in (min, max))
    top, bottom = (_first_pixel(end(down), rows) for end in (min, max))
    if left >= right or top >= bottom:
        return None
    return Region(top, bottom, left, right)


def _first_pixel(place: float, size: int) -> int:
    return math.ceil(min(max(place, 0.0), float(size)))
