"""The explanation without a code: any wave that repeats, as of a regular object."""

from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.photo.evidence.hypothesis import Hypothesis, log_likelihood
from occ_model.photo.stripes.period import harmonics_within, without_repetition


@dataclass(frozen=True, slots=True)
class RepeatedWave:
    """A wave of any shape with the period of a hypothesis' chips.

    Parameters
    ----------
    numbers
        How many numbers describe it.
    likelihood
        Logarithm of its likelihood, less the penalty for these numbers.
    """

    numbers: int
    likelihood: float


def repeated_wave(
    profile: FloatArray, found: Hypothesis, independent: float, error: float
) -> RepeatedWave:
    """Describe a profile by a wave that repeats as often as the chips of a hypothesis do.

    Its amplitude and mean follow the levels of the hypothesis' fit.

    Parameters
    ----------
    profile : ndarray of float64, shape (columns,)
        Grey levels.
    independent
        Number of columns that count as independent.
    error
        Sum of squared differences that count as none, as with the wave's rivals.
    """
    columns = len(profile)
    period = len(found.chips) / found.fit.timing.step
    flattened = (profile - found.fit.low) / found.fit.swing
    left = without_repetition(flattened, period) * found.fit.swing
    # The period itself, and a cosine and a sine of each harmonic, beside the levels.
    numbers = 1 + 2 * harmonics_within(columns, period)
    power = float(left @ left) + error
    freedom = found.freedom - 3 + numbers
    return RepeatedWave(numbers, log_likelihood(power, columns, independent, freedom))
