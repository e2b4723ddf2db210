"""The sensor's effects: full well, fixed-pattern gain, shot and read noise."""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.sensor import converter_step, deviation, saturation_value
from occ_model.effects.effect import NoiseEffect, PixelEffect, Values
from occ_model.effects.noise_bound import noise_bound
from occ_model.effects.paper_view import reachable_luminances, shown_value
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable


class FullWell(PixelEffect):
    """A pixel holds at most its full well of electrons; more light changes nothing.

    At low ISO speeds the well is full before the pixel value reaches 255.
    """

    name = "full-well"
    label = "Full well"
    parameters = ("full_well",)

    def bound(self, scene: Scene, observable: Observable) -> float:  # noqa: ARG002 - not averaged out
        """Bound the change by what the brightest column has beyond a full well."""
        brightest = shown_value(reachable_luminances(scene)[1], scene)
        return max(brightest - saturation_value(scene), 0.0)

    def apply(self, scene: Scene, values: Values) -> Values:
        """Cut off what is beyond a full well."""
        full = np.asarray(saturation_value(scene), dtype=values.dtype)
        return np.minimum(values, full)


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
