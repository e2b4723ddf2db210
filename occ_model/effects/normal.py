"""The standard normal distribution, from tables: its probabilities, and what a limit cuts off."""

import math
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray

FAR = 9.0
"""Standard deviations beyond which nothing of a normal distribution is left."""

_PER_DEVIATION = 256


@lru_cache(maxsize=1)
def _tables() -> tuple[FloatArray, FloatArray]:
    """Tabulate the probability Q(u) above u, and phi(u) - u Q(u), from -FAR to FAR."""
    u = np.arange(-FAR * _PER_DEVIATION, FAR * _PER_DEVIATION + 1.0) / _PER_DEVIATION
    beyond = np.array([0.5 * math.erfc(x / math.sqrt(2.0)) for x in u.tolist()])
    lost = np.exp(-0.5 * u * u) / math.sqrt(2.0 * math.pi) - u * beyond
    lost[-1] = 0.0
    return beyond, lost


def _place(u: FloatArray) -> np.ndarray:
    place = np.minimum(np.maximum(u, -FAR), FAR)
    place += FAR + 0.5 / _PER_DEVIATION
    place *= _PER_DEVIATION
    return place.astype(np.intp)


def normal_share(u: FloatArray) -> FloatArray:
    """Return the probability of a normal distribution below some standard deviations."""
    return _tables()[0].take(_place(-u))


def clipped_mean(levels: FloatArray, spread: FloatArray, white: float) -> FloatArray:
    """Return the mean of noisy pixels that are cut off at black and white.

    A normal deviation that is cut off u standard deviations from its mean loses phi(u) - u Q(u) of
    them.
    """
    lost = _tables()[1]
    least = np.maximum(spread, 1e-9)
    above = lost.take(_place(levels / least)) - lost.take(_place((white - levels) / least))
    return np.asarray(levels + least * above)


def share_unclipped(levels: FloatArray, spread: FloatArray, white: float) -> FloatArray:
    """Return the fraction of noisy pixels that are cut off neither at black nor at white."""
    least = np.maximum(spread, 1e-9)
    return normal_share(levels / least) - normal_share((levels - white) / least)
