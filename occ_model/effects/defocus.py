"""Defocus and point spread: the lens softens the panel's rim, not the stripes.

Inside an evenly bright panel a pixel receives as much light from its neighbours as it loses to
them. The stripes are made by the shutter, behind the lens, and stay sharp.
"""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import pixel_value
from occ_model.effects.effect import OpticsEffect
from occ_model.effects.paper_view import PaperView, reachable_luminances
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable

_REACH = 4.0
"""Standard deviations from the rim beyond which the blur is negligible."""

_WIDEST = 1e12
"""Largest point spread in pixels: any larger one leaves nothing of any panel either."""

_SLACK = 1.1
"""Factor on the rim's integrals, which are computed as sums, to keep the bound above them."""


class Defocus(OpticsEffect):
    """A Gaussian point spread: the lens's own spot, and the circle of confusion out of focus.

    A point at the distance d makes a disc of diameter c = f^2 / N |1/d_f - 1/d| on the sensor of a
    lens of focal length f that is focused on d_f, for d and d_f far beyond f (S. F. Ray, *Applied
    Photographic Optics*). A disc of diameter c has the standard deviation c / 4 along each axis;
    both spots' variances add.
    """

    name = "defocus"
    label = "Defocus and point spread"
    parameters = ("point_spread", "focus_distance", "pixel_pitch")

    def is_present(self, scene: Scene) -> bool:
        """Return whether the image of a point is wider than a point."""
        return blur_of(scene) != 0.0

    def _bound(self, view: PaperView, observable: Observable) -> float:
        """Bound the change by that along the rim of a lit panel."""
        scene, region, sides = view.scene, view.region, view.sides
        blur, largest = blur_of(scene), view.contrast
        if not view.is_seen and not _reaches(view.corners, scene, blur):
            return 0.0
        if _REACH * blur > min(region.rows, region.columns) / 2.0:
            return largest
        both = sides is None or scene.lens.distorts or not view.is_seen
        energy, loss = _rim(view, both)
        if sides is None:
            length = 2.0 * (region.rows + region.columns)
            return min(largest, math.sqrt(length * blur * energy / (region.rows * region.columns)))
        left, top, right, bottom = sides
        columns, rows = scene.camera.columns, scene.camera.rows
        ends = _near(left, columns, blur) + _near(right, columns, blur)
        edges = _near(top, rows, blur) + _near(bottom, rows, blur)
        if both:
            ends = edges = 2
        across = ends * math.sqrt(blur * energy / region.columns)
        if observable == "profile":
            return min(largest, across + edges * blur * loss / region.rows)
        return min(largest, across + edges * math.sqrt(blur * energy / region.rows))

    def apply(self, scene: Scene, optics: Optics) -> Optics:
        """Blur the panel's rim."""
        return replace(optics, blur=blur_of(scene), cover_stage=self.name)


def blur_of(scene: Scene) -> float:
    """Return the standard deviation of the point spread in pixels."""
    camera, lens, distance = scene.camera, scene.lens, scene.pose.distance
    spot = 0.0
    if lens.focus_distance:
        focal = camera.focal_length_pixels
        vergence = abs(1.0 / lens.focus_distance - 1.0 / distance)
        spot = focal * focal * scene.sensor.pixel_pitch / camera.f_number * vergence / 4.0
    return min(math.hypot(lens.point_spread, spot), _WIDEST)


def _reaches(corners: FloatArray, scene: Scene, blur: float) -> bool:
    """Return whether light of a panel beside the picture can reach it."""
    if scene.lens.distorts:
        return True
    reach = _REACH * blur + 1.0
    size = np.array([scene.camera.columns, scene.camera.rows])
    return bool((corners.max(axis=0) > -reach).all() and (corners.min(axis=0) < size + reach).all())


def _near(side: float, size: int, blur: float) -> int:
    """Return 1 where a side of the panel is in the picture or just beside it, 0 where not."""
    reach = _REACH * blur + 1.0
    return int(-reach < side < size + reach)


def _rim(view: PaperView, both: bool) -> tuple[float, float]:
    """Integrate the squared and the absolute change across the rim, in standard deviations.

    Where the observed rectangle ends at the rim, only the panel's side of it counts.
    """
    scene = view.scene
    distance, share = _tail()
    dark, bright = reachable_luminances(scene)
    # On the panel's side columns that are just not saturated, under the strongest vignetting,
    # change most; on the other side the brightest ones do.
    change = np.zeros((2, len(share)))
    for lit in (bright, max(min(bright, view.just_white), dark)):
        light = dark + (lit - dark) * np.stack([1.0 - share, share])
        full = pixel_value(np.array([[lit], [dark]]), scene.camera)
        seen = pixel_value(light, scene.camera)
        moved = view.largest_changes(np.minimum(seen, full), np.maximum(seen, full))
        change = np.maximum(change, moved)
    change = change[: 2 if both else 1]
    step = distance[1]
    return (
        _SLACK * step * float((change**2).sum()),
        _SLACK * step * float(change.sum()),
    )


@lru_cache(maxsize=1)
def _tail() -> tuple[FloatArray, FloatArray]:
    """Return distances from the rim, and the share of the light there from beyond the rim."""
    distance = np.linspace(0.0, _REACH, 33)
    beyond = np.array([0.5 * math.erfc(x / math.sqrt(2.0)) for x in distance.tolist()])
    return distance, beyond
