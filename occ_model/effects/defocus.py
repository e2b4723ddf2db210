"""Defocus and point spread: the lens softens the panel's rim, not the stripes.

Inside an evenly bright panel a pixel receives as much light from its neighbours as it loses to
them. The stripes are made by the shutter, behind the lens, and stay sharp.
"""

import math
from dataclasses import replace

from occ_model.camera.optics import Optics
from occ_model.effects.effect import Cost, OpticsEffect
from occ_model.scene.scene import Scene

_WIDEST = 1e12
"""Largest point spread in pixels: any larger one leaves nothing of any panel either."""


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
    cost = Cost(picture=1e-3)

    def is_present(self, scene: Scene) -> bool:
        """Return whether the image of a point is wider than a point."""
        return blur_of(scene) != 0.0

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
