"""From luminance to pixel values: equations (1) to (3) of the paper."""

import math

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.exposure import lit_fraction
from occ_model.scene import Camera, Scene

WHITE = 255.0
"""The largest pixel value."""

FLAT = 1.0
"""Grey levels that values must span to differ at all: stretching less would invent stripes."""

_MID_GREY = 118.0
"""The pixel value of a scene of the luminance that the meter is calibrated to."""


def pixel_value(luminance: FloatArray, camera: Camera) -> FloatArray:
    """Give the pixel value of a constant luminance before the sensor saturates.

    PV = 118 (S t L / (K N^2))^(1/gamma), the paper's equations (1) and (2).

    Parameters
    ----------
    luminance : ndarray of float64
        cd/m2.
    camera
        Its exposure time, ISO speed, f-number, calibration constant and gamma are used.

    Returns
    -------
    ndarray of float64, shape as ``luminance``
        Grey levels; above 255 the pixel is saturated, see :func:`saturate`.
    """
    gain = camera.iso * camera.exposure_time / (camera.meter_constant * camera.f_number**2)
    return np.asarray(_MID_GREY * (gain * luminance) ** (1.0 / camera.gamma))


def saturate(values: FloatArray) -> FloatArray:
    """Limit pixel values to what a pixel can hold."""
    return np.clip(values, 0.0, WHITE)


def luminance_levels(scene: Scene) -> FloatArray:
    """Give the luminance of the panel, dark and lit, in cd/m2, shape (2,).

    What the panel reflects, E_v R / pi, is seen in both states.
    """
    reflected = scene.surroundings.illuminance * scene.surroundings.reflectance / math.pi
    return np.array([reflected, scene.transmitter.luminance + reflected])


def level_values(scene: Scene) -> FloatArray:
    """Give PV_min and PV_max, before saturation, shape (2,)."""
    return pixel_value(luminance_levels(scene), scene.camera)


def column_profile(scene: Scene) -> FloatArray:
    """Give the pixel value of every column before contrast enhancement, PV_sim.

    With ``averaging = "pixel-value"`` this is the paper's equation (3),
    PV_sim(i) = (PV_max t_on(i) + PV_min t_off(i)) / t. With ``"light"`` the luminances are averaged
    and the pixel value is taken of their mean, as light adds up in a sensor before gamma encoding.
    Either way the sum saturates, not its terms: a pixel is full when all its light is in.

    Returns
    -------
    ndarray of float64, shape (columns,)
        Grey levels, 0 to 255, not rounded.
    """
    lit = lit_fraction(scene)
    if scene.model.averaging == "light":
        dark, bright = luminance_levels(scene)
        return saturate(pixel_value(dark + (bright - dark) * lit, scene.camera))
    dark, bright = level_values(scene)
    return saturate(dark + (bright - dark) * lit)
