"""A camera's unknown tone curve: a gamma, bent by a shoulder and by contrast."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE

_TOE = 0.03
"""Pixel value, as a share of white, below which the curve goes on straight: noise lifts blacks."""

_GRID = np.linspace(-0.1, 1.0, 441)
_LEAST_SLOPE = 0.05


@dataclass(frozen=True, slots=True)
class ToneCurve:
    """A monotonic tone curve, by its inverse.

    A pixel value u, as a share of white, is bent into v = u + s u(1-u) + k u(1-u)(1-2u). Its light
    is (v + o) / (1 + o) to the power of gamma. The offset o makes shadows straight, as in
    IEC 61966-2-1 (o = 0.055 with a gamma of 2.4) and ITU-R BT.709 (0.099 with 1 / 0.45).

    Parameters
    ----------
    gamma
        The exponent.
    offset, shoulder, contrast
        The coefficients o, s and k.
    """

    gamma: float
    offset: float = 0.0
    shoulder: float = 0.0
    contrast: float = 0.0

    def table(self) -> "ToneTable":
        """Tabulate the curve."""
        u = _GRID
        bent = u * (1.0 + (1.0 - u) * (self.shoulder + self.contrast * (1.0 - 2.0 * u)))
        steps = np.maximum(np.diff(bent), _LEAST_SLOPE * (u[1] - u[0]))
        bent = np.concatenate([[bent[0]], bent[0] + np.cumsum(steps)])
        bent = (bent + 1.0 - bent[-1] + self.offset) / (1.0 + self.offset)
        toe = _TOE**self.gamma * (1.0 + self.gamma * (bent / _TOE - 1.0))
        light = np.where(bent > _TOE, np.maximum(bent, _TOE) ** self.gamma, toe)
        return ToneTable(light, (u[1] - u[0]) / _risen(light))


def _risen(values: FloatArray) -> FloatArray:
    """Give half of the rise from the value before to the value after; at the ends the whole one."""
    risen = np.empty_like(values)
    risen[1:-1] = 0.5 * (values[2:] - values[:-2])
    risen[0], risen[-1] = values[1] - values[0], values[-1] - values[-2]
    return risen


class EvenTable:
    """A function tabulated at equal distances: looked up far faster than at unequal ones.

    Parameters
    ----------
    first, last
        The ends; beyond them the function is constant.
    values : ndarray of float64
        From one end to the other.
    """

    def __init__(self, first: float, last: float, values: FloatArray) -> None:
        self._first, self._most = first, len(values) - 1
        self._rate = self._most / (last - first)
        self._values, self._rise = values, np.append(np.diff(values), 0.0)

    def at(self, places: FloatArray) -> FloatArray:
        """Give the function at some places, by linear interpolation."""
        place = np.clip((places - self._first) * self._rate, 0.0, self._most)
        below = place.astype(np.intp)
        return np.asarray(self._values[below] + (place - below) * self._rise[below])


class ToneTable:
    """A tabulated tone curve.

    Parameters
    ----------
    light, slope : ndarray of float64
        The light of each tabulated pixel value, and the pixel value's slope over light.
    """

    def __init__(self, light: FloatArray, slope: FloatArray) -> None:
        self.light, self.slope = light, slope
        self._light = EvenTable(_GRID[0], _GRID[-1], light)
        self._slope = EvenTable(_GRID[0], _GRID[-1], slope)

    def light_of(self, values: FloatArray) -> FloatArray:
        """Give the light of grey levels; 1 makes white."""
        return self._light.at(values / WHITE)

    def slope_at(self, values: FloatArray) -> FloatArray:
        """Give the slope of grey levels over light."""
        return np.asarray(WHITE * self._slope.at(values / WHITE))

    def slope_of(self, light: FloatArray) -> FloatArray:
        """Give the slope of grey levels over light, at light."""
        return np.asarray(WHITE * np.interp(light, self.light, self.slope))

    def value_of(self, light: FloatArray) -> FloatArray:
        """Give the grey levels of light; it goes on straight beyond both ends."""
        over = np.maximum(light - self.light[-1], 0.0) * self.slope[-1]
        under = np.minimum(light - self.light[0], 0.0) * self.slope[0]
        return np.asarray(WHITE * (np.interp(light, self.light, _GRID) + over + under))
