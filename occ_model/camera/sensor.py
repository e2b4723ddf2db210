"""The sensor: electrons of a pixel from its grey level, and back, and the noise they cause.

The paper's equations (1) and (2) give the pixel value of a luminance, which is the mean of many
pixels. How far a single pixel deviates from it follows from the number of its electrons.
"""

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE, luminance_of, pixel_value
from occ_model.scene.scene import Camera, Scene, Sensor

_EXPOSURE_FACTOR = 0.65
"""H = 0.65 L t / N^2 in lux seconds, the exposure behind a lens for a luminance (ISO 12232).

It includes the fall-off of light at 10 degrees off the axis, some 6 %."""

_PHOTONS_PER_LUMEN_SECOND = 8.8e15  # per lm s of white LED light: 320 lm/W, 3.55e-19 J a photon


_SMALLEST_FLOAT = np.finfo(np.float64).tiny


def electrons_per_luminance(scene: Scene) -> float:
    """Return the electrons that a pixel collects in the exposure time, for each cd/m2."""
    return _electrons_per_luminance(scene.camera, scene.sensor)


def _electrons_per_luminance(camera: Camera, sensor: Sensor) -> float:
    illumination = _EXPOSURE_FACTOR * camera.exposure_time / camera.f_number**2
    collected: float = (
        illumination * _PHOTONS_PER_LUMEN_SECOND * sensor.pixel_pitch**2 * sensor.quantum_efficiency
    )
    return collected


def electrons_of(values: FloatArray, scene: Scene) -> FloatArray:
    """Return the mean number of electrons behind pixel values before saturation."""
    return luminance_of(values, scene.camera) * electrons_per_luminance(scene)


def values_of(electrons: FloatArray, scene: Scene) -> FloatArray:
    """Return the pixel values, before saturation, of numbers of electrons."""
    return pixel_value(electrons / electrons_per_luminance(scene), scene.camera)


def converter_step(scene: Scene) -> float:
    """Return the electrons of one step of the converter, whose range ends at the largest value."""
    return _converter_step(scene.camera, scene.sensor)


@lru_cache(maxsize=8)
def _converter_step(camera: Camera, sensor: Sensor) -> float:
    brightest = luminance_of(np.array([WHITE]), camera)
    largest = float(brightest[0]) * _electrons_per_luminance(camera, sensor)
    return min(largest, sensor.full_well) / float(2**sensor.adc_bits)


def deviation(
    values: FloatArray, scene: Scene, variance: Callable[[FloatArray], FloatArray]
) -> FloatArray:
    """Return the standard deviation of pixels in grey levels from that of their electrons.

    The deviation sigma of n electrons is multiplied by the slope of the gamma encoding, PV / (gamma
    n), taken at sqrt(n^2 + sigma^2) electrons: n where there is light, finite where there is none.
    It is at most the distance from saturation: a full pixel shows no noise, and one within a
    deviation of being full shows less than a sensor that is saturated by its gain alone.
    """
    electrons = electrons_of(values, scene)
    square = variance(electrons)
    there = np.sqrt(electrons * electrons + square)
    slope = values_of(there, scene) / np.maximum(scene.camera.gamma * there, _SMALLEST_FLOAT)
    headroom = np.maximum(saturation_value(scene) - values, 0.0)
    return np.minimum(slope * np.sqrt(square), headroom)


def saturation_value(scene: Scene) -> float:
    """Return the pixel value at which a pixel is full, at most the largest."""
    return _saturation_value(scene.camera, scene.sensor)


@lru_cache(maxsize=8)
def _saturation_value(camera: Camera, sensor: Sensor) -> float:
    full = np.array([sensor.full_well]) / _electrons_per_luminance(camera, sensor)
    return min(float(pixel_value(full, camera)[0]), WHITE)
