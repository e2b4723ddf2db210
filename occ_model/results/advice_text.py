"""The facts of an advice in words: ends of ranges, gaps, and the limits of theory."""

import math

from occ_model.results.advice import EndFacts, TheoryLimits
from occ_model.results.limits import Limits, RangeEnd, Trial, WorkingRange
from occ_model.scene.parameters import quantity
from occ_model.scene.units import HERTZ, SECOND

_DIGITS = 4
"""Significant digits: the ends of a range are found to a few thousandths."""


def written(parameter: str, value: float) -> str:
    """Write a frequency or an exposure time with the digits of the advice."""
    return quantity(parameter).format(value, _DIGITS)


def end_text(parameter: str, end: RangeEnd | EndFacts) -> str:
    """Say by which images an end was confirmed, and between which values it surely lies."""
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
    """Write the gaps in which a decoder does not read."""
    return [
        f"{written(found.parameter, end.value)} to {written(found.parameter, after.value)}"
        for end, after in found.gaps
    ]


def gaps_text(found: WorkingRange) -> str:
    """Say in a sentence where the gaps lie; empty where there is none."""
    if not found.gaps:
        return ""
    return f"It does not read everywhere between: gaps lie from {'; '.join(gaps(found))}."


def searched_to(found: WorkingRange) -> str:
    """Say where the search ended, as the decoder takes too long beyond."""
    return (
        f"Searched to {written(found.parameter, found.searched[1])} alone, where an exposure "
        f"covers {found.most_chips:.3g} chips: more take this decoder much longer."
    )


def how_tried(found: Limits) -> list[str]:
    """Say what the confidence of the ends rests on, if any was found, and what can be missed."""
    step = 100.0 * (found.frequency.step - 1.0)
    missed = (
        f"Values were tried in steps of {step:.0f} %: a narrower gap or interval can be missed."
    )
    if not found.frequency.intervals and not found.exposure.intervals:
        return [missed]
    return [
        f"Each end was tried with {found.images} images or more that had not chosen it; the 95 % "
        "intervals count images.",
        missed,
    ]


def theory_text(parameter: str, theory: TheoryLimits) -> str:
    """Say where theory places limits of the switching frequency or of the exposure time."""
    text = (
        f"By theory the band model ends at {written(parameter, theory.band_model)} and an "
        f"alternating pattern at {written(parameter, theory.null)}"
    )
    if theory.saturation is None:
        return f"{text}."
    if math.isinf(theory.saturation):
        return f"{text}; there is no light that could saturate."
    white = SECOND.format(theory.saturation, _DIGITS)
    return f"{text}; from {white} what is lit throughout is white."


def two_packets_text(frequency: float) -> str:
    """Say below which frequency a decoder that needs two packets fails."""
    limit = HERTZ.format(frequency, _DIGITS)
    return f"Below {limit} no two packets fit the picture, which it needs."


def _counted(trial: Trial) -> str:
    return f"{trial.rate:.3g} % in {trial.images} images ({trial.low:.1f} to {trial.high:.1f} %)"
