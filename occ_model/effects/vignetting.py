"""The picture is darker towards its corners."""

import math
from dataclasses import replace

import cv2
import numpy as np

from occ_model.arrays import Pixels
from occ_model.camera.optics import Gain, Optics
from occ_model.camera.projection import pixel_rays
from occ_model.effects.effect import OpticsEffect
from occ_model.effects.paper_view import off_axis_factor, reachable_luminances, shown_value
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable


class Vignetting(OpticsEffect):
    """The light at a pixel falls as cos^n of its angle off the optical axis.

    n = 4 is the natural fall-off of a thin lens that keeps straight lines straight (W. J. Smith,
    *Modern Optical Engineering*); lenses that are made against it have less. On the axis nothing
    is lost. The angle is that of a lens without distortion.
    """

    name = "vignetting"
    label = "Vignetting"
    parameters = ("vignetting_exponent",)

    def bound(self, scene: Scene, observable: Observable) -> float:  # noqa: ARG002 - not averaged out
        """Bound the change by that of a lit column in the observed rectangle's farthest corner."""
        exponent = scene.lens.vignetting_exponent
        if exponent == 0.0:
            return 0.0
        lost = -math.expm1(exponent / scene.camera.gamma * math.log(off_axis_factor(scene)))
        # What lies above saturation loses less that is seen: most is lost from just there.
        brightest = shown_value(reachable_luminances(scene)[1], scene)
        return brightest * lost

    def apply(self, scene: Scene, optics: Optics) -> Optics:
        """Darken every pixel by its angle."""
        power = -scene.lens.vignetting_exponent / 2.0

        def gain(first: int, last: int) -> Pixels:
            x, y = pixel_rays(scene.camera, first, last)
            return np.asarray(cv2.pow(1.0 + x * x + y * y, power), dtype=np.float32)

        return replace(optics, transmission=(*optics.transmission, Gain(self.name, gain)))
