"""The normal distribution's probability, tabulated: many times faster than a function's call."""

import math
from functools import lru_cache

import numpy as np

from occ_model.arrays import FloatArray

_END = 8.0  # standard deviations that are tabulated; not one of 1e14 values is beyond
_PER_DEVIATION = 512  # entries for each standard deviation


def normal_fraction(u: FloatArray) -> FloatArray:
    """Return the probability that a normal variable is below u deviations, to within 2e-7."""
    place = np.minimum(np.maximum(u, -_END), _END)
    place += _END
    place *= _PER_DEVIATION
    entry = place.astype(np.int32)
    place -= entry
    fractions, steps = _table()
    return np.asarray(fractions.take(entry) + place * steps.take(entry))


@lru_cache(maxsize=1)
def _table() -> tuple[FloatArray, FloatArray]:
    entries = 2 * round(_END) * _PER_DEVIATION + 1
    places = (np.arange(entries) / _PER_DEVIATION - _END) / math.sqrt(2.0)
    fractions = np.array([0.5 * math.erfc(-u) for u in places.tolist()])
    return fractions, np.append(np.diff(fractions), 0.0)
