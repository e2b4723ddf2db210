"""Photometry: pixel values from luminance by equations (1) to (3) of the paper, and electrons.

The equations give the pixel value for a luminance, which is the mean of many pixels. The values of
single pixels follow from their number of electrons: see :mod:`occ_model.camera.pixel_noise`.
"""

import math
import operator
from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import cv2
import numpy as np

from occ_model.arrays import LARGEST_BYTE, FloatArray
from occ_model.camera.exposure import lit_fraction
from occ_model.scene.scene import Camera, Scene

WHITE = LARGEST_BYTE  # the largest pixel value
FLAT_SPAN = 1.0  # least span in grey levels that is enhanced; stretching less would invent stripes
_MID_GREY = 118.0  # the pixel value at the luminance to which the meter is calibrated


def _exposure_gain(camera: Camera) -> float:
    """Return S t / (K N^2), by which a luminance becomes a multiple of the meter's."""
    return camera.iso * camera.exposure_time / (camera.meter_constant * camera.f_number**2)


def pixel_value(
    luminance: FloatArray,
    camera: Camera,
    power: Callable[[FloatArray, float], FloatArray] = operator.pow,
) -> FloatArray:
    """Return the pixel value for a constant luminance in cd/m2, before the sensor saturates.

    PV = 118 (S t L / (K N^2))^(1/gamma), the paper's equations (1) and (2).
    """
    return np.asarray(_MID_GREY * power(_exposure_gain(camera) * luminance, 1.0 / camera.gamma))


def fast_power(values: FloatArray, power: float) -> FloatArray:
    """Return a power, faster than NumPy but with slightly different rounding."""
    powers: FloatArray = np.asarray(cv2.pow(values.reshape(-1, 1), power), dtype=np.float64)
    return powers.reshape(values.shape)


def luminance_of(values: FloatArray, camera: Camera) -> FloatArray:
    """Return the luminance in cd/m2 for a pixel value, the inverse of :func:`pixel_value`."""
    return np.asarray((values / _MID_GREY) ** camera.gamma / _exposure_gain(camera))


def saturate(values: FloatArray) -> FloatArray:
    return np.clip(values, 0.0, WHITE)


def luminance_levels(scene: Scene) -> FloatArray:
    """Return the luminances of the dark and the lit panel in cd/m2, with E_v R / pi reflected."""
    reflected = scene.surroundings.illuminance * scene.surroundings.reflectance / math.pi
    return np.array([reflected, scene.transmitter.luminance + reflected])


def level_values(scene: Scene) -> FloatArray:
    """Return PV_min and PV_max, before saturation, shape (2,)."""
    return pixel_value(luminance_levels(scene), scene.camera)


@dataclass(frozen=True, eq=False, slots=True)
class ColumnLight:
    # Shape (columns,): mean light of the panel during the exposure, 1 if fully lit
    lit: FloatArray
    # Shape (columns,) or (1,): mean external light, as a multiple of its mean over time
    ambient: FloatArray

    @classmethod
    def of(cls, scene: Scene) -> Self:
        """Return the light in the paper's model: sharp edges and steady surroundings."""
        return cls(lit_fraction(scene), np.ones(1))


def panel_values(
    scene: Scene,
    light: ColumnLight,
    power: Callable[[FloatArray, float], FloatArray] = operator.pow,
) -> FloatArray:
    """Return the pixel value of each column on the panel, before saturation.

    With ``averaging = "pixel-value"`` this is the paper's equation (3), PV_sim(i) = (PV_max t_on(i)
    + PV_min t_off(i)) / t. With ``"light"`` the luminances are averaged before the gamma encoding,
    as in a real sensor.
    """
    dark, bright = luminance_levels(scene)
    reflected, emitted = dark * light.ambient, bright - dark
    if scene.model.averaging == "light":
        return pixel_value(reflected + emitted * light.lit, scene.camera, power)
    low = pixel_value(reflected, scene.camera, power)
    high = pixel_value(reflected + emitted, scene.camera, power)
    return low + (high - low) * light.lit


def surroundings_values(scene: Scene, light: ColumnLight) -> FloatArray:
    """Return the pixel value of the surroundings before saturation, shape (columns,) or (1,)."""
    return pixel_value(luminance_levels(scene)[0] * light.ambient, scene.camera)


def column_profile(scene: Scene) -> FloatArray:
    """Return the pixel value of every column before contrast enhancement, PV_sim.

    It is :func:`panel_values` in the paper's model, saturated. The sum saturates, not its terms,
    since a pixel fills during the whole exposure.

    Returns
    -------
    ndarray of float64, shape (columns,)
        Grey levels, 0 to 255, not rounded.
    """
    return saturate(panel_values(scene, ColumnLight.of(scene)))


_EXPOSURE_FACTOR = 0.65
"""H = 0.65 L t / N^2 in lux seconds is the exposure behind a lens for a luminance (ISO 12232).

It includes the fall-off of light at 10 degrees from the axis, some 6 %."""

_PHOTONS_PER_LUMEN_SECOND = 8.8e15  # of white LED light, with 320 lm/W and 3.55e-19 J a photon


def white_electrons(scene: Scene) -> float:
    """Return the mean number of electrons for the pixel value 255.

    It follows from the ISO speed, as the exposure time and the f-number cancel.
    """
    camera, sensor = scene.camera, scene.sensor
    lux_seconds = _EXPOSURE_FACTOR * camera.meter_constant / camera.iso
    lux_seconds *= (WHITE / _MID_GREY) ** camera.gamma
    collected: float = (
        lux_seconds * _PHOTONS_PER_LUMEN_SECOND * sensor.pixel_pitch**2 * sensor.quantum_efficiency
    )
    return collected


def converter_step(scene: Scene) -> float:
    """Return the electrons for each step of the converter, whose top code is white or full."""
    largest = min(white_electrons(scene), scene.sensor.full_well)
    return largest / float(2**scene.sensor.adc_bits - 1)


def saturation_value(scene: Scene) -> float:
    """Return the pixel value at which a pixel is full, at most white."""
    full = scene.sensor.full_well / white_electrons(scene)
    return float(WHITE * min(full ** (1.0 / scene.camera.gamma), 1.0))
