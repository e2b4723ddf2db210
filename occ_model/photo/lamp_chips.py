"""A lamp as the chips of one pulse, in which stripes are fitted, and as a lamp again.

The fit knows what is sent as chips. A lamp that is lit for some of a number of parts of its cycle
is a pulse of as many chips, and nothing outside the fit learns of them.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from occ_model.errors import ParameterError
from occ_model.results.match import Match
from occ_model.scene.light_words import blinking_lamp
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene

MOST_PARTS = 50
"""Parts of a cycle to which a duty is read; a shorter pulse or gap is one part of more."""

_MOST_OF_ALL = 1000


def in_chips(scene: Scene, *, is_read: bool) -> Scene:
    """Return a scene that sends a lamp's light as the chips of one pulse.

    ``is_read``: whether what is sent is read from the photo, whatever the scene sends.

    Raises
    ------
    ParameterError
        Its light is neither a code nor a lamp, or its frequency is out of the range of chips.
    """
    lamp = blinking_lamp(scene.transmitter)
    if scene.transmitter.light == "code":
        return scene
    if lamp is None:
        if is_read:
            return scene.replace(light="code")
        raise ParameterError.of(
            "light", scene.transmitter.light,
            "code, lamp or pulses; or let what is sent be read from the photo",
            condition="where a photo is matched", parameters=("light",),
        )  # fmt: skip
    lit = _lit_part(lamp.duty)
    on, count = lit.numerator, lit.denominator
    chips, cycles = quantity("switching_frequency"), quantity("lamp_frequency")
    if not chips.low <= count * lamp.frequency <= chips.high:
        low, high = (cycles.format(limit / count) for limit in (chips.low, chips.high))
        raise ParameterError.of(
            cycles.label, cycles.format(lamp.frequency), f"{low} to {high}",
            condition="where a photo is matched", parameters=("lamp_frequency",),
        )  # fmt: skip
    pattern = "1" * on + "0" * (count - on)
    return scene.replace(light="code", pattern=pattern, switching_frequency=count * lamp.frequency)


def _lit_part(duty: float) -> Fraction:
    lit = Fraction(duty).limit_denominator(MOST_PARTS)
    if lit.denominator > 1 or not 0.0 < duty < 1.0:
        return lit
    shorter = min(duty, 1.0 - duty)
    part = Fraction(1, min(round(1.0 / shorter), _MOST_OF_ALL))
    return part if duty < 0.5 else 1 - part


def with_lamp(match: Match, given: Scene) -> Match:
    """Return a match in chips with a lamp in their place, if they are one pulse.

    ``given``: the scene before it was in chips, whose own chips the match's scene keeps.
    """
    scene, sent = match.scene, given.transmitter
    lamp = blinking_lamp(scene.transmitter)
    if lamp is None:
        return match
    frequency, known = lamp.frequency, blinking_lamp(sent)
    if known is not None and math.isclose(frequency, known.frequency):
        frequency = known.frequency  # not rounded by its chips
    # A lamp's cycle begins where it is switched on.
    pattern = match.pattern
    turned = next(at for at in range(len(pattern)) if pattern[at - 1] + pattern[at] == "01")
    start = match.start_time
    if turned:
        start = (start - turned / match.switching_frequency) % (1.0 / frequency)
    scene = scene.replace(
        light="lamp",
        lamp_frequency=frequency,
        duty=lamp.duty,
        depth=1.0,
        pattern=sent.pattern,
        switching_frequency=sent.switching_frequency,
        start_time=start,
    )
    return replace(
        match,
        scene=scene,
        start_time=start,
        uncertainties=_of_cycles(match.uncertainties, len(pattern)),
    )


def _of_cycles(uncertainties: Mapping[str, float], chips: int) -> dict[str, float]:
    """Let the error of a frequency be that of cycles of so many chips."""
    found = dict(uncertainties)
    if "switching_frequency" in found:
        found["lamp_frequency"] = found.pop("switching_frequency") / chips
    return found
