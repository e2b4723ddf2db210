"""Why an explanation of stripes is doubtful, by the figures of its fit and by other readings."""

from occ_model.errors import distinct_texts
from occ_model.photo.evidence.hypothesis import Hypothesis
from occ_model.photo.fit.best_timing import CLIPPED_FRACTION
from occ_model.photo.fit.chip_runs import chips_if_longer, runs_of
from occ_model.photo.stripes.period import unrepeated_fraction
from occ_model.results.match import Stripes

_LEAST_PERIODS = 1.5  # minimum periods in view of a long pattern that is given
_LEAST_PERIODS_OF_OTHERS = 3.0  # the same of a short pattern, or of one that was read
_LONG_PATTERN = 8  # minimum number of chips of a long pattern
_LONGEST_EXPOSURE = 3.2  # exposure in chips above which codes make nearly the same stripes
_LEAST_CORRELATION = 0.9  # correlation below which something else also shapes the stripes

LEAST_INFORMATION = {False: 40.0, True: 100.0}
"""Minimum information in bits of given chips, and of chips that were read."""

_MOST_UNEXPLAINED = 0.035  # maximum unexplained fraction of the variance for chips that were read
_MOST_RATIO_TO_WAVE = 2.0  # maximum ratio of it to what the best periodic wave leaves
_ALLOWED_UNEXPLAINED = 0.02  # unexplained fraction that is always allowed: cameras differ
_LEAST_ROW_CORRELATION = 0.85  # minimum correlation between the stripes of different rows
_MOST_SATURATED = 0.5  # saturated fraction above which chips that were read are doubtful

_MOST_SATURATED_FOR_EXPOSURE = 0.4
"""Saturated fraction above which the exposure time is doubtful: of 34 exposures of such photographs
only 79 % were within two standard deviations (seeds 700000 to 700599)."""


def doubts(found: Hypothesis, stripes: Stripes, row_correlation: float) -> list[str]:
    return [
        *_doubts_by_extent(found),
        *_doubts_by_quality(found, stripes.saturated, row_correlation),
        *(_doubts_by_reading(found, stripes) if found.was_read else ()),
    ]


def exposure_doubts(found: Hypothesis, stripes: Stripes) -> list[str]:
    """Return why the exposure of a hypothesis is doubtful, also where its chips are not."""
    if stripes.saturated <= _MOST_SATURATED_FOR_EXPOSURE:
        return []
    if found.was_read and stripes.saturated > _MOST_SATURATED:
        return []  # then nothing of it is sure, for the same reason
    return [_too_white(stripes.saturated, _MOST_SATURATED_FOR_EXPOSURE)]


def _too_white(saturated: float, most: float) -> str:
    shown, limit = distinct_texts(100.0 * saturated, 100.0 * most)
    return (
        f"{shown} % of the pixels are saturated, which hides how bright they were; at most "
        f"{limit} % are allowed."
    )


def _doubts_by_extent(found: Hypothesis) -> list[str]:
    reasons = []
    chips = len(found.chips)
    is_long = chips >= _LONG_PATTERN and not found.was_read
    least = _LEAST_PERIODS if is_long else _LEAST_PERIODS_OF_OTHERS
    if found.periods < least:
        shown, limit = distinct_texts(found.periods, least)
        reasons.append(
            f"Only {shown} periods of {chips} chips are in view; at least {limit} are needed."
        )
    shortest = min(runs_of(found.chips))
    exposure = found.fit.timing.exposure / shortest
    if exposure > _LONGEST_EXPOSURE:
        what = "a chip" if shortest == 1 else f"the shortest pulse of {shortest} chips"
        shown, limit = distinct_texts(exposure, _LONGEST_EXPOSURE)
        reasons.append(
            f"The exposure is {shown} times as long as {what}; above {limit} different "
            "codes give nearly the same stripes."
        )
    return reasons


def _doubts_by_quality(found: Hypothesis, saturated: float, row_correlation: float) -> list[str]:
    reasons = []
    correlation = found.fit.correlation
    if correlation < _LEAST_CORRELATION:
        shown, limit = distinct_texts(correlation, _LEAST_CORRELATION, 2)
        reasons.append(
            f"The correlation is {shown}; below {limit} something else shapes the stripes too, "
            "such as the shape of the lamp."
        )
    least = LEAST_INFORMATION[found.was_read]
    if found.information < least:
        shown, limit = distinct_texts(found.information, least, 0)
        reasons.append(
            f"The fit is better than one by chance by {shown} bits only; at least {limit} are "
            "needed."
        )
    if row_correlation < _LEAST_ROW_CORRELATION:
        shown, limit = distinct_texts(row_correlation, _LEAST_ROW_CORRELATION, 2)
        reasons.append(
            f"The rows show the same stripes only with a correlation of {shown}; at least {limit} "
            "is needed."
        )
    if saturated > _MOST_SATURATED and found.was_read:
        reasons.append(_too_white(saturated, _MOST_SATURATED))
    return reasons


def _doubts_by_reading(found: Hypothesis, stripes: Stripes) -> list[str]:
    if found.read_again:
        return [
            "What is sent was found by trying many sequences of chips, some of which may explain "
            "the stripes of any object."
        ]
    reasons = []
    count, (together, longer) = len(found.chips), chips_if_longer(found.chips)
    if together > 1 and stripes.saturated > CLIPPED_FRACTION:
        reasons.append(
            f"{100.0 * stripes.saturated:.0f} % of the pixels are saturated, which lengthens "
            f"bright pulses: if each is longer by {longer} of the {count} chips that were read, "
            f"{count // together} chips that last {together} times as long explain the same edges."
        )
    if stripes.period is None:
        return reasons
    left = 1.0 - max(found.fit.correlation, 0.0) ** 2
    repeated = unrepeated_fraction(stripes.flattened, stripes.period)
    most = max(_MOST_RATIO_TO_WAVE * repeated, _ALLOWED_UNEXPLAINED)
    allowed = min(most, _MOST_UNEXPLAINED)
    if left > allowed:
        shown, limit = distinct_texts(100.0 * left, 100.0 * allowed)
        reasons.append(
            f"What was read from the stripes leaves {shown} % of them unexplained; at most "
            f"{limit} % are allowed."
        )
    return reasons
