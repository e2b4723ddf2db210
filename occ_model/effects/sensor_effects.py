"""The sensor's effects: full well, fixed-pattern gain, shot and read noise."""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import (
    WHITE,
    converter_step,
    deviation,
    luminance_levels,
    pixel_value,
    saturation_value,
)
from occ_model.effects.effect import Cost, NoiseEffect, PixelEffect, Values
from occ_model.scene.scene import Scene


class FullWell(PixelEffect):
    """A pixel holds at most its full well of electrons; more light does not change it.

    At low ISO speeds the well is full before the pixel value reaches 255.
    """

    name = "full-well"
    label = "Full well"
    parameters = ("full_well",)
    cost = Cost(pixels=0.05e-3)

    def is_present(self, scene: Scene) -> bool:
        """Return whether any column can get more light than fills the well."""
        dark, bright = luminance_levels(scene)
        most = bright + dark * scene.surroundings.flicker_depth
        return min(float(pixel_value(most, scene.camera)), WHITE) > saturation_value(scene)

    def apply(self, scene: Scene, values: Values) -> Values:
        full = np.asarray(saturation_value(scene), dtype=values.dtype)
        return np.minimum(values, full)


class FixedPattern(NoiseEffect):
    """Photo response non-uniformity: each pixel's gain differs from the mean by a fraction p.

    n electrons become n (1 + p z), where z is standard normal and the same in every picture of the
    camera (J. R. Janesick, *Photon Transfer*, 2007).
    """

    name = "fixed-pattern"
    label = "Fixed-pattern gain"
    parameters = ("gain_variation",)
    cost = Cost(pixels=0.2e-3)
    of_the_camera = True

    def is_present(self, scene: Scene) -> bool:
        return scene.sensor.gain_variation != 0.0

    def spread(self, scene: Scene, values: FloatArray) -> FloatArray:
        fraction = scene.sensor.gain_variation
        return deviation(values, scene, lambda electrons: np.asarray((fraction * electrons) ** 2))


class SensorNoise(NoiseEffect):
    """Shot noise, read noise and the converter's rounding.

    A pixel with a mean of n electrons has the variance n + r^2 + q^2 / 12, by shot noise, read
    noise r, and a converter of steps q (J. R. Janesick, *Photon Transfer*, 2007). The distribution
    is taken as normal, as a Poisson distribution nearly is above some ten electrons.
    """

    name = "sensor-noise"
    label = "Shot and read noise"
    parameters = ("pixel_pitch", "quantum_efficiency", "read_noise", "adc_bits")
    cost = Cost(pixels=0.4e-3)

    def is_present(self, scene: Scene) -> bool:  # noqa: ARG002 - light is always there
        """Return True, since all light comes in photons."""
        return True

    def spread(self, scene: Scene, values: FloatArray) -> FloatArray:
        constant = scene.sensor.read_noise**2 + converter_step(scene) ** 2 / 12.0
        return deviation(values, scene, lambda electrons: np.asarray(electrons + constant))
