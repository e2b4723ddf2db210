"""Bundled emission: a panel that is not Lambertian looks darker from the side."""

from dataclasses import replace

import cv2
import numpy as np

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.optics import Gain, Optics
from occ_model.camera.projection import geometry_of, pixel_rays, rotation_of
from occ_model.effects.effect import Cost, OpticsEffect
from occ_model.scene.scene import Scene


class Emission(OpticsEffect):
    """The panel's intensity falls as cos^m of the angle to its normal.

    Its luminance, the intensity over the area that is seen, falls as cos^(m - 1): a Lambertian
    panel, m = 1, is equally bright from all sides (J. M. Kahn and J. R. Barry, "Wireless infrared
    communications", Proc. IEEE 85, 1997, for the generalized Lambertian source). External
    light that the panel reflects is not changed.
    """

    name = "emission"
    label = "Bundled emission"
    parameters = ("lambertian_order",)
    cost = Cost(pixels=0.8e-3)

    def is_present(self, scene: Scene) -> bool:
        """Return whether the panel is other than Lambertian."""
        return scene.transmitter.lambertian_order != 1.0

    def apply(self, scene: Scene, optics: Optics) -> Optics:
        """Darken the panel by the angle at which each pixel sees it."""
        power = scene.transmitter.lambertian_order - 1.0

        normal = _normal(scene)
        across, _ = pixel_rays(scene.camera, np.zeros(1))

        def gain(rows: FloatArray, columns: slice) -> Pixels:
            _, y = pixel_rays(scene.camera, rows)
            cosines = np.abs(_cosine(normal, across[:, columns], y)).astype(np.float32)
            return np.asarray(cv2.pow(np.minimum(cosines, np.float32(1.0)), power))

        own = Gain.remembered(
            self.name, (power, *normal.tolist(), *geometry_of(scene.camera)), gain
        )
        return replace(optics, emission=(*optics.emission, own))


def _normal(scene: Scene) -> FloatArray:
    """Return the panel's normal, of length 1."""
    return rotation_of(scene.pose)[:, 2]


def _cosine(normal: FloatArray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the cosine of the angle between a normal and rays (x, y, 1), either sign."""
    along = normal[0] * x + normal[1] * y + normal[2]
    return np.asarray(along / np.sqrt(1.0 + x * x + y * y))
