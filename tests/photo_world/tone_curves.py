"""Tone curves of cameras: from light, 0 to 1, to pixel values, 0 to 1."""

import math
from collections.abc import Callable
from functools import partial

import numpy as np

Curve = Callable[[np.ndarray], np.ndarray]
"""One that another process can be given: a function of this module."""


def _power(light: np.ndarray, gamma: float) -> np.ndarray:
    return np.asarray(light ** (1.0 / gamma))


def srgb(light: np.ndarray) -> np.ndarray:
    """Follow IEC 61966-2-1."""
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1.0 / 2.4) - 0.055)


def _rec709(light: np.ndarray) -> np.ndarray:
    """Follow ITU-R BT.709, which video cameras have."""
    return np.where(light < 0.018, 4.5 * light, 1.099 * light**0.45 - 0.099)


def _contrasty(light: np.ndarray, strength: float) -> np.ndarray:
    """Put an S on a gamma of 2.2: deeper shadows and brighter lights, as phones add."""
    value = _power(light, 2.2)
    return (1.0 - strength) * value + strength * value**2 * (3.0 - 2.0 * value)


def _shoulder(light: np.ndarray, knee: float) -> np.ndarray:
    """Compress the lights of a gamma of 2.2, as film and pictures of HDR do."""
    return _power(light * (1.0 + knee) / (light + knee), 2.2)


def _logarithmic(light: np.ndarray, strength: float) -> np.ndarray:
    return np.asarray(np.log1p(strength * light) / math.log1p(strength))


def _phone(light: np.ndarray, strength: float, black: float) -> np.ndarray:
    """Put an S on sRGB, and cut its darkest levels off, as the pictures of phones do."""
    value = srgb(light)
    value = (1.0 - strength) * value + strength * value**2 * (3.0 - 2.0 * value)
    return np.asarray(np.clip((value - black) / (1.0 - black), 0.0, 1.0))


def power(gamma: float) -> Curve:
    """Return the curve of a plain gamma."""
    return partial(_power, gamma=gamma)


def unknown_curve(random: np.random.Generator) -> Curve:
    """Draw a tone curve that the program does not know."""
    kind = int(random.integers(5))
    if kind == 0:
        return power(float(random.uniform(1.7, 2.7)))
    if kind == 1:
        return srgb
    if kind == 2:
        return _rec709
    if kind == 3:
        return partial(_contrasty, strength=float(random.uniform(0.2, 0.8)))
    return partial(_shoulder, knee=float(random.uniform(0.6, 3.0)))


def any_camera_curve(random: np.random.Generator) -> Curve:
    """Draw an unknown curve, or one of two that are farther from a power."""
    kind = random.random()
    if kind < 0.15:
        return partial(_logarithmic, strength=float(random.uniform(5.0, 60.0)))
    if kind < 0.4:
        return partial(
            _phone, strength=float(random.uniform(0.0, 0.7)), black=float(random.uniform(0.0, 0.06))
        )
    return unknown_curve(random)
