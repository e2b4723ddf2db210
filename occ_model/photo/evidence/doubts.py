"""Why an explanation of stripes is doubtful, by the figures of its own fit and of what is near."""

from occ_model.photo.evidence.hypothesis import Hypothesis, is_single_pulse, runs_of

_LEAST_PERIODS = 1.5
"""Periods of a long pattern in view below which hardly a chip is seen twice."""

_LEAST_READ_PERIODS = 2.0
"""The same for a pattern that was read: then each of its chips must be seen twice."""

_LONG_PATTERN = 8
"""Chips from which a pattern counts as long."""

_LEAST_WAVES = 3.0
"""Periods in view below which a short pattern may be a coincidence."""

_LONGEST_EXPOSURE = 3.2
"""Exposure in chips above which different codes give nearly the same stripes."""

_LEAST_CORRELATION = 0.9
"""Correlation below which something other than the fitted model shapes the stripes."""

_LEAST_INFORMATION = 45.0
"""Bits by which a fit must be better than chance to be sure."""

_LEAST_ALIKE = 0.85
"""Correlation of the rows' stripes with each other below which they may be a picture's objects."""

_MOST_SATURATED = 0.5
"""Share of white pixels above which the shape of the stripes is mostly unknown."""


def doubts(found: Hypothesis, saturated: float, rows_alike: float) -> list[str]:
    """Say why a hypothesis is doubtful, in sentences.

    Parameters
    ----------
    found
        The hypothesis.
    saturated
        Share of the region's pixels that are white.
    rows_alike
        Correlation of the rows' stripes with each other.
    """
    return [
        *_doubts_by_extent(found),
        *_doubts_by_quality(found, saturated, rows_alike),
    ]


def _doubts_by_extent(found: Hypothesis) -> list[str]:
    reasons = []
    chips = len(found.chips)
    least = _LEAST_READ_PERIODS if found.was_read else _LEAST_PERIODS
    least = least if chips >= _LONG_PATTERN else _LEAST_WAVES
    if found.periods < least:
        reasons.append(
            f"Only {found.periods:.2g} periods of {chips} chips are in view; at least {least:g} "
            "are needed."
        )
    shortest = min(runs_of(found.chips))
    exposure = found.fit.timing.exposure / shortest
    if exposure > _LONGEST_EXPOSURE:
        what = "a chip" if shortest == 1 else f"the shortest pulse of {shortest} chips"
        reasons.append(
            f"The exposure is {exposure:.2g} times as long as {what}; above {_LONGEST_EXPOSURE} "
            "different codes give nearly the same stripes."
        )
    if found.was_read and is_single_pulse(found.chips):
        reasons.append(
            "The stripes are one pulse repeated, as those of any regular object are: that they are "
            "a lamp's is not known from the photo."
        )
    return reasons


def _doubts_by_quality(found: Hypothesis, saturated: float, rows_alike: float) -> list[str]:
    reasons = []
    correlation = found.fit.correlation
    if correlation < _LEAST_CORRELATION:
        reasons.append(
            f"The correlation is {correlation:.2f}; below {_LEAST_CORRELATION} something else "
            "shapes the stripes too, such as the shape of the lamp."
        )
    if found.information < _LEAST_INFORMATION:
        reasons.append(
            f"The fit is better than one by chance by {found.information:.0f} bits only; at least "
            f"{_LEAST_INFORMATION:.0f} are needed."
        )
    if rows_alike < _LEAST_ALIKE:
        reasons.append(
            f"The rows show the same stripes only with a correlation of {rows_alike:.2f}; at least "
            f"{_LEAST_ALIKE} is needed."
        )
    if saturated > _MOST_SATURATED:
        reasons.append(
            f"{100.0 * saturated:.0f} % of the pixels are white, which hides how bright they were; "
            f"at most {100.0 * _MOST_SATURATED:.0f} % are allowed."
        )
    return reasons
