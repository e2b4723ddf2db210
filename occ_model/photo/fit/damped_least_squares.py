"""Minimize a sum of squares of few parameters, each evaluation of which is expensive.

With ``scipy.optimize.least_squares`` nine matches took 1.4 times as long, and came to the same but
for one exposure, which was farther off.
"""

from collections.abc import Callable

import numpy as np

from occ_model.arrays import FloatArray

DIFFERENCE = 0.02  # finite difference of the scaled parameters

_LEAST_GAIN = 0.05  # minimum decrease of the sum of squares for a further iteration
_MOST_TRIES = 6  # maximum number of shorter steps after one without a gain


def minimized(
    residual: Callable[[FloatArray], FloatArray],
    first: FloatArray,
    rounds: int,
    fraction: float = 0.0,
    slopes: Callable[[FloatArray], FloatArray] | None = None,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Minimize a sum of squares (Levenberg and Marquardt).

    It ends where a step gains next to nothing: after as many steps as are worth their time.

    ``residual`` is in standard deviations of the noise, over parameters scaled so that each changes
    the sum by about 1 over 1. ``fraction``: where the noise is not known, the part of the sum of
    squares whose decrease does not matter. ``slopes``: the residual's, shape (residuals,
    parameters); without it they are found by finite differences.
    """
    here, value = first, residual(first)
    steep = slopes(here) if slopes else _differences(residual, here, value)
    damping = 1e-2
    for _ in range(rounds):
        products, gradient = steep.T @ steep, steep.T @ value
        gain = 0.0
        for _ in range(_MOST_TRIES):
            damped = products + np.diag(damping * np.diag(products) + 1e-9)
            there = here - np.linalg.solve(damped, gradient)
            new = residual(there)
            gain = float(value @ value - new @ new)
            if gain > 0.0:
                damping = max(0.1 * damping, 1e-6)
                here, value = there, new
                break
            damping *= 5.0
        if gain <= 0.0:
            break
        steep = slopes(here) if slopes else _differences(residual, here, value)
        if gain < (fraction * float(value @ value) if fraction else _LEAST_GAIN):
            break
    return here, value, steep


def _differences(
    residual: Callable[[FloatArray], FloatArray], here: FloatArray, value: FloatArray
) -> FloatArray:
    steps = DIFFERENCE * np.eye(len(here))
    return np.stack([(residual(here + step) - value) / DIFFERENCE for step in steps], axis=1)
