"""Sentences of the advice: the measured and the theoretical limits of a decoder in words."""

from collections.abc import Sequence
from dataclasses import dataclass

from occ_model.errors import capitalize
from occ_model.results.bit_errors import FRAMES_A_SECOND
from occ_model.results.limit_text import (
    end_text,
    format_end,
    format_value,
    gaps_text,
    interval_text,
    limit_text,
    others_text,
    present_rate_text,
    search_end_text,
    search_sentences,
    sent_text,
    theory_text,
    two_packets_text,
)
from occ_model.results.limits import Advice, Limits, RangeEnd, WorkingRange
from occ_model.scene.parameters import quantity

_FREQUENCY = "switching_frequency"


@dataclass(frozen=True, slots=True)
class AdviceLine:
    text: str
    # What its button changes: a parameter, its new value in SI units, and the value as text
    destination: tuple[str, float, str] | None = None
    is_title: bool = False
    is_common: bool = False  # whether the line is the same for every decoder
    detail: str = ""  # how the text is known; shown with the lines that are details
    is_detail: bool = False


def make_advice_lines(advice: Advice, frames_a_second: float = FRAMES_A_SECOND) -> list[AdviceLine]:
    lines = [AdviceLine(_make_title(advice.limits), is_title=True)]
    if advice.cause:
        lines.append(AdviceLine(f"It does not read the scene as it is. {advice.cause}"))
    for values, theory, what in (
        (advice.limits.frequency, advice.frequency, "frequencies"),
        (advice.limits.exposure, advice.exposure, "exposures"),
    ):
        parameter, lowest, highest = values.parameter, values.lowest, values.highest
        if lowest is None or highest is None:
            lines.append(AdviceLine(_explain_unread(advice.limits, values)))
        else:
            lines += [
                _make_line(parameter, f"{what} down to", lowest),
                _make_line(parameter, f"{what} up to", highest),
            ]
        if values.others:
            lines.append(AdviceLine(gaps_text(values)))
        if values.most_chips is not None:
            lines.append(AdviceLine(search_end_text(values), is_detail=True))
        if values.faults:
            lines.append(AdviceLine(values.faults))
        if theory.two_packets is not None:
            lines.append(AdviceLine(two_packets_text(theory.two_packets), is_detail=True))
        lines.append(AdviceLine(theory_text(parameter, theory), is_common=True, is_detail=True))
    lines.append(AdviceLine(present_rate_text(advice.limits, frames_a_second)))
    lines += [
        AdviceLine(text, is_common=True, is_detail=True) for text in search_sentences(advice.limits)
    ]
    return lines


def make_rough_sentence(decoder: str, frequencies: WorkingRange) -> str:
    """State what one picture at each frequency says."""
    highest = frequencies.highest
    found = f"up to roughly {format_end(_FREQUENCY, highest)}" if highest else "roughly none"
    return f"The {decoder} decoder reads frequencies {found}, by one picture at each."


def make_frequency_line(advice: Advice) -> AdviceLine:
    frequencies = advice.limits.frequency
    if frequencies.highest is None:
        return AdviceLine(_explain_unread(advice.limits, frequencies))
    return _make_line(frequencies.parameter, "frequencies up to", frequencies.highest)


def make_answer(found: Sequence[Advice], sought: Sequence[str]) -> tuple[str, str]:
    """State the highest frequencies of some decoders, and the 95 % intervals of those ends.

    ``sought``: further decoders whose limits are still searched for.
    """
    parts: list[str] = []
    intervals: list[str] = []
    for advice in found:
        decoder, frequencies = advice.limits.decoder, advice.limits.frequency
        end = frequencies.highest
        name = "paper's threshold" if decoder == "threshold" else decoder
        reads = "at no frequency" if end is None else f"up to {limit_text(_FREQUENCY, end)}"
        again = f", again {others_text(frequencies)}" if frequencies.others else ""
        parts.append(f"the {name} decoder {'' if parts else 'reads '}{reads}{again}")
        if end is not None and end.interval is not None:
            place = interval_text(_FREQUENCY, end.interval)
            intervals.append(f"The {decoder} decoder's true end is between {place}.")
    if sought:
        still = "still " if found else ""
        parts.append(f"{still}searching for the highest frequency of {' and '.join(sought)}")
    text = "; ".join(parts)
    if found:
        exposure = float(found[0].limits.scene.value("exposure_time"))
        text = f"at {format_value('exposure_time', exposure)} {text}"
    return f"{capitalize(text)}." if text else "", " ".join(intervals)


def describe_outdated(parameters: frozenset[str]) -> str:
    """State that the advice is for an earlier scene, and which of its limits still hold."""
    text = "This advice is for the scene before the change."
    if not parameters:
        return text
    names = " and ".join(sorted(quantity(name).in_sentence for name in parameters))
    return f"{text} Its limits for the {names} still hold."


def _explain_unread(limits: Limits, values: WorkingRange) -> str:
    best, parameter = values.best, values.parameter
    if best is None:
        return values.failure or ""
    low, high, place = (format_value(parameter, v) for v in (*values.searched, best.value))
    name = quantity(parameter).in_sentence
    return (
        f"It reads {limits.rate:g} % of the bits at no {name} from {low} to {high}. The most "
        f"it reads is {best.right} of {best.sent} bits, at {place}."
    )


def _make_title(limits: Limits) -> str:
    scene = limits.scene
    values = (
        format_value(name, float(scene.value(name)))
        for name in ("switching_frequency", "exposure_time", "distance")
    )
    return (
        f"The {limits.decoder} decoder, {limits.rate:g} % of the bits of "
        f"{sent_text(scene)}, at {', '.join(values)}"
    )


def _make_line(parameter: str, up_to: str, end: RangeEnd) -> AdviceLine:
    detail = capitalize(end_text(parameter, end))
    text = f"It reads {up_to} {limit_text(parameter, end)}"
    if not end.is_sure:
        return AdviceLine(f"{text}; no value within is sure to be read.", detail=detail)
    destination = (parameter, end.value, format_end(parameter, end))
    return AdviceLine(f"{text}.", destination, detail=detail)
