"""A camera's tone curve from light to grey levels: a power with a toe and a shoulder."""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray


@dataclass(frozen=True, slots=True)
class PowerTone:
    """T = T0 + kappa T0 (1 - T0) (2 T0 - 1) with T0 = ((L + eps)^(1/gamma) - eps^(1/gamma)) / D.

    D makes T of 1 be 1. It fits powers, sRGB's linear toe and mild S-shaped curves.
    """

    gamma: float
    toe: float  # eps
    bend: float  # kappa

    def levels(self, light: FloatArray) -> FloatArray:
        power, toe = 1.0 / self.gamma, self.toe
        low, high = toe**power, (1.0 + toe) ** power
        plain = ((np.maximum(light, 0.0) + toe) ** power - low) / (high - low)
        return np.asarray(plain + self.bend * plain * (1.0 - plain) * (2.0 * plain - 1.0))

    def slopes(self, light: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the slopes of the levels over the light, and over three parameters.

        These are the logarithms of gamma and of the toe, and the bend.
        """
        power, toe = 1.0 / self.gamma, self.toe
        above = np.maximum(light, 0.0) + toe
        log = np.log(above)
        raised = np.exp(power * log)
        low, high = toe**power, (1.0 + toe) ** power
        scale = high - low
        plain = (raised - low) / scale
        by_above = power * raised / above
        by_power = raised * log - low * math.log(toe)
        by_power = (by_power - plain * (high * math.log1p(toe) - low * math.log(toe))) / scale
        by_toe = by_above - power * low / toe
        by_toe = (by_toe - plain * power * (high / (1.0 + toe) - low / toe)) / scale
        curve = plain * (1.0 - plain) * (2.0 * plain - 1.0)
        steep = 1.0 + self.bend * (6.0 * plain - 6.0 * plain * plain - 1.0)
        return steep * by_above / scale, np.stack(
            [-steep * by_power * power, steep * by_toe * toe, curve]
        )
