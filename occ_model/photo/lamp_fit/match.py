"""Match the stripes of a lamp in a photo: its frequency or the readout time, duty and exposure."""

import math
from collections.abc import Callable

import numpy as np

from occ_model.camera.photometry import WHITE
from occ_model.errors import MatchError, distinct_texts
from occ_model.photo.fitted_scene import (
    DOUBTFUL_EXPOSURE_DEVIATION,
    doubts_by_enhancement,
    doubts_by_error,
    doubts_by_fraction,
    round_estimates,
)
from occ_model.photo.lamp_fit.place import find_place
from occ_model.photo.lamp_fit.read_lamp import LampReading, read_lamp
from occ_model.photo.lamp_fit.readings import StripeReading, readings_of
from occ_model.photo.lamp_fit.verdict import floor_limit
from occ_model.photo.photo_scene import fit_to_photo, with_explanation, with_levels, with_notes
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.find import SATURATED_LEVEL
from occ_model.results.decoding import Region
from occ_model.results.match import NEVER_CHANGES, Match, Stripes
from occ_model.scene.light_words import blinking_lamp
from occ_model.scene.scene import Scene
from occ_model.scene.units import PERCENT, SECOND

_SAME = 2.0  # deviations within which two duties are the same
_NOTE_ERROR, _FAR_NOTE = math.log(1.3), math.log(1.6)
"""Logarithms of how far a noted exposure may be from a lamp's, and from where that is doubted."""
_CHIPS = "10"  # those of a cycle, which counts as two
_MOST_DEVIATIONS, _DUTY_ERROR = 3.0, 0.02
"""Deviations between a known duty and that of the stripes above which it is doubtful, and what tone
curves outside the model add to them."""

_LEAST_RAMP, _LEAST_PERIOD = 1.0, 10.0  # columns from which duty and exposure are sure
_RAMP_BY_NOISE = 200.0  # columns, for columns that differ from the model by the stripes' height
_MOST_WHITE = 0.15  # of the columns, up to which duty and exposure are sure


def match_lamp(
    photo: Photo,
    scene: Scene,
    region: Region,
    *,
    estimate: str,
    is_duty_known: bool,
    fit_gamma: bool = False,
    check: Callable[[], object] = lambda: None,
) -> Match:
    """Match the brightest lamp within a region of a photo.

    Parameters
    ----------
    scene
        Sends a blinking lamp's light; its frequency or readout time is known.
    estimate
        ``"readout_time"`` or ``"switching_frequency"``, which stands for the lamp's frequency.
    is_duty_known
        Whether the scene's duty is the lamp's; else it is read from the stripes.
    fit_gamma
        Whether gamma is estimated, too, unless samples are in proportion to the light.
    check
        Called every few hundredths of a second; what it raises ends the match.

    Raises
    ------
    MatchError
        There are no stripes, or none of a lamp.
    """
    lamp = blinking_lamp(scene.transmitter)
    if lamp is None:
        raise MatchError("The scene sends no lamp's light.")
    if lamp.depth == 0.0 or (is_duty_known and not 0.0 < lamp.duty < 1.0):
        raise MatchError(NEVER_CHANGES)
    place = find_place(photo, region)
    if place is None:
        raise MatchError("No lamp is found: nothing in the photo is brighter than the rest.")
    reading = read_lamp(place, is_linear=photo.is_linear, check=check)
    period = reading.period
    readout = scene.camera.readout_time
    if estimate == "readout_time":
        readout, frequency = 1.0 / (lamp.frequency * period), lamp.frequency
    else:
        frequency = 1.0 / (readout * period)
    known_duty = lamp.duty if is_duty_known else None
    chosen, others = _choose(reading, known_duty, photo.exposure_time, frequency)
    duty = chosen.duty if known_duty is None else known_duty
    first = reading.column + place.region.first_column
    start = (0.5 * duty - 0.5 * chosen.exposure - first / period) % 1.0 / frequency
    errors = _uncertainties(reading, chosen, estimate, readout, frequency, is_duty_known)
    low, high = (WHITE * each for each in reading.ends)
    scene = with_explanation(
        with_notes(scene, photo), light="lamp", lamp_frequency=frequency, duty=duty,
        depth=1.0, readout_time=readout, exposure_time=chosen.exposure / frequency,
        start_time=start, averaging="light", enhancement="none",
    )  # fmt: skip
    if photo.is_linear:
        scene = scene.replace(gamma=1.0)
    elif fit_gamma:
        scene = with_explanation(scene, gamma=reading.fit.gamma)
        errors["gamma"] = reading.fit.gamma_error
    scene = fit_to_photo(scene, photo, place.region)
    scene = with_levels(scene, float(np.median(low)), float(np.median(high)))
    name = "readout_time" if estimate == "readout_time" else "lamp_frequency"
    unsure = doubts_by_error(name, float(scene.value(name)), errors[name])
    unknown = errors["exposure_time"] / scene.camera.exposure_time
    scene = round_estimates(scene, errors)
    stripes = Stripes(
        place.region, WHITE * reading.profile.values, low, high,
        period, reading.errors.period * reading.step,
        place.part_above(SATURATED_LEVEL),
    )  # fmt: skip
    model = WHITE * reading.levels
    flat = (model - low) / (high - low)
    camera = scene.camera
    return Match(
        scene=scene,
        stripes=stripes,
        readout_time=camera.readout_time,
        switching_frequency=len(_CHIPS) * scene.transmitter.lamp_frequency,
        exposure_time=camera.exposure_time,
        start_time=scene.model.start_time,
        gamma=camera.gamma,
        uncertainties=errors,
        pattern=_CHIPS,
        pattern_was_read=not is_duty_known,
        profile=model,
        correlation=float(np.corrcoef(stripes.flattened, flat)[0, 1]),
        other_exposures=tuple(sorted(each.exposure / frequency for each in others)),
        reasons=(
            *reading.reasons(has_note=photo.exposure_time is not None),
            *unsure,
            *_doubts_by_duty(reading, chosen, known_duty),
        ),
        lines_at_once=reading.lines_at_once,
        exposure_reasons=(
            *doubts_by_fraction("exposure_time", unknown, DOUBTFUL_EXPOSURE_DEVIATION),
            *doubts_by_enhancement(photo),
            *_doubts_by_columns(reading),
            *_doubts_by_readings(chosen, others, photo.exposure_time, frequency),
        ),
    )  # fmt: skip


def _choose(
    reading: LampReading, duty: float | None, noted: float | None, frequency: float
) -> tuple[StripeReading, tuple[StripeReading, ...]]:
    """Return the duty and exposure that the floor, and what is known, leave, and others as good."""
    floor, most = reading.fit.floor, floor_limit(reading.cues)
    errors = reading.errors.ramp, reading.errors.width

    def away(one: StripeReading) -> float:
        known = 0.0
        if duty is not None:
            known = (one.duty - duty) / (_SAME * errors[one.is_width_of_pulses])
        elif noted is not None:
            known = math.log(one.exposure / (noted * frequency)) / _NOTE_ERROR
        return math.hypot((one.floor - floor) / most, known)

    possible = readings_of(reading.width, reading.ramp)
    first, *others = sorted(possible, key=away)
    alike = [
        one
        for one in others
        if away(one) < away(first) + 1.0
        and abs(one.exposure - first.exposure) > _SAME * max(errors)
    ]
    return first, tuple(alike)


def _doubts_by_duty(reading: LampReading, chosen: StripeReading, known: float | None) -> list[str]:
    """Doubt a known duty that is not that of the stripes."""
    error = reading.errors.width if chosen.is_width_of_pulses else reading.errors.ramp
    if known is None or abs(chosen.duty - known) <= _MOST_DEVIATIONS * math.hypot(
        error, _DUTY_ERROR
    ):
        return []
    return [
        f"The stripes have a duty of {PERCENT.format_estimate(chosen.duty, error)}; the scene "
        f"sends {PERCENT.format(known, 3)}."
    ]


def _doubts_by_columns(reading: LampReading) -> list[str]:
    """Doubt duty and exposure where compression, blur or white hide the stripes' shape."""
    cues = reading.cues
    least, found = max(_LEAST_RAMP, _RAMP_BY_NOISE * cues.unexplained), []
    if cues.ramp < least or cues.period < _LEAST_PERIOD:
        found.append(
            f"The stripes' edges last {cues.ramp:.2g} of the {cues.period:.3g} columns of a "
            "period, so that blur and compression hide duty and exposure; at least "
            f"{least:.2g} of {_LEAST_PERIOD:.0f} are needed."
        )
    if cues.white > _MOST_WHITE:
        white, most = distinct_texts(100.0 * cues.white, 100.0 * _MOST_WHITE)
        found.append(
            f"{white} % of the columns have white pixels, which hides duty and exposure; at most "
            f"{most} % are allowed."
        )
    return found


def _doubts_by_readings(
    chosen: StripeReading, others: tuple[StripeReading, ...], noted: float | None, frequency: float
) -> list[str]:
    found, seconds = [], SECOND.format(chosen.exposure / frequency, 3)
    if others:
        words = [
            f"a duty of {PERCENT.format(each.duty, 3)} exposed for "
            f"{SECOND.format(each.exposure / frequency, 3)}"
            for each in (chosen, *others[:2])
        ]
        why = "notes no exposure time" if noted is None else "notes one that does not decide"
        found.append(
            f"{' or '.join(words).capitalize()}: these make the same stripes, and the photo {why}. "
            "If the duty is known, state that the scene's light is sent."
        )
    if noted is not None and abs(math.log(chosen.exposure / (noted * frequency))) > _FAR_NOTE:
        found.append(
            f"The exposure time found, {seconds}, is far from the one that the camera noted, "
            f"{SECOND.format(noted, 3)}."
        )
    return found


def _uncertainties(
    reading: LampReading,
    chosen: StripeReading,
    estimate: str,
    readout: float,
    frequency: float,
    is_duty_known: bool,
) -> dict[str, float]:
    """Return the standard deviations of the estimates, in SI units."""
    relative = reading.errors.period / reading.fit.wave.period
    of_duty, of_exposure = reading.errors.width, reading.errors.ramp
    if not chosen.is_width_of_pulses:
        of_duty, of_exposure = of_exposure, of_duty
    of_place = reading.errors.place * reading.step * readout
    found = {
        "exposure_time": of_exposure / frequency,
        "start_time": math.hypot(of_place, 0.5 * math.hypot(of_duty, of_exposure) / frequency),
    }
    if estimate == "readout_time":
        found["readout_time"] = relative * readout
    else:
        found["lamp_frequency"] = relative * frequency
    if not is_duty_known:
        found["duty"] = of_duty
    return found
