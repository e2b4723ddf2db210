"""Explanations of a profile without a code: a periodic wave of any shape, and a smooth curve."""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.evidence.hypothesis import Hypothesis, log_likelihood
from occ_model.photo.stripes.period import harmonics_within, without_repetition


def likelihood_of_wave(
    profile: FloatArray, found: Hypothesis, independent: float, error: float
) -> float:
    """Return the log-likelihood of a wave that repeats as often as the chips of a hypothesis do.

    Its amplitude and mean follow the levels of the hypothesis' fit. ``independent`` columns count,
    and ``error`` is a sum of squares that every explanation may leave.
    """
    columns = len(profile)
    period = len(found.chips) / found.fit.timing.step
    flattened = (profile - found.fit.low) / found.fit.swing
    left = without_repetition(flattened, period) * found.fit.swing
    # The period itself, and a cosine and a sine of each harmonic, beside the levels.
    freedom = found.freedom - 2 + 2 * harmonics_within(columns, period)
    return log_likelihood(float(left @ left) + error, columns, independent, freedom)


def likelihood_of_curve(profile: FloatArray, most: int, independent: float, error: float) -> float:
    """Return the log-likelihood of as few cosines, from the slowest, as are worth their number.

    At most so many are tried; ``independent`` and ``error`` as for a wave.
    """
    # Imported only when a photo is matched: it is slow.
    from scipy.fft import dct

    about = profile - profile.mean()
    whole = float(about @ about)
    explained = np.cumsum(dct(about, norm="ortho") ** 2)
    count = np.arange(1, max(2, min(most, len(profile) // 2)) + 1)
    left = np.maximum(whole - explained[count - 1], 1e-9 * max(whole, 1e-9))
    return max(
        log_likelihood(power + error, len(profile), independent, number + 1)
        for number, power in zip(count.tolist(), left.tolist(), strict=True)
    )
