"""A hypothesis about what was sent, with the fit that explains the stripes by it."""

import math
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.chip_runs import canonical
from occ_model.photo.fit.least_squares import StripeFit, level_freedom


@dataclass(frozen=True, eq=False, slots=True)
class Hypothesis:
    """What is supposed to be sent, and how that explains a photo's stripes."""

    sent: str  # in words
    explanation: Explanation
    fit: StripeFit
    bits: float  # bits of the chips that were chosen to fit the stripes; 0 for given chips
    was_read: bool
    # Whether the chips were found by trying many sequences, as those read first explained little.
    read_again: bool = False

    @property
    def chips(self) -> ByteArray:
        return self.explanation.chips

    @property
    def chips_in_view(self) -> float:
        """Number of chips sent while the columns are read out."""
        return self.fit.timing.step * len(self.fit.profile)

    @property
    def periods(self) -> float:
        """How many times the chips are sent while the columns are read out."""
        return self.chips_in_view / len(self.chips)

    @property
    def information(self) -> float:
        """Bits by which the fit is better than one by chance, less those of its chosen chips.

        A profile of N independent Gaussian values reaches the correlation r with a given one with a
        probability of about (1 - r^2)^(N/2). An exposure of several chips leaves fewer values.
        """
        independent = self.chips_in_view / max(1.0, self.fit.timing.exposure)
        unexplained = max(1.0 - max(self.fit.correlation, 0.0) ** 2, 1e-12)
        return -0.5 * independent * math.log2(unexplained) - self.bits

    @property
    def freedom(self) -> int:
        """Number of parameters of the fit: its levels, step, exposure and phase."""
        return 3 + 2 * level_freedom(self.chips_in_view)

    def residual(self, profile: FloatArray) -> FloatArray:
        return profile - self.fit.profile


def log_likelihood(squares: float, columns: int, independent: float, freedom: float) -> float:
    """Return the logarithm of a fit's likelihood, less a penalty for its ``freedom`` parameters.

    Half of the Bayesian information criterion, negative (Schwarz, Ann. Stat. 6:461, 1978), for
    Gaussian residuals with a sum of ``squares``, of which only some are independent.
    """
    variance = max(squares / columns, 1e-12)
    return -0.5 * independent * math.log(variance) - 0.5 * freedom * math.log(max(independent, 2.0))


def is_rotation(one: Hypothesis, other: Hypothesis) -> bool:
    """Whether two hypotheses are the same endless sequence of chips."""
    return np.array_equal(canonical(one.chips), canonical(other.chips))
