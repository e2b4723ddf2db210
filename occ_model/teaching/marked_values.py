"""Values of a parameter at which the picture changes qualitatively, to mark on its slider."""

import math
from collections.abc import Iterable
from functools import lru_cache

from occ_model.camera.photometry import luminance_levels
from occ_model.errors import OccError, counted
from occ_model.light.cosine import Cosine
from occ_model.light.sent import light_of, light_period
from occ_model.results.teaching import MarkedValue
from occ_model.scene.light_samples import samples_of
from occ_model.scene.light_words import blinking_lamp
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene, Transmitter
from occ_model.study.theory import band_model_frequency, null_frequency
from occ_model.transmitter.registry import FRAMINGS, LINE_CODES
from occ_model.transmitter.scheme import sent_chips, shortest_period

_MOST_NULLS = 2  # marked exposures of whole periods
_LONGEST_WAVEFORM = 512  # levels of which a shorter period within is looked for


def marked_values(scene: Scene, parameter: str) -> tuple[MarkedValue, ...]:
    """Return the values to mark on the slider of the exposure time, or of the light's own.

    Of a code these are where t = t_LED, where t = 2 t_LED (the first null of alternating chips),
    and where the exposure is a whole period of the chips sent, so that the panel causes no bars. Of
    other lights they are where the exposure is as long as a pulse, or as the gap between two, and
    where it is k periods: their nulls, the frequencies k / t.
    """
    light = scene.transmitter.light
    if scene.camera.exposure_time <= 0.0 or not PARAMETERS[parameter].is_of(light):
        return ()
    if light == "code":
        return _marks_of_chips(scene, parameter)
    return (*_ends_of_states(scene, parameter), *_nulls(scene, parameter))


def _marks_of_chips(scene: Scene, parameter: str) -> tuple[MarkedValue, ...]:
    exposure, transmitter = scene.camera.exposure_time, scene.transmitter
    if parameter not in ("switching_frequency", "exposure_time"):
        return ()
    is_raw = bool(transmitter.pattern)
    period = _sent_period(scene)
    ends = {
        "switching_frequency": (
            band_model_frequency(scene), null_frequency(scene), period / exposure
        ),
        "exposure_time": tuple(k * transmitter.switching_period for k in (1.0, 2.0, period)),
    }  # fmt: skip
    equal, null, barless = ends[parameter]
    ends_there = "Exposure and switching period are equal: the band model ends."
    what = "pattern" if is_raw else "packet"
    why = f"The exposure is a whole {what}: no bars of the panel, here and at its whole multiples."
    marks = [MarkedValue(equal, "t = t_LED", ends_there)]
    if not is_raw:
        nulls = "The exposure is two chips long: the first null of 0101."
        marks.append(MarkedValue(null, "null", nulls))
    if period:
        label = f"whole {what}" if _flickers(scene) else "no bars"
        marks.append(MarkedValue(barless, label, why))
    return tuple(marks)


def _flickers(scene: Scene) -> bool:
    """Whether the surroundings make bars of their own."""
    return bool(scene.surroundings.flicker_depth * luminance_levels(scene)[0] > 0.0)


def _sent_period(scene: Scene) -> float:
    """Return the chips after which the light repeats; 0 for a steady light or an unknown packet."""
    sent = scene.transmitter
    if not sent.luminance:
        return 0.0
    if sent.pattern:  # a pattern can repeat inside; a packet has only one header
        chips = sent_chips(sent)
        return float(shortest_period(chips)) if chips.min() < chips.max() else 0.0
    if not (LINE_CODES.is_built_in(sent.line_code) and FRAMINGS.is_built_in(sent.framing)):
        return 0.0  # marks are drawn while a slider moves, and a plug-in may be slow
    try:
        return float(len(sent_chips(sent)))
    except OccError:  # the picture's own failure says why
        return 0.0


def _ends_of_states(scene: Scene, parameter: str) -> Iterable[MarkedValue]:
    """Yield where stripes of a blinking lamp stop to be fully lit, or fully dark."""
    lamp, exposure = blinking_lamp(scene.transmitter), scene.camera.exposure_time
    if lamp is None or not _bar_period(scene.transmitter):
        return
    duty, period = lamp.duty, 1.0 / lamp.frequency
    pulse = duty * period
    ends = {
        "exposure_time": (pulse, period - pulse),
        "lamp_frequency": (duty / exposure, (1.0 - duty) / exposure),
        "duty": (exposure / period, 1.0 - exposure / period),
        "pulse_frequency": (0.0, 1.0 / (exposure + pulse)),
        "pulse_length": (exposure, period - exposure),
    }
    meanings = (
        ("pulse", "The exposure is as long as the pulse: in longer ones no stripe is fully lit."),
        ("gap", "The exposure is as long as the gap: in longer ones no stripe is without a pulse."),
    )
    # The gap of a square wave is as long as its pulse: one mark for both.
    values = dict.fromkeys(ends.get(parameter, ()))
    for value, (part, meaning) in zip(values, meanings, strict=False):
        if value > 0.0:
            yield MarkedValue(value, f"t = {part}", meaning)


def _nulls(scene: Scene, parameter: str) -> Iterable[MarkedValue]:
    """Yield the first values on the slider at which an exposure is a whole number of periods."""
    sent, declared = scene.transmitter, PARAMETERS[parameter]
    first = _bar_period(sent)
    if parameter == _FREQUENCIES[sent.light] and not sent.waveform_file:
        first *= scene.value(parameter) / scene.camera.exposure_time  # type: ignore[operator]
    elif parameter != "exposure_time":
        return
    if not first or not isinstance(declared, Quantity):
        return
    lowest = max(math.ceil(declared.slider[0] / first), 1)
    for k in range(lowest, lowest + _MOST_NULLS):
        length = counted(k, "period")
        meaning = f"The exposure is {length} of the light: a null k / t, where it makes no bars."
        yield MarkedValue(k * first, length, meaning)


_FREQUENCIES = {
    "lamp": "lamp_frequency",
    "mains": "mains_frequency",
    "waveform": "switching_frequency",
    "pulses": "pulse_frequency",
}


@lru_cache(maxsize=8)
def _bar_period(sent: Transmitter) -> float:
    """Return the seconds of which multiples show no bars of a light; 0 if it is steady."""
    if sent.light == "waveform" and sent.waveform_file:  # its exact light can take seconds
        seconds, samples = samples_of(sent.waveform_file)
        return seconds[-1] if sent.luminance and min(samples) < max(samples) else 0.0
    light, period = light_of(sent), float(light_period(sent))
    if isinstance(light, Cosine):
        return period if light.depth else 0.0
    levels = light.waveform.levels
    if not sent.luminance or levels.min() == levels.max():
        return 0.0
    if sent.light == "waveform" and len(levels) <= _LONGEST_WAVEFORM:
        period *= shortest_period(levels) / len(levels)
    return period
