"""An advice on a scene, limits found by trial and limits of theory, and its sentences."""

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
    """Values of one parameter at which theory places a limit, with the others unchanged."""

    band_model: float  # Where the band model ends: t = t_LED
    null: float  # Where an alternating pattern has no stripes: t = 2 t_LED
    # Frequency below which two packets do not fit the panel's image; None for an exposure time or
    # without a panel in view
    two_packets: float | None = None
    # Exposure time from which the lit panel is white, infinite without light; None for a frequency
    saturation: float | None = None


@dataclass(frozen=True, slots=True)
class Advice:
    """How fast a scene can go with one decoder, and how long it can be exposed."""

    limits: Limits
    # What theory says of each
    frequency: TheoryLimits
    exposure: TheoryLimits
    cause: str = ""  # Why the scene itself is not read, in sentences; empty where it is, or unknown


_DIGITS = 4  # significant digits: the ends of a range are found to a few thousandths


_LONGEST_PAYLOAD = 24  # characters of a payload that are named


def sent_text(scene: Scene) -> str:
    """Describe what the pictures of a study show: the scene's own code or payload."""
    sent = scene.transmitter
    if sent.payload:
        return f"“{one_line(typed_form(sent.payload), _LONGEST_PAYLOAD)}”"
    return f"code {sent.code}"


def own_text(found: Limits, frames_a_second: float = FRAMES_A_SECOND) -> str:
    """State what was read at the scene's own values, with its bits a second."""
    own, bits = found.frequency.own, found.bits_a_second(frames_a_second)
    return (
        f"At {written(found.frequency.parameter, own.value)} it read {own.whole} of {own.images} "
        f"pictures of {sent_text(found.scene)}, {own.rate:.3g} % of the bits ({own.low:.1f} to "
        f"{own.high:.1f} %): {bits:.4g} bits a second, if others are read as well."
    )


def written(parameter: str, value: float) -> str:
    """Format a frequency or an exposure time with the digits of an advice."""
    return quantity(parameter).format(value, _DIGITS)


def end_text(parameter: str, end: RangeEnd) -> str:
    """Return the sentence on how an end was confirmed and on its 95 % interval."""
    works = end.works.value
    place = "there" if end.value == works else f"at {written(parameter, works)}"
    text = f"{place} it read {_counted(end.works)}"
    if end.fails is None:
        text += ", beyond it was not tried."
    else:
        text += f", at {written(parameter, end.fails.value)} {_counted(end.fails)}."
    if end.inside is not None and end.interval is not None:
        low, high = (written(parameter, value) for value in end.interval)
        text += (
            f" At {written(parameter, end.inside.value)} it read every bit of {end.inside.images} "
            f"images: the end lies between {low} and {high} (95 %)."
        )
    return text


def gaps(found: WorkingRange) -> list[str]:
    """Format the gaps in which a decoder does not read."""
    return [
        f"{written(found.parameter, end.value)} to {written(found.parameter, after.value)}"
        for end, after in found.gaps
    ]


def gaps_text(found: WorkingRange) -> str:
    """Return the sentence on the gaps; empty without any."""
    if not found.gaps:
        return ""
    return f"It does not read everywhere between: gaps lie from {'; '.join(gaps(found))}."


def searched_to(found: WorkingRange) -> str:
    """Return the sentence on where the search ended because the decoder takes too long."""
    return (
        f"Searched only up to {written(found.parameter, found.searched[1])}, where an exposure "
        f"covers {found.most_chips:.3g} chips: beyond that this decoder takes much longer."
    )


def how_tried(found: Limits) -> list[str]:
    """Return sentences on the confidence of the ends found and on what the search can miss."""
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
    """Return the sentence on the limits that theory places on a frequency or an exposure time."""
    text = (
        f"By theory the band model ends at {written(parameter, theory.band_model)} and an "
        f"alternating pattern at {written(parameter, theory.null)}"
    )
    if theory.saturation is None:
        return f"{text}."
    if math.isinf(theory.saturation):
        return f"{text}; without light nothing saturates."
    white = SECOND.format(theory.saturation, _DIGITS)
    return f"{text}; from {white} on, columns lit throughout are white."


def two_packets_text(frequency: float) -> str:
    """Return the sentence on the frequency below which a decoder lacks headers in some pictures."""
    limit = HERTZ.format(frequency, _DIGITS)
    return (
        f"Below {limit} the picture does not hold two packets, and not always the two headers that "
        "this decoder needs."
    )


def _counted(trial: Trial) -> str:
    return f"{trial.rate:.3g} % in {trial.images} images ({trial.low:.1f} to {trial.high:.1f} %)"
