"""Lit fractions of exposures by the running sum of chips, computed apart from the program."""

import numpy as np

from occ_model.arrays import ByteArray, FloatArray

_SIDE = 9
"""Chips before the first and after the last one, which are as these."""


def lit_fractions(chips: ByteArray, starts: np.ndarray, exposure: float) -> FloatArray:
    """Return the lit fraction of each exposure, by the chips at which it starts and its length."""
    values = np.pad(chips.astype(float), _SIDE, mode="edge")
    running, places = np.concatenate([[0.0], np.cumsum(values)]), np.arange(len(values) + 1.0)
    first, last = (np.interp(starts + _SIDE + end, places, running) for end in (0.0, exposure))
    return np.asarray((last - first) / exposure)
