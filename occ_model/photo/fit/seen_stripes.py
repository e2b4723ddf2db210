"""What the columns see of one lamp's chips: blurred lit fractions, and a tone curve.

Image processing blurs along the columns. An LED or driver that turns on faster than off is on a
little longer than its chips say.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.fit.timing import ChipLight, Timing
from occ_model.photo.fit.tone_curve import ToneCurve, ToneSlopes, ToneTable

BLUR_REACH = 8  # maximum distance in columns over which blur acts

_LEAST_BLUR = 0.05  # blur in columns below which a picture is sharp
_CHANGE = 1e-5  # finite difference of the blur in columns

BLUR = 3  # the blur's index among the parameters of slopes: step, exposure, middle, blur and longer

BlurShape = Literal["normal", "box", "exponential"]
"""Blur's distribution: of processing; a box, as resizing blurs; or one with long tails."""

GAMMA = 3
IN_ORDER = [0, 1, 2, 7, 8, GAMMA, 4, 5, 6]
"""Indices of gamma, and of all parameters in the order of slopes: those of the tone curve last."""


def blur_rows(rows: FloatArray, kernel: FloatArray) -> FloatArray:
    """Blur a row, or several, along the columns, and leave out those that only blur reaches."""
    found = cv2.filter2D(np.atleast_2d(rows), -1, kernel[None])[:, BLUR_REACH:-BLUR_REACH]
    return np.asarray(found, dtype=np.float64).reshape(*rows.shape[:-1], -1)


@lru_cache(maxsize=8)
def blur_kernel(blur: float, shape: BlurShape = "normal") -> FloatArray:
    """Return the weights of blur of the standard deviation ``blur``, in columns, around a column.

    A box of the half width sqrt(3) blur gives each column the fraction of it that the column
    covers; exponential tails decay by the same ratio from column to column.
    """
    off = np.abs(np.arange(-BLUR_REACH, BLUR_REACH + 1)).astype(np.float64)
    blur = max(blur, _LEAST_BLUR)
    if shape == "box":
        half = math.sqrt(3.0) * blur
        kernel = np.clip(np.minimum(off + 0.5, half) - np.maximum(off - 0.5, -half), 0.0, None)
    elif shape == "exponential":
        # Weights r^|i| have the variance 2 r / (1 - r)^2.
        middle = 1.0 + 1.0 / blur**2
        kernel = (middle - math.sqrt(middle**2 - 1.0)) ** off
    else:
        kernel = np.exp(-0.5 * (off / blur) ** 2)
    weights = np.asarray(kernel / kernel.sum(), dtype=np.float64)
    weights.flags.writeable = False
    return weights


@lru_cache(maxsize=8)
def kernel_slope(blur: float, shape: BlurShape = "normal") -> FloatArray:
    """Return the slope of the weights of blur over its standard deviation."""
    more, less = (blur_kernel(blur + change, shape) for change in (_CHANGE, -_CHANGE))
    slope = np.asarray((more - less) / (2.0 * _CHANGE))
    slope.flags.writeable = False
    return slope


@dataclass(frozen=True, eq=False, slots=True)
class Seen:
    """What the columns see of the chips, and the camera's tone curve."""

    lit: FloatArray  # blurred lit fractions, shape (columns,)
    table: ToneTable
    # Sharp lit fractions, also of the columns beside that blur reaches; None if light is blurred.
    sharp: FloatArray | None
    kernel: FloatArray


@dataclass(frozen=True, eq=False, slots=True)
class SeenSlopes:
    # Shape (light's parameters, columns); of the blurred lit fractions. Where pixel values are
    # blurred, of the sharp ones, also of the columns beside that blur reaches.
    lit: FloatArray
    tone: ToneSlopes  # of the tone curve, over its own parameters
    kernel: FloatArray  # shape (weights,); of the blur's weights, over the blur


class SeenStripes:
    """What columns see of chips that are sent repeatedly, neither all on nor all off."""

    def __init__(
        self, chips: ByteArray, columns: int, gamma: float, *, values_blurred: bool
    ) -> None:
        self._light = ChipLight(chips, columns, BLUR_REACH)
        self._gamma, self._values_blurred = gamma, values_blurred
        # Slopes are needed where the residual has just been computed.
        self._last = lru_cache(maxsize=1)(self._compute)

    def at(self, values: FloatArray, shape: BlurShape = "normal") -> Seen:
        """Return what is seen with nine parameters and a shape of the blur."""
        return self._last(tuple(values.tolist()), shape)

    def slopes(self, values: FloatArray, shape: BlurShape) -> SeenSlopes:
        """Return the slopes of what is seen, those of the tone over gamma itself."""
        timing, curve, blur, longer = self._parts(values.tolist())
        seen, exposed = self.at(values, shape), self._light.expose(timing, longer)
        slope_of_kernel = kernel_slope(blur, shape)
        lit = np.zeros((5, len(exposed.lit)))
        lit[:BLUR] = exposed.slopes()
        # Each edge comes earlier, or later, by half of what the time on is longer.
        np.multiply(exposed.edges, 0.5 / timing.exposure, out=lit[BLUR + 1])
        if not self._values_blurred:
            lit = blur_rows(lit, seen.kernel)
            lit[BLUR] = blur_rows(exposed.lit, slope_of_kernel)
        return SeenSlopes(lit, curve.slopes(seen.table), slope_of_kernel)

    def gamma(self, values: FloatArray | Sequence[float]) -> float:
        """Return gamma; the parameters hold the logarithm of its ratio to the usual one."""
        return self._gamma * math.exp(values[GAMMA])

    def _compute(self, values: Sequence[float], shape: BlurShape) -> Seen:
        timing, curve, blur, longer = self._parts(values)
        sharp, kernel = self._light.expose(timing, longer).lit, blur_kernel(blur, shape)
        shown = sharp if self._values_blurred else None
        return Seen(blur_rows(sharp, kernel), curve.table(), shown, kernel)

    def _parts(self, values: Sequence[float]) -> tuple[Timing, ToneCurve, float, float]:
        step, exposure, middle, _, offset, shoulder, contrast, blur, longer = values
        curve = ToneCurve(self.gamma(values), offset, shoulder, contrast)
        return Timing(step, exposure, middle, self._gamma), curve, blur, longer
