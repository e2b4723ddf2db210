"""When an explanation is refused: something else explains the stripes better, or chance does."""

from occ_model.photo.evidence.hypothesis import Hypothesis
from occ_model.photo.fit.chip_runs import is_single_pulse
from occ_model.results.match import PLAIN_STRIPES

_LEAST_GIVEN, _LEAST_READ = 0.8, 0.9  # minimum correlations of chips given and read

_LEAST_OF_OBJECTS = 0.975
"""Minimum correlation of chips that were read where no lamp is known to blink: some chips explain
the stripes of any regular object about as well."""

_LEAST_INFORMATION = 30.0  # minimum bits: the best of many timings has 15 to 20 in any picture
_LEAST_ROW_CORRELATION = 0.7  # minimum correlation between the stripes of different rows


def refusals(
    found: Hypothesis,
    *,
    curve: float,
    wave: float,
    likelihood: float,
    rows_alike: float,
    blinks: bool,
) -> list[str]:
    """Say why a hypothesis is refused, in sentences.

    ``curve``, ``wave`` and ``likelihood`` are log-likelihoods: of a smooth curve, of any periodic
    wave, and of the hypothesis.
    """
    least = _LEAST_GIVEN
    if found.was_read:
        least = _LEAST_READ if blinks else _LEAST_OF_OBJECTS
    what = found.sent[0].upper() + found.sent[1:]
    if found.fit.correlation < least:
        return [
            f"{what} does not explain the stripes: the best correlation is "
            f"{found.fit.correlation:.2f}; at least {least} is needed."
        ]
    reasons = []
    if found.was_read and not blinks and is_single_pulse(found.chips):
        share = 100.0 * float(found.chips.mean())
        columns = len(found.chips) / found.fit.timing.step
        reasons += [
            PLAIN_STRIPES,
            f"They repeat after {columns:.1f} columns and are bright for {share:.0f} % of them, as "
            "those of any regular object are, such as a blind.",
        ]
    elif found.was_read and not blinks and likelihood < wave:
        reasons.append(
            "A wave of another shape that repeats as often, as of any regular object, explains the "
            f"stripes better than {found.sent}."
        )
    if found.information < _LEAST_INFORMATION:
        reasons.append(
            f"{what} explains the stripes hardly better than chance: {found.chips_in_view:.1f} "
            f"chips are in view, and the exposure is {found.fit.timing.exposure:.1f} chips long."
        )
    if likelihood < curve:
        reasons.append(
            "Light that varies slowly, without any code, explains the stripes better than "
            f"{found.sent}."
        )
    if rows_alike < _LEAST_ROW_CORRELATION:
        reasons.append(
            "The rows do not show the same stripes: their correlation is "
            f"{rows_alike:.2f}; at least {_LEAST_ROW_CORRELATION} is needed."
        )
    return reasons
