"""The light that exposures gather of a wave that repeats, by its exact integral."""

import numpy as np
from numpy.typing import ArrayLike


def mean_light(levels: ArrayLike, begin: np.ndarray, exposure: float) -> np.ndarray:
    """Return the mean light of exposures that begin at some times, in lengths of a level.

    It is what the integral of the levels, sent again and again, rises by during an exposure.
    """
    integral = np.concatenate([[0.0], np.cumsum(levels)])
    period = len(integral) - 1

    def until(time: np.ndarray) -> np.ndarray:
        rounds = np.floor(time / period)
        part = np.interp(time - rounds * period, np.arange(period + 1.0), integral)
        return np.asarray(rounds * integral[-1] + part)

    return np.asarray((until(begin + exposure) - until(begin)) / exposure)
