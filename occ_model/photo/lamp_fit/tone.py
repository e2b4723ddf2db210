"""A camera's tone curve from light to grey levels: a power with a toe and a shoulder."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray


@dataclass(frozen=True, slots=True)
class Tone:
    """T = T0 + kappa T0 (1 - T0) (2 T0 - 1) with T0 = ((L + eps)^(1/gamma) - eps^(1/gamma)) / D.

    D makes T of 1 be 1. It fits powers, sRGB's linear toe and mild S-shaped curves.
    """

    gamma: float
    toe: float  # eps
    bend: float  # kappa

    def slopes(self, light: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the levels, and their slopes over the light and over three parameters.

        These are the logarithms of gamma and of the toe, and the bend.
        """
        light = np.maximum(light, 0.0)
        power, toe = 1.0 / self.gamma, self.toe
        raised = (light + toe) ** power
        low, high = toe**power, (1.0 + toe) ** power
        scale = high - low
        plain = (raised - low) / scale
        by_light = power * raised / (light + toe) / scale
        by_power = raised * np.log(light + toe) - low * np.log(toe)
        by_power = (by_power - plain * (high * np.log1p(toe) - low * np.log(toe))) / scale
        by_toe = power * (raised / (light + toe) - low / toe)
        by_toe = (by_toe - plain * power * (high / (1.0 + toe) - low / toe)) / scale
        curve = plain * (1.0 - plain) * (2.0 * plain - 1.0)
        steep = 1.0 + self.bend * (6.0 * plain - 6.0 * plain * plain - 1.0)
        return (
            plain + self.bend * curve,
            steep * by_light,
            np.stack([-steep * by_power * power, steep * by_toe * toe, curve]),
        )
