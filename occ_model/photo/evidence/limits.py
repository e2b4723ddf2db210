"""Limits of what a fit can tell for sure, by the fit's own figures."""

from itertools import groupby

from occ_model.results import Match

_LEAST_PERIODS = 1.5
"""Periods of a long pattern in view below which hardly a chip is seen twice."""

_LONG_PATTERN = 8
"""Chips from which a pattern counts as long."""

_LEAST_WAVES = 3.0
"""Periods in view below which a short pattern may be a coincidence."""

_LONGEST_EXPOSURE = 3.2
"""Exposure in chips above which different codes give nearly the same stripes."""

_LEAST_CORRELATION = 0.9
"""Correlation below which something other than the fitted model shapes the stripes."""


def doubts_by_limits(match: Match) -> tuple[str, ...]:
    """Name the limits that a match exceeds, each in a sentence."""
    reasons = []
    periods, chips = match.periods_in_view, len(match.pattern)
    least = _LEAST_PERIODS if chips >= _LONG_PATTERN else _LEAST_WAVES
    if periods < least:
        reasons.append(
            f"Only {periods:.2g} periods of the pattern are in view; at least {least:g} of "
            f"{chips} chips are needed."
        )
    shortest = _shortest_run(match.pattern)
    exposure = match.exposure_in_chips / shortest
    if exposure > _LONGEST_EXPOSURE:
        what = "a chip" if shortest == 1 else f"the shortest pulse of {shortest} chips"
        reasons.append(
            f"The exposure is {exposure:.2g} times as long as {what}; above {_LONGEST_EXPOSURE} "
            "different codes give nearly the same stripes."
        )
    if match.correlation < _LEAST_CORRELATION:
        reasons.append(
            f"The correlation is {match.correlation:.2f}; below {_LEAST_CORRELATION} something "
            "else shapes the stripes too, such as the shape of the lamp."
        )
    return tuple(reasons)


def _shortest_run(pattern: str) -> int:
    """Count the chips of a repeated pattern's shortest run of equal chips."""
    change = next((i for i, chip in enumerate(pattern) if chip != pattern[0]), 0)
    turned = pattern[change:] + pattern[:change]
    return min(len(list(run)) for _, run in groupby(turned))
