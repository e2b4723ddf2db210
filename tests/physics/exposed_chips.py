"""Chips of Manchester code in noisy rows, simulated in closed form without our code.

The signal-to-noise ratio is the chips' variance, 1/4, over the variance of a row's noise.
"""

import math

import numpy as np
from lit_fractions import lit_fractions


def manchester(bits: np.ndarray) -> np.ndarray:
    """Code each bit as a change in its middle: 0 as 1 0, 1 as 0 1."""
    return np.stack([1 - bits, bits], axis=1).ravel()


def expose_rows(chips: np.ndarray, exposure: float, step: float, phase: float) -> np.ndarray:
    """Average chips over each row's exposure."""
    rows = int((len(chips) - exposure - phase) / step)
    return lit_fractions(chips, phase + step * np.arange(rows), exposure)


def noise_of(decibels: float) -> float:
    """Return the standard deviation of a row's noise at a signal-to-noise ratio."""
    return math.sqrt(0.25 / 10.0 ** (decibels / 10.0))
