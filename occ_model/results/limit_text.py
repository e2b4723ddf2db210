"""Limits of a decoder in words."""

import math

from occ_model.errors import inflect, one_line
from occ_model.results.bit_errors import FRAMES_A_SECOND
from occ_model.results.limits import (
    Limits,
    RangeEnd,
    ReadInterval,
    TheoryLimits,
    Trial,
    WorkingRange,
)
from occ_model.scene.parameters import quantity
from occ_model.scene.payload import typed_form
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, SECOND

_DIGITS = 4  # significant digits, as the ends of a range are found to a few thousandths

_LONGEST_PAYLOAD = 24  # characters of a payload in a sentence


def sent_text(scene: Scene) -> str:
    """Describe what is sent in the pictures of a study: the scene's own code or payload."""
    transmitter = scene.transmitter
    if transmitter.payload:
        return f"“{one_line(typed_form(transmitter.payload), _LONGEST_PAYLOAD)}”"
    return f"code {transmitter.code}"


def present_rate_text(limits: Limits, frames_a_second: float = FRAMES_A_SECOND) -> str:
    """State what was read at the scene's own values, and the bits a second."""
    trial, bits = limits.frequency.own, limits.bits_a_second(frames_a_second)
    return (
        f"At {format_value(limits.frequency.parameter, trial.value)} it read {trial.whole} of "
        f"{trial.images} pictures of {sent_text(limits.scene)}, {trial.rate:.3g} % of the bits "
        f"({trial.low:.1f} to {trial.high:.1f} %): {bits:.4g} bits a second, if other codes are "
        "read as well."
    )


def format_value(parameter: str, value: float) -> str:
    """Format a frequency or an exposure time with the digits of the advice."""
    return quantity(parameter).format(value, _DIGITS)


def format_end(parameter: str, end: RangeEnd | None) -> str:
    """Format an end of a range as it is stated everywhere; ``"none"`` if nothing is read."""
    return "none" if end is None else format_value(parameter, end.value)


def end_text(parameter: str, end: RangeEnd) -> str:
    """State the 95 % interval of an end of a range, and how the end is known."""
    if end.fails is None:
        return f"{_trial_text(parameter, end.works, end)}; it was not searched beyond."
    trials = ", ".join(_trial_text(parameter, trial, end) for trial in (end.works, end.fails))
    if end.interval is None:
        return f"known to a step of the search: {trials}."
    return f"the end is between {interval_text(parameter, end.interval)}: {trials}."


def interval_text(parameter: str, interval: tuple[float, float]) -> str:
    """Format the 95 % interval of an end of a range."""
    low, high = (format_value(parameter, value) for value in sorted(interval))
    return f"{low} and {high} (95 %)"


def _trial_text(parameter: str, trial: Trial, end: RangeEnd) -> str:
    value = format_value(parameter, trial.value)
    place = "there" if value == format_end(parameter, end) else f"at {value}"
    if trial.whole == trial.images:
        return f"{place} it read every bit of {inflect(trial.images, 'image')}"
    return f"{place} {_rate_text(trial)}"


def limit_text(parameter: str, end: RangeEnd) -> str:
    """Format an end of a range, and say if it is only the end of the search."""
    value = value_text(parameter, end)
    return f"{value} (not searched beyond)" if end.fails is None else value


def value_text(parameter: str, end: RangeEnd) -> str:
    """Format an end of a range, and say if it is doubtful."""
    value = format_end(parameter, end)
    return value if end.is_sure else f"about {value}"


def others_text(working_range: WorkingRange) -> str:
    """State the first of the intervals beyond gaps, and how many more there are."""
    others = working_range.others
    if not others:
        return ""
    remainder = f" and {len(others) - 1} more" if others[1:] else ""
    return _span_text(working_range.parameter, others[0]) + remainder


def gaps_text(working_range: WorkingRange) -> str:
    """State all intervals beyond gaps; empty without any."""
    spans = [_span_text(working_range.parameter, each) for each in working_range.others]
    return f"With gaps between, it also reads {'; '.join(spans)}." if spans else ""


def _span_text(parameter: str, interval: ReadInterval) -> str:
    low, high = (format_end(parameter, end) for end in (interval.lowest, interval.highest))
    return f"at {low}" if low == high else f"from {low} to {high}"


def search_end_text(working_range: WorkingRange) -> str:
    """State where the search ended because the decoder would take too long."""
    highest = format_value(working_range.parameter, working_range.searched[1])
    return (
        f"Searched only up to {highest}, where an exposure covers {working_range.most_chips:.3g} "
        "chips; beyond it this decoder takes much longer."
    )


def search_sentences(limits: Limits) -> list[str]:
    """State the confidence of the ends, and what the search can miss."""
    step = 100.0 * (limits.frequency.step - 1.0)
    step_sentence = (
        f"Values were tried in steps of {step:.2g} %: a narrower gap or interval can be missed."
    )
    if not limits.frequency.intervals and not limits.exposure.intervals:
        return [step_sentence]
    return [
        f"Each end rests on at least {limits.images} images that were not used to choose it. "
        "Where it has a 95 % interval, the limit at which the most is read is stated.",
        step_sentence,
    ]


def theory_text(parameter: str, theory: TheoryLimits) -> str:
    """State the theoretical limits of a frequency or an exposure time."""
    text = (
        f"By theory the band model ends at {format_value(parameter, theory.band_model)} and an "
        f"alternating pattern at {format_value(parameter, theory.null)}"
    )
    if theory.saturation is None:
        return f"{text}."
    if math.isinf(theory.saturation):
        return f"{text}; without light nothing saturates."
    white_exposure = SECOND.format(theory.saturation, _DIGITS)
    return f"{text}; above {white_exposure}, completely lit columns are saturated."


def two_packets_text(frequency: float) -> str:
    """State the frequency below which some pictures lack the two headers that a decoder needs."""
    limit = HERTZ.format(frequency, _DIGITS)
    return (
        f"Below {limit} a picture does not contain two packets, and not always the two headers "
        "that this decoder needs."
    )


def _rate_text(trial: Trial) -> str:
    return f"{trial.rate:.3g} % in {trial.images} images ({trial.low:.1f} to {trial.high:.1f} %)"
