"""What the columns see of one lamp's chips, by the parameters of a joint fit."""

import math
from collections.abc import Sequence
from functools import lru_cache

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.fit.blurred_light import (
    BlurredLight,
    BlurShape,
    blur_kernel,
    kernel_slope,
)
from occ_model.photo.fit.lit_profile import Seen, SeenSlopes
from occ_model.photo.fit.timing import Timing
from occ_model.photo.fit.tone_curve import ToneCurve, ToneSlopes

GAMMA = 3
OF_TONE = [GAMMA, 4, 5, 6]
IN_ORDER = [0, 1, 2, 7, 8, *OF_TONE]
"""Indices of gamma, of the tone curve's parameters, and of all in the order of slopes."""


class SeenStripes:
    """Lit fractions and a tone curve."""

    def __init__(
        self, chips: ByteArray, columns: int, gamma: float, *, values_blurred: bool
    ) -> None:
        self._light = BlurredLight(chips, columns)
        self._gamma, self._values_blurred = gamma, values_blurred
        # Slopes are asked for where the residual has just been.
        self._last = lru_cache(maxsize=1)(self._by)

    def by(self, values: FloatArray, tails: float = 0.0, shape: BlurShape = "normal") -> Seen:
        """Return what is seen by nine parameters, and the blur's excess kurtosis and shape."""
        return self._last(tuple(values.tolist()), tails, shape)

    def slopes(self, values: FloatArray, shape: BlurShape, of_tone: bool = True) -> SeenSlopes:
        """Return its slopes, those of the tone over gamma itself, and none of them if not asked."""
        timing, curve, blur, longer = self._parts(values.tolist())
        table = self.by(values, 0.0, shape).table
        sharp = self._light.sharp_slopes(timing, longer) if self._values_blurred else None
        return SeenSlopes(
            self._light.slopes(timing, blur, longer, shape),
            curve.slopes(table) if of_tone else ToneSlopes(table),
            sharp,
            kernel_slope(blur, shape),
        )

    def gamma(self, values: FloatArray | Sequence[float]) -> float:
        """Return the gamma, of which the parameters hold the logarithm over the usual one."""
        return self._gamma * math.exp(values[GAMMA])

    def _by(self, values: Sequence[float], tails: float, shape: BlurShape) -> Seen:
        timing, curve, blur, longer = self._parts(values)
        sharp = self._light.sharp(timing, longer) if self._values_blurred else None
        return Seen(
            self._light.lit_fraction(timing, blur, longer, tails, shape),
            curve.table(),
            sharp,
            blur_kernel(blur, tails, shape),
        )

    def _parts(self, values: Sequence[float]) -> tuple[Timing, ToneCurve, float, float]:
        step, exposure, middle, _, offset, shoulder, contrast, blur, longer = values
        curve = ToneCurve(self.gamma(values), offset, shoulder, contrast)
        return Timing(step, exposure, middle, self._gamma), curve, blur, longer
