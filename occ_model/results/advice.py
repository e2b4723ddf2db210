"""Advice on a scene, with limits by trial and by theory, and its sentences."""

import math
from dataclasses import dataclass

from occ_model.errors import one_line
from occ_model.results.bit_errors import FRAMES_A_SECOND
from occ_model.results.limits import Limits, RangeEnd, Trial, WorkingRange
from occ_model.scene.parameters import quantity
from occ_model.scene.payload import typed_form
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, SECOND


@dataclass(frozen=True, slots=True)
class TheoryLimits:
    """Theoretical limits of one parameter, with the others unchanged."""

    band_model: float  # Where the band model ends: t = t_LED
    null: float  # Where an alternating pattern has no stripes: t = 2 t_LED
    # Frequency below which two packets do not fit into the panel's image; None for an exposure time
    # or without a panel in view
    two_packets: float | None = None
    # Exposure time above which the lit panel is white, infinite without light; None for a frequency
    saturation: float | None = None


@dataclass(frozen=True, slots=True)
class Advice:
    """How fast a scene can send to one decoder, and how long it can be exposed."""

    limits: Limits
    # Theoretical limits of each
    frequency: TheoryLimits
    exposure: TheoryLimits
    cause: str = ""  # Why the scene itself is not read, in sentences; empty where it is, or unknown


_DIGITS = 4  # significant digits, as the ends of a range are found to a few thousandths


_LONGEST_PAYLOAD = 24  # characters of a payload in a sentence


def sent_text(scene: Scene) -> str:
    """Describe what the pictures of a study show, the scene's own code or payload."""
    sent = scene.transmitter
    if sent.payload:
        return f"“{one_line(typed_form(sent.payload), _LONGEST_PAYLOAD)}”"
    return f"code {sent.code}"


def own_text(found: Limits, frames_a_second: float = FRAMES_A_SECOND) -> str:
    """State what was read at the scene's own values, and the bits a second."""
    own, bits = found.frequency.own, found.bits_a_second(frames_a_second)
    return (
        f"At {format_value(found.frequency.parameter, own.value)} it read {own.whole} of "
        f"{own.images} pictures of {sent_text(found.scene)}, {own.rate:.3g} % of the bits "
        f"({own.low:.1f} to {own.high:.1f} %): {bits:.4g} bits a second, if others are read "
        "as well."
    )


def format_value(parameter: str, value: float) -> str:
    """Format a frequency or an exposure time with the digits of the advice."""
    return quantity(parameter).format(value, _DIGITS)


def end_text(parameter: str, end: RangeEnd) -> str:
    """State how an end of a range was confirmed, and its 95 % interval."""
    works = end.works.value
    place = "there" if end.value == works else f"at {format_value(parameter, works)}"
    text = f"{place} it read {_rate_text(end.works)}"
    if end.fails is None:
        text += "; values beyond were not tried."
    else:
        text += f", at {format_value(parameter, end.fails.value)} {_rate_text(end.fails)}."
    if end.inside is not None and end.interval is not None:
        low, high = (format_value(parameter, value) for value in end.interval)
        text += (
            f" At {format_value(parameter, end.inside.value)} it read every bit of "
            f"{end.inside.images} images: the end is between {low} and {high} (95 %)."
        )
    return text


def format_gaps(found: WorkingRange) -> list[str]:
    """Format the gaps in a range, in which a decoder does not read."""
    name = found.parameter
    return [
        f"{format_value(name, end.value)} to {format_value(name, after.value)}"
        for end, after in found.gaps
    ]


def gaps_text(found: WorkingRange) -> str:
    """State the gaps; empty without any."""
    if not found.gaps:
        return ""
    return (
        f"It does not read everywhere between: there are gaps from {'; '.join(format_gaps(found))}."
    )


def search_end_text(found: WorkingRange) -> str:
    """State where the search ended because the decoder would take too long."""
    return (
        f"Searched only up to {format_value(found.parameter, found.searched[1])}, where an "
        f"exposure covers {found.most_chips:.3g} chips; beyond it this decoder takes much longer."
    )


def search_sentences(found: Limits) -> list[str]:
    """State the confidence of the ends, and what the search can miss."""
    step = 100.0 * (found.frequency.step - 1.0)
    missed = (
        f"Values were tried in steps of {step:.0f} %: a narrower gap or interval can be missed."
    )
    if not found.frequency.intervals and not found.exposure.intervals:
        return [missed]
    return [
        "Each end was confirmed with images that were not used to find it, with at least "
        f"{found.images}; the 95 % intervals count images.",
        missed,
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
    white = SECOND.format(theory.saturation, _DIGITS)
    return f"{text}; above {white}, columns that are lit throughout are white."


def two_packets_text(frequency: float) -> str:
    """State the frequency below which some pictures do not have the two headers of a decoder."""
    limit = HERTZ.format(frequency, _DIGITS)
    return (
        f"Below {limit} a picture does not contain two packets, nor always the two headers that "
        "this decoder needs."
    )


def _rate_text(trial: Trial) -> str:
    return f"{trial.rate:.3g} % in {trial.images} images ({trial.low:.1f} to {trial.high:.1f} %)"
