"""Vignetting: the picture is darker towards its corners."""

from dataclasses import replace

import cv2
import numpy as np

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.optics import Gain, Optics
from occ_model.camera.projection import geometry_of, pixel_rays
from occ_model.effects.effect import Cost, OpticsEffect
from occ_model.scene.scene import Scene


class Vignetting(OpticsEffect):
    """The light at a pixel falls as cos^n of its angle off the optical axis.

    n = 4 is the natural fall-off of a thin lens that keeps straight lines straight (W. J. Smith,
    *Modern Optical Engineering*); lenses corrected for it have less. On the axis nothing
    is lost. The angle is that of a lens without distortion.
    """

    name = "vignetting"
    label = "Vignetting"
    parameters = ("vignetting_exponent",)
    cost = Cost(pixels=1.2e-3)

    def is_present(self, scene: Scene) -> bool:
        """Return whether the light falls off at all."""
        return scene.lens.vignetting_exponent != 0.0

    def apply(self, scene: Scene, optics: Optics) -> Optics:
        """Darken every pixel by its angle."""
        power = -scene.lens.vignetting_exponent / 2.0

        across, _ = pixel_rays(scene.camera, np.zeros(1))
        across = 1.0 + across * across

        def gain(rows: FloatArray, columns: slice) -> Pixels:
            _, y = pixel_rays(scene.camera, rows)
            return np.asarray(cv2.pow(across[:, columns] + y * y, power), dtype=np.float32)

        own = Gain.remembered(self.name, (power, *geometry_of(scene.camera)), gain)
        return replace(optics, transmission=(*optics.transmission, own))
