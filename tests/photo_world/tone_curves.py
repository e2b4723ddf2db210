"""Tone curves of cameras: from light, 0 to 1, to pixel values, 0 to 1."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

Curve = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class ToneCurve:
    """A camera's tone curve, and the gamma that it has where it is a plain power."""

    name: str
    gamma: float | None
    apply: Curve


def _power(light: np.ndarray, gamma: float) -> np.ndarray:
    return np.asarray(light ** (1.0 / gamma))


def _srgb(light: np.ndarray) -> np.ndarray:
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1.0 / 2.4) - 0.055)


def _rec709(light: np.ndarray) -> np.ndarray:
    return np.where(light < 0.018, 4.5 * light, 1.099 * light**0.45 - 0.099)


def _contrasty(light: np.ndarray, strength: float) -> np.ndarray:
    value = _power(light, 2.2)
    return (1.0 - strength) * value + strength * value**2 * (3.0 - 2.0 * value)


def _shoulder(light: np.ndarray, knee: float) -> np.ndarray:
    return _power(light * (1.0 + knee) / (light + knee), 2.2)


def power(gamma: float) -> ToneCurve:
    """Return the curve of a plain gamma."""
    return ToneCurve(f"gamma {gamma:.2f}", gamma, partial(_power, gamma=gamma))


def srgb() -> ToneCurve:
    """Return the curve of IEC 61966-2-1."""
    return ToneCurve("sRGB", None, _srgb)


def rec709() -> ToneCurve:
    """Return the curve of ITU-R BT.709, which video cameras have."""
    return ToneCurve("BT.709", None, _rec709)


def contrasty(strength: float) -> ToneCurve:
    """Return a gamma of 2.2 with an S on it: deeper shadows and brighter lights, as phones add."""
    return ToneCurve(f"S of {strength:.2f}", None, partial(_contrasty, strength=strength))


def shoulder(knee: float) -> ToneCurve:
    """Return a gamma of 2.2 whose lights are compressed, as in film and in pictures of HDR."""
    return ToneCurve(f"shoulder of {knee:.2f}", None, partial(_shoulder, knee=knee))


def unknown_curve(random: np.random.Generator) -> ToneCurve:
    """Draw a tone curve that the program does not know."""
    kind = int(random.integers(5))
    if kind == 0:
        return power(float(random.uniform(1.7, 2.7)))
    if kind == 1:
        return srgb()
    if kind == 2:
        return rec709()
    if kind == 3:
        return contrasty(float(random.uniform(0.2, 0.8)))
    return shoulder(float(random.uniform(0.6, 3.0)))
