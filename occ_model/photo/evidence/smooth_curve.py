"""The explanation without a code: a smooth curve of as few numbers as explain the stripes."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.photo.evidence.hypothesis import log_likelihood


@dataclass(frozen=True, slots=True)
class SmoothCurve:
    """A smooth curve through a profile.

    Parameters
    ----------
    numbers
        How many numbers describe it.
    likelihood
        Logarithm of its likelihood, less the penalty for these numbers.
    correlation
        Its correlation with the profile.
    """

    numbers: int
    likelihood: float
    correlation: float


def best_smooth_curve(
    profile: FloatArray, most: int, independent: float, error: float
) -> SmoothCurve:
    """Describe a profile by as few cosines as pays, from the slowest.

    Parameters
    ----------
    profile : ndarray of float64, shape (columns,)
        Grey levels.
    most
        Largest number of cosines.
    independent
        Number of columns that count as independent.
    error
        Sum of squared differences that count as none, as with the curve's rivals.
    """
    # Imported only when a photo is matched: it is slow.
    from scipy.fft import dct

    about = profile - profile.mean()
    whole = float(about @ about)
    explained = np.cumsum(dct(about, norm="ortho") ** 2)
    count = np.arange(1, max(2, min(most, len(profile) // 2)) + 1)
    left = np.maximum(whole - explained[count - 1], 1e-9 * max(whole, 1e-9))
    likelihoods = [
        log_likelihood(power + error, len(profile), independent, number + 1)
        for number, power in zip(count.tolist(), left.tolist(), strict=True)
    ]
    best = int(np.argmax(likelihoods))
    share = 1.0 - float(left[best]) / max(whole, 1e-9)
    return SmoothCurve(best + 1, likelihoods[best], float(np.sqrt(max(share, 0.0))))
