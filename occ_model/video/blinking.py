"""The frequency of light that is bright in some frames and dark in others.

The time of a rise of the light is known only to the frame, so it is rounded to a frame period.
"""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.results.clock import MeasuredValue
from occ_model.video.frame_period import fit_line, fit_rounded_period

_MIN_RISES = 4
_MAX_SCATTER = 0.35  # frame periods by which rises may scatter; rounding alone gives 0.29


def fit_blinking(times: FloatArray, levels: FloatArray) -> MeasuredValue | None:
    """Return the frequency in Hz at which frames become bright; None if it is not regular.

    ``times`` in seconds, in equal steps. Frequencies above half the frame rate look like lower
    ones.
    """
    low, high = np.quantile(levels, (0.1, 0.9))
    bright = levels > 0.5 * (low + high)
    rises = times[1:][bright[1:] & ~bright[:-1]]
    if len(rises) < _MIN_RISES:
        return None
    numbers, step = np.arange(float(len(rises))), float(np.ptp(times)) / (len(times) - 1)
    if fit_line(numbers, rises)[2] > _MAX_SCATTER * step:
        return None
    period = fit_rounded_period(numbers, rises, step)
    return MeasuredValue(1.0 / period.value, period.error / period.value**2)
