"""Minimize a sum of squares of few parameters, each evaluation of which is expensive.

With ``scipy.optimize.least_squares`` nine matches took 1.4 times as long, and came to the same but
for one exposure, which was farther off.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.products import dot, row_products

_LEAST_GAIN = 0.02  # minimum decrease of the sum of squares for a further iteration
_MOST_TRIES = 7  # maximum number of shorter steps after one without a gain


@dataclass(frozen=True, eq=False, slots=True)
class Bounds:
    """The least and the largest value of each parameter, and its largest change in a step."""

    low: FloatArray
    high: FloatArray
    most_change: FloatArray | float = math.inf

    def limit(self, place: FloatArray, there: FloatArray) -> FloatArray:
        """Return where a step from a place to another one ends within the bounds."""
        there = np.clip(there, place - self.most_change, place + self.most_change)
        return np.clip(there, self.low, self.high)


_NO_BOUNDS = Bounds(np.array(-math.inf), np.array(math.inf))


def minimize_squares(
    residual: Callable[[FloatArray], FloatArray],
    slopes: Callable[[FloatArray], FloatArray],
    first: FloatArray,
    rounds: int,
    *,
    bounds: Bounds = _NO_BOUNDS,
    fraction: float = 0.0,
    hopeless: float = math.inf,
) -> tuple[FloatArray, FloatArray]:
    """Minimize a sum of squares (Levenberg and Marquardt); return the place and its residual.

    It ends after a step that gains next to nothing.

    ``residual``: in standard deviations of the noise. ``slopes``: those of the residual, shape
    (residuals, parameters). ``fraction``: if the noise is not known, the fraction of the sum of
    squares by which it has to decrease for a further step. ``hopeless``: the sum of squares above
    which it ends after the first step.
    """
    here, value = first, residual(first)
    damping = 1e-2
    for _ in range(rounds):
        steep = slopes(here)
        products = row_products(steep.T, steep.T)
        gradient = row_products(value, steep.T)
        gain, before = 0.0, dot(value, value)
        for _ in range(_MOST_TRIES):
            damped = products + np.diag(damping * np.diag(products) + 1e-9)
            there = bounds.limit(here, here - np.linalg.solve(damped, gradient))
            new = residual(there)
            gain = before - dot(new, new)
            if gain > 0.0:
                damping = max(0.2 * damping, 1e-7)
                here, value = there, new
                break
            damping *= 5.0
        left = before - gain
        least = fraction * left if fraction else _LEAST_GAIN
        if gain <= 0.0 or gain < least or left > hopeless:
            break
    return here, value
