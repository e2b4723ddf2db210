"""The parameters of a joint fit, scaled so that a step of any of them matters about as much."""

import math

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import FloatArray
from occ_model.photo.fit.timing import SHORTEST_EXPOSURE

_LOW = np.array([0.5, SHORTEST_EXPOSURE, -np.inf, -np.inf, -0.1, -0.9, -0.9, 0.0, -0.3])
_HIGH = np.array([2.0, np.inf, np.inf, np.inf, 0.3, 0.9, 1.5, 3.0, 0.3])
"""Bounds of the parameters except gamma; those of the step are relative to it."""

_EXPOSURE_SCALE = 0.05  # scale of the exposure's logarithm
_MOST_LOG_CHANGE = 5.0  # maximum change of that logarithm


class ScaledParameters:
    """Those parameters that are fitted, as scaled differences from a first guess.

    All nine are those of a timing, the logarithm of gamma over a usual one, offset, shoulder,
    contrast, blur, and the chips by which the LED is on longer. ``index``: which of them are
    fitted. ``scale``: a difference of each that matters about as much; the exposure has its own.
    ``step``: chips per column, roughly. ``gamma``: bounds of its logarithm.
    """

    def __init__(
        self,
        first: FloatArray,
        index: NDArray[np.int64],
        scale: FloatArray,
        step: float,
        gamma: tuple[float, float],
    ) -> None:
        self._low, self._high = _LOW.copy(), _HIGH.copy()
        self._low[0] *= step
        self._high[0] *= step
        self._low[3], self._high[3] = gamma
        self._first, self._index = np.clip(first, self._low, self._high), index
        self._scale = np.where(index == 1, _EXPOSURE_SCALE, scale[index])

    def values(self, scaled: FloatArray) -> FloatArray:
        """Return all nine parameters, within their bounds."""
        return np.clip(self._unbounded(scaled), self._low, self._high)

    def rates(self, values: FloatArray) -> FloatArray:
        """Return the rate at which each parameter that is fitted changes, bounds left aside."""
        return np.where(self._index == 1, self._scale * values[1], self._scale)

    def slopes(self, scaled: FloatArray) -> FloatArray:
        """Return each fitted parameter's slope: 0 beyond its bounds, and upwards at a bound."""
        unbounded = self._unbounded(scaled)
        inside = (unbounded >= self._low) & (unbounded < self._high)
        inside[1] &= unbounded[1] < self._first[1] * math.exp(_MOST_LOG_CHANGE)
        signs = np.ones(9)
        signs[7] = -1.0 if self._changed(scaled)[7] < 0.0 else 1.0
        return np.asarray((inside * signs)[self._index] * self.rates(unbounded))

    def _changed(self, scaled: FloatArray) -> FloatArray:
        values = self._first.copy()
        values[self._index] += scaled * self._scale
        return values

    def _unbounded(self, scaled: FloatArray) -> FloatArray:
        values = self._changed(scaled)
        values[1] = self._first[1] * math.exp(min(values[1] - self._first[1], _MOST_LOG_CHANGE))
        values[7] = abs(values[7])
        return values
