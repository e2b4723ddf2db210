"""How sure a rate is that was found by counting."""

import math
from numbers import Real
from statistics import NormalDist

from occ_model.errors import ParameterError, shown
from occ_model.scene.argument_checks import check_count

_MOST = 2**53
"""Trials that can be counted one by one in a float."""


def wilson_interval(successes: int, trials: int, level: float = 0.95) -> tuple[float, float]:
    """Give the interval of rates that are likely behind a count of successes.

    It holds every rate p from which the count s of n trials lies no further than z standard
    deviations, |s - n p| <= z sqrt(n p (1 - p)), and so ends where that is an equation:

    p = (2 s + z^2 -+ z sqrt(z^2 + 4 s (n - s) / n)) / (2 (n + z^2)),

    with z the normal deviate that a share ``level`` lies within (E. B. Wilson, "Probable inference,
    the law of succession, and statistical inference", J. Amer. Statist. Assoc. 22, 1927). Unlike
    s / n and its standard error it says something where all trials or none succeeded.

    Parameters
    ----------
    successes
        How many trials succeeded, s.
    trials
        How many there were, n.
    level
        Share of such intervals that hold the rate, between 0 and 1.

    Returns
    -------
    low, high : float
        From 0 to 1: exactly 0 where none succeeded, exactly 1 where all did.

    Raises
    ------
    ParameterError
        There are no trials or more than 2^53, more successes than trials, or no such level.
    """
    check_count("trials", trials, 1)
    check_count("successes", successes, 0)
    if trials > _MOST:
        raise ParameterError(
            f"trials is {shown(trials)}; allowed: a whole number from 1 to {_MOST}."
        )
    if successes > trials:
        raise ParameterError(
            f"successes is {shown(successes)}; allowed with {shown(trials)} trials: 0 to "
            f"{shown(trials)}."
        )
    share = _share(level)
    won, lost = int(successes), int(trials) - int(successes)
    # From the tail, which keeps its digits where the level is next to 1.
    z = -NormalDist().inv_cdf((1.0 - share) / 2.0)
    return _low(won, lost, z), 1.0 if lost == 0 else _high(won, lost, z)


def _share(level: object) -> float:
    number = isinstance(level, Real) and not isinstance(level, bool)
    share = float(level) if number and 0 < level < 1 else 0.0  # type: ignore[operator, arg-type]
    if not 0.0 < share < 1.0:
        raise ParameterError(f"level is {shown(level)}; allowed: a number between 0 and 1.")
    return share


def _high(won: int, lost: int, z: float) -> float:
    trials, square = won + lost, z * z
    root = z * math.sqrt(square + 4 * won * lost / trials)
    return (2 * won + square + root) / (2.0 * (trials + square))


def _low(won: int, lost: int, z: float) -> float:
    """Give the lower end as the product of both, (s / n) s / (n + z^2), over the upper one.

    Nothing is subtracted, so that a rate next to 0 keeps its digits.
    """
    if won == 0:
        return 0.0
    trials, square = won + lost, z * z
    root = z * math.sqrt(square + 4 * won * lost / trials)
    return 2 * won * won / trials / (2 * won + square + root)
