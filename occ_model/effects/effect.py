"""A scene as the paper models it, and the interface of an effect that this model lacks.

Simulations start from the paper's view of a scene, and so do the estimates of what effects change.

An effect belongs to one stage of the light's path from the panel to the file. It says whether a
scene has it (``is_present``), and simulates it (``apply``). :mod:`occ_model.effects.estimates`
applies it to a sample of the pixels, to estimate how much is lost without it.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import ClassVar, Literal, TypeAlias

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import (
    FLAT_SPAN,
    WHITE,
    ColumnLight,
    panel_values,
)
from occ_model.camera.pixel_noise import PixelNoise
from occ_model.camera.projection import panel_corners
from occ_model.results.decoding import Region
from occ_model.results.frame import Stage
from occ_model.scene.colour_scenes import check_monochrome
from occ_model.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class PaperView:
    """The picture of a scene by the paper's model; it follows from the scene and the corners."""

    scene: Scene
    corner_bytes: bytes  # The corners as bytes, to compare views by
    corners: FloatArray = field(compare=False)  # (column, row) of each of the panel's four

    light: ColumnLight = field(compare=False)
    values: FloatArray = field(compare=False)
    """Pixel value of each column on the panel before saturation."""

    sides: tuple[float, float, float, float] | None = field(compare=False)
    """Left, top, right and bottom of a panel whose image is an upright rectangle, else None."""

    is_visible: bool = field(compare=False)  # Whether any part of the panel is in the image

    region: Region = field(compare=False)
    """The panel's bounding rectangle in the image; the whole image if no panel is in it."""

    swing: float = field(compare=False)
    """Largest minus smallest column value, at least one grey level."""


def paper_view_of(
    scene: Scene, end_stage: Callable[[str], object] = lambda _stage: None
) -> PaperView:
    """Compute the paper's view of a scene: one projection and one exposure.

    ``end_stage`` is called with the name of each stage at its end.
    """
    check_monochrome(scene)
    corners = panel_corners(scene)
    corner_bytes = corners.tobytes()
    rows, columns = scene.camera.rows, scene.camera.columns
    sides, region = _outline_of(corner_bytes, rows, columns)
    end_stage("projection")
    light = ColumnLight.of(scene)
    values = panel_values(scene, light)
    end_stage("exposure")
    lowest, highest = (min(max(float(end), 0.0), WHITE) for end in (values.min(), values.max()))
    return PaperView(
        scene=scene,
        corner_bytes=corner_bytes,
        corners=corners,
        light=light,
        values=values,
        sides=sides,
        is_visible=region is not None,
        region=region or Region(0, rows, 0, columns),
        swing=max(highest - lowest, FLAT_SPAN),
    )


@lru_cache(maxsize=16)
def _outline_of(
    corners: bytes, rows: int, columns: int
) -> tuple[tuple[float, float, float, float] | None, Region | None]:
    """Return the sides and the region of a panel, cached while its corners stay the same."""
    places = np.frombuffer(corners).reshape(-1, 2)
    return _sides(places), region_of(places, rows, columns)


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


Kind: TypeAlias = Literal["column", "noise", "image"]
"""Whether the rows stay equal, stay equal except for independent noise, or become different."""


@dataclass(frozen=True, slots=True)
class Cost:
    """Computing time of an effect: seconds for a picture, and for a million of its pixels."""

    picture: float = 0.0
    pixels: float = 0.0


class Effect(ABC):
    name: ClassVar[str]  # Its identifier, as in a plan
    label: ClassVar[str]  # Its usual name in the field, as on screen
    kind: ClassVar[Kind]  # What it does to the rows of a picture
    stage: ClassVar[Stage]  # Where on the light's path it happens
    parameters: ClassVar[tuple[str, ...]]  # Names of the scene's parameters that it depends on

    cost: ClassVar[Cost] = Cost()
    """Measured computing time of the effect alone; see :mod:`occ_model.effects.effect_sets`."""

    @abstractmethod
    def is_present(self, scene: Scene) -> bool:
        """Return whether a scene has the effect; if not, applying it changes exactly nothing."""


class LightEffect(Effect):
    """An effect on the light that reaches each column."""

    kind = "column"
    stage = "light"

    @abstractmethod
    def apply(self, scene: Scene, light: ColumnLight) -> ColumnLight:
        """Add the effect to the columns' light."""

    def sets_panel_light(self, scene: Scene) -> bool:  # noqa: ARG002 - of most it is unchanged
        """Return whether :meth:`apply_to_images` computes the panel's light anew."""
        return False

    @abstractmethod
    def apply_to_images(
        self,
        scene: Scene,
        light: ColumnLight,
        start_times: Sequence[float],
        phases: Sequence[float],
    ) -> ColumnLight:
        """Add the effect to the light of several images, shape (images, columns).

        They differ in start time and in the phase of the mains.
        """


class OpticsEffect(Effect):
    """An effect of the lens on the panel's place and brightness in the picture."""

    kind = "image"
    stage = "optics"

    @abstractmethod
    def apply(self, scene: Scene, optics: Optics) -> Optics:
        """Add the effect to the panel's optics."""


class NoiseEffect(Effect):
    """Noise of the electrons of single pixels, independent from pixel to pixel."""

    kind = "noise"
    stage = "sensor"

    @abstractmethod
    def apply(self, scene: Scene, noise: PixelNoise) -> PixelNoise:
        """Add the effect to the noise of a sensor's pixels."""
