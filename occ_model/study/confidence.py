"""Compute Wilson's confidence interval of a success rate, from trials or from pictures."""

import math
from collections.abc import Iterable, Sequence
from statistics import NormalDist

from occ_model.errors import ParameterError, quote
from occ_model.results.limits import Trial
from occ_model.scene.argument_checks import check_count, is_number

_MAX_TRIALS = 2**53  # up to which a float represents every integer


def wilson_interval(successes: int, trials: int, level: float = 0.95) -> tuple[float, float]:
    """Return Wilson's confidence interval of a success rate.

    It contains every rate p whose expected count lies within z standard deviations of the count s
    in n trials, |s - n p| <= z sqrt(n p (1 - p)). Its ends solve the equation:

    p = (2 s + z^2 -+ z sqrt(z^2 + 4 s (n - s) / n)) / (2 (n + z^2)),

    where a standard normal deviate lies within -z and z with the probability ``level`` (E. B.
    Wilson, "Probable inference, the law of succession, and statistical inference", J. Amer.
    Statist. Assoc. 22, 1927). Unlike an interval of s / n and its standard error, it is not empty
    when all trials or none succeed.

    Parameters
    ----------
    successes
        Number of trials that succeeded, s.
    level
        Fraction of such intervals that contain the true rate, between 0 and 1.

    Returns
    -------
    low, high : float
        From 0 to 1: exactly 0 if none succeeded, exactly 1 if all did.

    Raises
    ------
    ParameterError
        There are no trials or more than 2^53, more successes than trials, or the level is out of
        range.
    """
    check_count("trials", trials, 1, _MAX_TRIALS)
    check_count("successes", successes, 0, int(trials))
    # Computed from the tail, which keeps its digits when the level is close to 1.
    z = -NormalDist().inv_cdf((1.0 - _check_level(level)) / 2.0)
    return _interval(int(successes), int(trials) - int(successes), z)


def interval_of_pictures(right: int, sent: int, pictures: int) -> tuple[float, float]:
    """Return the 95 % interval of the fraction of correct bits in percent; NaN without bits.

    A picture's bits are read together or not at all, so the pictures are the trials: this is
    Wilson's interval for the sum of their fractions of correct bits. If pictures are read in part,
    the rate scatters less and the interval is wider than necessary.
    """
    if not sent:
        return math.nan, math.nan
    successes = pictures * right / sent
    low, high = _interval(successes, pictures - successes, TWO_SIDED_DEVIATE)
    return 100.0 * low, 100.0 * high


TWO_SIDED_DEVIATE = NormalDist().inv_cdf(0.975)  # standard deviations of a 95 % interval


def trial_of(value: float, counts: Sequence[int], bits: int) -> Trial:
    """Return the trial at a value of a parameter, from the counts of correct bits by image."""
    right, sent = sum(counts), len(counts) * bits
    low, high = interval_of_pictures(right, sent, len(counts))
    return Trial(value, right, sent, low, high, len(counts), list(counts).count(bits))


_REFUTING_PROBABILITY = 0.025  # that a true rate is rejected: one side of a 95 % interval
_STAKES = (0.03, 0.1, 0.3)  # fractions of the maximum bet: small ones detect small deficits


def count_until_refuted(counts: Iterable[float], bits: int, least: float) -> list[float] | None:
    """Return counts of correct bits until they refute the fraction ``least``; None if none do.

    A bet on each image that fewer bits are read, at fair odds if the fraction is reached,
    multiplies its initial stake by c at some time with a probability of at most 1 / c (J. Ville,
    *Etude critique de la notion de collectif*, 1939). The test therefore holds although it stops at
    its own result. A fraction of 1 is refuted by the first image with a wrong bit.
    """
    wealth, refuting = [1.0] * len(_STAKES), []
    for right in counts:
        refuting.append(right)
        if least >= 1.0:
            if right < bits:
                return refuting
            continue
        gain = (least - right / bits) / (1.0 - least)
        wealth = [
            share * (1.0 + stake * gain) for share, stake in zip(wealth, _STAKES, strict=True)
        ]
        if sum(wealth) * _REFUTING_PROBABILITY >= len(_STAKES):
            return refuting
    return None


def _interval(successes: float, failures: float, z: float) -> tuple[float, float]:
    middle = 2 * successes + z * z
    root = z * math.sqrt(z * z + 4 * successes * failures / (successes + failures))
    # The product of both ends is (s / n) s / (n + z^2), and a quotient loses no digits near 0.
    low = 2 * successes * successes / (successes + failures) / (middle + root) if successes else 0.0
    high = (middle + root) / (2.0 * (successes + failures + z * z)) if failures else 1.0
    return low, high


def _check_level(level: object) -> float:
    fraction = float(level) if is_number(level) and 0 < level < 1 else 0.0
    if not 0.0 < fraction < 1.0:
        raise ParameterError.of("level", quote(level), "a number between 0 and 1")
    return fraction
