"""A camera's unknown tone curve: a gamma, bent by a shoulder and by contrast."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE

_TOE = 0.03  # fraction of white below which the curve is straight: noise lifts black

_GRID = np.linspace(-0.1, 1.0, 441)
_STEP = float(_GRID[1] - _GRID[0])
_LEVELS = WHITE * _GRID
_LEAST_SLOPE = 0.05
_BENDS = np.diff([_GRID * (1.0 - _GRID), _GRID * (1.0 - _GRID) * (1.0 - 2.0 * _GRID)])
"""Change of each step of the grid by shoulder and contrast."""


@dataclass(frozen=True, slots=True)
class ToneCurve:
    """A monotonic tone curve, by its inverse.

    A pixel value u relative to white is bent into v = u + s u(1-u) + k u(1-u)(1-2u). Its light is
    (v + o) / (1 + o) to the power of gamma. The offset o makes shadows straight, as in
    IEC 61966-2-1 (o = 0.055 with a gamma of 2.4) and ITU-R BT.709 (0.099 with 1 / 0.45).
    """

    gamma: float
    offset: float = 0.0  # offset, shoulder, contrast: the coefficients o, s and k
    shoulder: float = 0.0
    contrast: float = 0.0

    def table(self) -> "ToneTable":
        bent, _ = self._bend()
        toe = _TOE**self.gamma * (1.0 + self.gamma * (bent / _TOE - 1.0))
        light = np.where(bent > _TOE, np.maximum(bent, _TOE) ** self.gamma, toe)
        return ToneTable(light, 1.0 / np.gradient(light, _STEP))

    def slopes(self, table: "ToneTable") -> "ToneSlopes":
        """Tabulate the slopes over gamma, offset, shoulder and contrast."""
        bent, rises = self._bend()
        # The toe is a tangent, which changes with gamma as the point of contact and its slope do.
        steady, below = np.maximum(bent, _TOE), np.minimum(bent / _TOE - 1.0, 0.0)
        steep = self.gamma * steady ** (self.gamma - 1.0)
        logarithm = np.log(steady)
        by_gamma = steady**self.gamma * (logarithm + below * (1.0 + self.gamma * logarithm))
        by_bends = np.stack([1.0 - bent, *(_sum_to_white(rises * bend) for bend in _BENDS)])
        return ToneSlopes(table, np.vstack([by_gamma, steep / (1.0 + self.offset) * by_bends]))

    def _bend(self) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Return what is raised to the power of gamma, and which of its steps are not limited."""
        steps = _STEP + self.shoulder * _BENDS[0] + self.contrast * _BENDS[1]
        least = _LEAST_SLOPE * _STEP
        bent = _sum_to_white(np.maximum(steps, least))
        return (bent + 1.0 + self.offset) / (1.0 + self.offset), steps > least


def _sum_to_white(steps: FloatArray) -> FloatArray:
    """Sum steps up so that the last sum is 0: white stays white."""
    sums = np.concatenate([[0.0], np.cumsum(steps)])
    return np.asarray(sums - sums[-1])


class ToneTable:
    """The light of each tabulated pixel value, and the pixel value's slope over light."""

    def __init__(self, light: FloatArray, slope: FloatArray) -> None:
        self.light, self.slope = light, slope

    def light_of(self, values: FloatArray) -> FloatArray:
        """Return the light of grey levels; 1 makes white."""
        return np.asarray(np.interp(values, _LEVELS, self.light))

    def slope_at(self, values: FloatArray) -> FloatArray:
        """Return the slope of grey levels over light."""
        return np.asarray(WHITE * np.interp(values, _LEVELS, self.slope))

    def slope_of(self, light: FloatArray) -> FloatArray:
        """Return the slope of grey levels over light, at light."""
        return np.asarray(WHITE * np.interp(light, self.light, self.slope))

    def value_of(self, light: FloatArray) -> FloatArray:
        """Return the grey levels of light; it goes on straight beyond both ends."""
        over = np.maximum(light - self.light[-1], 0.0) * self.slope[-1]
        under = np.minimum(light - self.light[0], 0.0) * self.slope[0]
        return np.asarray(WHITE * (np.interp(light, self.light, _GRID) + over + under))


@dataclass(frozen=True, eq=False, slots=True)
class ToneSlopes:
    """Slopes of a tone curve over its parameters."""

    table: ToneTable
    light: FloatArray  # Shape (parameters, grey levels): of the light of each tabulated one

    def of_values(self, values: FloatArray, light: FloatArray) -> FloatArray:
        """Return the slopes of grey levels, shape (parameters, values).

        ``values``: shape (values,), the grey levels. ``light``: shape (parameters, values), the
        slopes of their light over any parameters, of which the last ones are those of the curve.
        """
        place = ((values - _LEVELS[0]) / (WHITE * _STEP)).astype(np.intp)
        rises = np.diff(self.table.light)
        steep = WHITE * _STEP / rises[np.clip(place, 0, len(rises) - 1)]
        own = np.stack([np.interp(values, _LEVELS, row) for row in self.light])
        # Beyond both ends the curve goes on straight, by its slope there.
        beyond = values - np.clip(values, _LEVELS[0], _LEVELS[-1])
        bends = -WHITE * self.table.slope**2 * np.gradient(self.light, _STEP, axis=-1)
        at_end = np.where(beyond > 0.0, bends[:, -1:], bends[:, :1])
        slopes = steep * light
        slopes[-len(own) :] += beyond / steep * at_end - steep * own
        return np.asarray(slopes)
