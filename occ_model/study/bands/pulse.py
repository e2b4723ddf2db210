"""Closed-form depth of the bars of a lamp dimmed by pulse-width modulation."""

import math
from fractions import Fraction

from occ_model.errors import ParameterError, shown
from occ_model.results.bands import Depth


def pulse_depth(duty: float, periods: float | Fraction) -> Depth:
    """Return the depth of the bars of a lamp with pulse-width modulation.

    Of an exposure of a = n + r periods the n whole ones hold the same light for any start.
    The light of the rest varies by h = min(r, 1 - r, D, 1 - D) periods: a trapezoid over the start,
    h / (a D) peak to peak relative to the mean. With M = max(min(r, 1 - r), min(D, 1 - D)) its root
    mean square is sqrt(h^2 (M (1 - M) - h / 3)) / (a D).

    Parameters
    ----------
    duty
        Fraction D of a period in which the lamp is lit, above 0 and at most 1.
    periods
        Length a of the exposure in periods, above 0, exact as a fraction.

    Raises
    ------
    ParameterError
        An argument is out of range.
    """
    if not 0.0 < duty <= 1.0:
        raise ParameterError.of("duty", shown(duty), "above 0, up to 1")
    if not 0.0 < periods < math.inf:
        raise ParameterError.of("periods", shown(periods), "above 0")
    exact, lit = Fraction(periods), Fraction(duty)
    rest = exact % 1
    short = sorted([min(rest, 1 - rest), min(lit, 1 - lit)])
    height, longer = short
    mean = exact * lit
    spread = longer * (1 - longer) - height / 3
    return Depth(float(height / mean), float(height / mean) * math.sqrt(spread))
