"""Match the stripes of a lamp in a photo: its frequency or the readout time, duty and exposure."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from occ_model.camera.photometry import WHITE
from occ_model.errors import MatchError
from occ_model.photo.fitted_scene import (
    DOUBTFUL_EXPOSURE_DEVIATION,
    doubts_by_enhancement,
    doubts_by_error,
    doubts_by_fraction,
    round_estimates,
)
from occ_model.photo.lamp_fit.estimates import LampEstimates, estimate_lamp
from occ_model.photo.lamp_fit.place import find_place
from occ_model.photo.lamp_fit.read_lamp import read_lamp
from occ_model.photo.lamp_fit.shape_doubts import (
    doubts_by_columns,
    doubts_by_duty,
    doubts_by_readings,
)
from occ_model.photo.lamp_fit.verdict import doubts
from occ_model.photo.photo_scene import fit_to_photo, with_explanation, with_levels, with_notes
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.find import SATURATED_LEVEL
from occ_model.results.decoding import Region
from occ_model.results.match import NEVER_CHANGES, Match, Stripes
from occ_model.scene.light_words import blinking_lamp
from occ_model.scene.scene import Scene

_CHIPS = "10"  # those of a cycle, which counts as two


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
    found = estimate_lamp(
        read_lamp(place, is_linear=photo.is_linear, check=check),
        frequency=lamp.frequency,
        readout=scene.camera.readout_time,
        estimate=estimate,
        known_duty=lamp.duty if is_duty_known else None,
        noted=photo.exposure_time,
    )
    errors, gamma = found.uncertainties, 1.0 if photo.is_linear else scene.camera.gamma
    if fit_gamma and not photo.is_linear:
        gamma, errors["gamma"] = found.reading.fit.gamma, found.reading.fit.gamma_error
    return _describe(found, photo, _scene_of(found, photo, scene, gamma), errors)


def _scene_of(found: LampEstimates, photo: Photo, scene: Scene, gamma: float) -> Scene:
    """Return the scene whose picture is the photo."""
    scene = with_explanation(
        with_notes(scene, photo), light="lamp", lamp_frequency=found.frequency, duty=found.duty,
        depth=1.0, readout_time=found.readout, exposure_time=found.exposure_time,
        start_time=found.start_time, averaging="light", enhancement="none", gamma=gamma,
    )  # fmt: skip
    scene = fit_to_photo(scene, photo, found.reading.place.region)
    low, high = (float(np.median(WHITE * each)) for each in found.reading.ends)
    return with_levels(scene, low, high)


def _describe(found: LampEstimates, photo: Photo, scene: Scene, errors: dict[str, float]) -> Match:
    """Describe what was found, with its doubts; ``errors`` are standard deviations in SI units."""
    reading, place, name = found.reading, found.reading.place, found.estimate
    unsure = doubts_by_error(name, float(scene.value(name)), errors[name])
    unknown = errors["exposure_time"] / scene.camera.exposure_time
    scene = round_estimates(scene, errors)
    model, low, high = (WHITE * each for each in (reading.levels, *reading.ends))
    stripes = Stripes(
        place.region, WHITE * reading.profile.values, low, high,
        reading.period, reading.errors.period * reading.step,
        place.part_above(SATURATED_LEVEL),
    )  # fmt: skip
    flat = replace(stripes, profile=model).flattened
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
        pattern_was_read=found.known_duty is None,
        profile=model,
        correlation=float(np.corrcoef(stripes.flattened, flat)[0, 1]),
        other_exposures=tuple(sorted(each.exposure / found.frequency for each in found.others)),
        reasons=(
            *doubts(
                reading.cues, reading.gap, reading.other_period, is_confirmed=found.is_confirmed
            ),
            *unsure,
            *doubts_by_duty(found),
        ),
        lines_at_once=reading.lines_at_once,
        exposure_reasons=(
            *doubts_by_fraction("exposure_time", unknown, DOUBTFUL_EXPOSURE_DEVIATION),
            *doubts_by_enhancement(photo),
            *doubts_by_columns(reading.cues),
            *doubts_by_readings(found),
        ),
    )  # fmt: skip
