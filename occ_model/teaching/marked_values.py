"""Values of a parameter at which the picture changes qualitatively, to mark on its slider."""

import math
from collections.abc import Iterable
from functools import lru_cache

from occ_model.camera.photometry import luminance_levels
from occ_model.errors import OccError, inflect
from occ_model.results.teaching import MarkedValue
from occ_model.scene.light_samples import samples_of
from occ_model.scene.light_words import blinking_lamp
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene, Transmitter
from occ_model.study.bands.sines import repeat_time
from occ_model.study.theory import band_model_frequency, null_frequency
from occ_model.transmitter.registry import FRAMINGS, LINE_CODES
from occ_model.transmitter.scheme import sent_chips, shortest_period

_MOST_NULLS = 2  # number of exposures of whole periods that are marked


def marked_values(scene: Scene, parameter: str) -> tuple[MarkedValue, ...]:
    """Return the values to mark on the slider of the exposure time or of a parameter of the light.

    For a code they are t = t_LED, t = 2 t_LED (the first null of alternating chips), and an
    exposure of a whole period of the chips sent, in which the panel causes no bars. For other
    lights they are an exposure as long as a pulse, or as the gap between two, and exposures of k
    periods: the nulls, at the frequencies k / t.
    """
    light = scene.transmitter.light
    if scene.camera.exposure_time <= 0.0 or not PARAMETERS[parameter].is_of(light):
        return ()
    if light == "code":
        return _mark_chips(scene, parameter)
    return (*_mark_states(scene, parameter), *_mark_nulls(scene, parameter))


def _mark_chips(scene: Scene, parameter: str) -> tuple[MarkedValue, ...]:
    exposure, transmitter = scene.camera.exposure_time, scene.transmitter
    if parameter not in ("switching_frequency", "exposure_time"):
        return ()
    is_raw = bool(transmitter.pattern)
    period = _count_period_chips(scene)
    values = {
        "switching_frequency": (
            band_model_frequency(scene), null_frequency(scene), period / exposure
        ),
        "exposure_time": tuple(k * transmitter.switching_period for k in (1.0, 2.0, period)),
    }  # fmt: skip
    band_model_end, null, barless = values[parameter]
    band_model_meaning = "Exposure and switching period are equal: the band model ends."
    noun = "pattern" if is_raw else "packet"
    barless_meaning = (
        f"The exposure is a whole {noun}: no bars of the panel, here and at whole multiples."
    )
    marks = [MarkedValue(band_model_end, "t = t_LED", band_model_meaning)]
    if not is_raw:
        null_meaning = "The exposure is two chips long: the first null of 0101."
        marks.append(MarkedValue(null, "null", null_meaning))
    if period:
        label = f"whole {noun}" if _has_flicker(scene) else "no bars"
        marks.append(MarkedValue(barless, label, barless_meaning))
    return tuple(marks)


def _has_flicker(scene: Scene) -> bool:
    """Return whether the surroundings flicker, which causes bars of its own."""
    return bool(scene.surroundings.flicker_depth * luminance_levels(scene)[0] > 0.0)


def _count_period_chips(scene: Scene) -> float:
    """Return the period of the light in chips; 0 for a steady light or an unknown packet."""
    transmitter = scene.transmitter
    if not transmitter.luminance:
        return 0.0
    if transmitter.pattern:  # a pattern may contain periods; a packet has only one header
        chips = sent_chips(transmitter)
        return float(shortest_period(chips)) if chips.min() < chips.max() else 0.0
    if not (
        LINE_CODES.is_built_in(transmitter.line_code) and FRAMINGS.is_built_in(transmitter.framing)
    ):
        return 0.0  # marks are drawn while a slider moves, and a plug-in may be slow
    try:
        return float(len(sent_chips(transmitter)))
    except OccError:  # the picture's failure states the reason
        return 0.0


def _mark_states(scene: Scene, parameter: str) -> Iterable[MarkedValue]:
    """Yield the values beyond which no stripe of a blinking lamp is fully lit, or fully dark."""
    lamp, exposure = blinking_lamp(scene.transmitter), scene.camera.exposure_time
    if lamp is None or not _bar_period(scene.transmitter):
        return
    duty, period = lamp.duty, 1.0 / lamp.frequency
    pulse = duty * period
    values_by_parameter = {
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
    values = dict.fromkeys(values_by_parameter.get(parameter, ()))
    for value, (part, meaning) in zip(values, meanings, strict=False):
        if value > 0.0:
            yield MarkedValue(value, f"t = {part}", meaning)


def _mark_nulls(scene: Scene, parameter: str) -> Iterable[MarkedValue]:
    """Yield the first values on the slider at which an exposure is a whole number of periods."""
    transmitter, quantity_declaration = scene.transmitter, PARAMETERS[parameter]
    first = _bar_period(transmitter)
    if parameter == _FREQUENCIES[transmitter.light] and not transmitter.waveform_file:
        first *= scene.value(parameter) / scene.camera.exposure_time  # type: ignore[operator]
    elif parameter != "exposure_time":
        return
    if not first or not isinstance(quantity_declaration, Quantity):
        return
    lowest = max(math.ceil(quantity_declaration.slider[0] / first), 1)
    for k in range(lowest, lowest + _MOST_NULLS):
        length = inflect(k, "period")
        meaning = f"The exposure is {length} of the light: a null k / t, where it makes no bars."
        yield MarkedValue(k * first, length, meaning)


_FREQUENCIES = {
    "lamp": "lamp_frequency",
    "mains": "mains_frequency",
    "waveform": "switching_frequency",
    "pulses": "pulse_frequency",
}


@lru_cache(maxsize=8)
def _bar_period(transmitter: Transmitter) -> float:
    """Return the shortest exposure in seconds without bars of a light; 0 if it is steady."""
    if not transmitter.luminance and transmitter.light != "mains":  # mains light the surroundings
        return 0.0
    if transmitter.light == "waveform" and transmitter.waveform_file:
        # Its exact light can take seconds.
        seconds, samples = samples_of(transmitter.waveform_file)
        return seconds[-1] if min(samples) < max(samples) else 0.0
    return float(repeat_time(transmitter))
