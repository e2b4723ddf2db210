"""No two pixels have quite the same gain."""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.sensor import deviation
from occ_model.effects.effect import NoiseEffect
from occ_model.effects.noise_bound import noise_bound
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable


class FixedPattern(NoiseEffect):
    """Photo response non-uniformity: each pixel's gain differs from the mean by a share p.

    n electrons become n (1 + p z), z standard normal and the same in every picture that the camera
    takes (J. R. Janesick, *Photon Transfer*, 2007).
    """

    name = "fixed-pattern"
    label = "Fixed-pattern gain"
    parameters = ("gain_variation",)
    of_the_camera = True

    def bound(self, scene: Scene, observable: Observable) -> float:
        """Give the pattern itself, over the observed columns, and over the rows of each."""
        return noise_bound(self, scene, observable) if scene.sensor.gain_variation else 0.0

    def spread(self, scene: Scene, values: FloatArray) -> FloatArray:
        """Give the standard deviation of pixels with these mean values."""
        share = scene.sensor.gain_variation
        return deviation(values, scene, lambda electrons: np.asarray((share * electrons) ** 2))
