"""Noise of the light itself and of reading it out."""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.sensor import converter_step, deviation
from occ_model.effects.effect import NoiseEffect
from occ_model.effects.noise_bound import noise_bound
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable


class SensorNoise(NoiseEffect):
    """Shot noise, read noise and the converter's rounding.

    A pixel that holds n electrons in the mean varies by n + r^2 + q^2 / 12: the photons' own
    number, the read noise r and a converter of steps q (J. R. Janesick, *Photon Transfer*, 2007).
    The distribution is taken as normal, which Poisson's is from some ten electrons on.
    """

    name = "sensor-noise"
    label = "Shot and read noise"
    parameters = ("pixel_pitch", "quantum_efficiency", "read_noise", "adc_bits")

    def bound(self, scene: Scene, observable: Observable) -> float:
        """Give the noise itself, over the observed columns, and over the rows of each."""
        return noise_bound(self, scene, observable)

    def spread(self, scene: Scene, values: FloatArray) -> FloatArray:
        """Give the standard deviation of pixels with these mean values."""
        constant = scene.sensor.read_noise**2 + converter_step(scene) ** 2 / 12.0
        return deviation(values, scene, lambda electrons: np.asarray(electrons + constant))
