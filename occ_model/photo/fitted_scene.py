"""Make the scene that reproduces a photo, with uncertainties in SI units, from a fit."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from occ_model.errors import MatchError, distinct_texts
from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.chip_runs import runs_of
from occ_model.photo.fit.joint_estimate import refine_fits
from occ_model.photo.fit.least_squares import StripeFit
from occ_model.photo.photo_scene import fit_to_photo, with_chips, with_explanation, with_levels
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.evenly_lit import Cells
from occ_model.results.decoding import Region
from occ_model.results.match import Match, Stripes
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS, quantity
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import sent_chips

_MOST_DEVIATIONS = 3.0  # standard deviations above which two exposure times contradict each other
_NOTE_ERROR = 0.012  # relative deviation of a noted exposure time, as cameras note 1/512 s as 1/500

_DOUBTFUL_DEVIATION, _REFUSED_DEVIATION = 0.03, 0.1
"""Relative standard deviations of the readout time, or the frequency, above which a match is
doubtful, and above which it is refused."""

DOUBTFUL_EXPOSURE_DEVIATION = 0.5
"""Relative standard deviation of the exposure time above which it is doubtful, as 0 is then within
two standard deviations."""

_MOST_EDGE_ERROR = 0.25  # maximum error of the outermost edges in shortest pulses


def exposure_time(fit: StripeFit, scene: Scene, estimate: str) -> float:
    """Return the exposure time of a fit in seconds."""
    if estimate == "readout_time":
        return fit.timing.exposure * scene.transmitter.switching_period
    return fit.timing.exposure / fit.timing.step * scene.camera.readout_time


def readout_and_frequency(fit: StripeFit, scene: Scene, estimate: str) -> tuple[float, float]:
    """Return a fit's readout time and switching frequency in SI units; one is the scene's."""
    if estimate == "readout_time":
        frequency = scene.transmitter.switching_frequency
        return fit.timing.step / frequency, frequency
    readout = scene.camera.readout_time
    return readout, fit.timing.step / readout


def make_match(
    photo: Photo,
    scene: Scene,
    estimate: str,
    stripes: Stripes,
    explanation: Explanation,
    check: Callable[[], object],
    *,
    was_read: bool,
) -> Match:
    """Express an explanation in SI units, and as a scene.

    If fits with several exposures are equally good, the one nearest to the exposure time in the
    photo's EXIF data is chosen, or the shortest. ``check`` is called every few hundredths of a
    second, and may raise an exception to end the work.
    """
    region = stripes.region
    better = refine_fits(stripes, Cells.of(photo, region), explanation, scene.camera.gamma, check)
    explanation = replace(explanation, fits=better.fits)
    best = explanation.nearest(
        lambda candidate: exposure_time(candidate, scene, estimate), photo.exposure_time
    )
    fit = limit_step_error(best, min(runs_of(explanation.chips)))
    scene = _with_timing(scene, fit, explanation, estimate, region)
    scene = with_levels(
        fit_to_photo(scene, photo, region),
        float(np.median(fit.low)),
        float(np.median(fit.low + fit.swing)),
    )
    uncertainties = uncertainties_of(fit, estimate, scene, region.first_column)
    doubts = doubts_by_error(estimate, float(scene.value(estimate)), uncertainties[estimate])
    exposure_fraction = uncertainties["exposure_time"] / scene.camera.exposure_time
    scene = round_estimates(scene, uncertainties)
    camera = scene.camera
    return Match(
        scene=scene,
        stripes=replace(stripes, low=fit.low, high=fit.low + fit.swing),
        readout_time=camera.readout_time,
        switching_frequency=scene.transmitter.switching_frequency,
        exposure_time=camera.exposure_time,
        start_time=scene.model.start_time,
        gamma=camera.gamma,
        uncertainties=uncertainties,
        pattern="".join(map(str, sent_chips(scene.transmitter).tolist())),
        pattern_was_read=was_read,
        profile=fit.profile,
        correlation=fit.correlation,
        other_exposures=tuple(
            exposure_time(other_fit, scene, estimate)
            for other_fit in explanation.fits
            if other_fit is not best
        ),
        reasons=(*better.doubts, *doubts),
        exposure_reasons=(
            *better.exposure_doubts,
            *doubts_by_fraction("exposure_time", exposure_fraction, DOUBTFUL_EXPOSURE_DEVIATION),
            *doubts_by_enhancement(photo),
            *_doubts_by_others(photo, explanation),
            *doubts_by_note(photo, camera.exposure_time, uncertainties["exposure_time"]),
        ),
    )


def doubts_by_error(estimate: str, value: float, deviation: float) -> list[str]:
    fraction = deviation / value
    if refusal := doubts_by_fraction(estimate, fraction, _REFUSED_DEVIATION):
        raise MatchError(*refusal)
    return doubts_by_fraction(estimate, fraction, _DOUBTFUL_DEVIATION)


def doubts_by_fraction(name: str, fraction: float, limit: float) -> list[str]:
    """Return a sentence if a relative standard deviation is above its limit."""
    if fraction <= limit:
        return []
    percent, most = distinct_texts(100.0 * fraction, 100.0 * limit)
    label = PARAMETERS[name].in_sentence
    return [f"The {label} is known only to {percent} %; at most {most} % are allowed."]


def doubts_by_enhancement(photo: Photo) -> list[str]:
    """Doubt a fit to equalized levels, whose spread depends on the noise."""
    if photo.enhancement != "equalization":
        return []
    return [
        "The file says that its picture is a receiver's, equalized: the match has no model of how "
        "noise spreads equalized levels. Match the camera's picture instead."
    ]


def _doubts_by_others(photo: Photo, explanation: Explanation) -> list[str]:
    if len(explanation.fits) == 1 or photo.exposure_time is not None:
        return []
    return ["Other exposure times explain the stripes as well, and the photo notes none."]


def doubts_by_note(photo: Photo, exposure: float, deviation: float) -> list[str]:
    noted = photo.exposure_time
    if noted is None:
        return []
    # The deviations of both, as the camera rounds the time that it notes.
    deviations = abs(exposure - noted) / math.hypot(deviation, _NOTE_ERROR * noted)
    if deviations <= _MOST_DEVIATIONS:
        return []
    unit = quantity("exposure_time")
    return [
        f"The exposure time found, {unit.format(exposure)}, and the one that the camera noted, "
        f"{unit.format(noted)}, are {deviations:.1f} standard deviations apart."
    ]


def limit_step_error(fit: StripeFit, shortest: int) -> StripeFit:
    """Limit the step's uncertainty so that all edges belong to the right chips.

    If sharp edges lie exactly between columns, a fit's slope over the step is zero.
    """
    most = _MOST_EDGE_ERROR * shortest / len(fit.profile)
    factor = np.ones(4)
    factor[0] = min(1.0, most / max(math.sqrt(float(fit.covariance[0, 0])), 1e-300))
    return replace(fit, covariance=fit.covariance * np.outer(factor, factor))


def _with_timing(
    scene: Scene, fit: StripeFit, explanation: Explanation, estimate: str, region: Region
) -> Scene:
    timing, columns = fit.timing, len(fit.profile)
    readout, frequency = readout_and_frequency(fit, scene, estimate)
    scene, shift = with_chips(scene, explanation.chips)
    first = timing.start(columns) - timing.step * region.first_column - shift
    return with_explanation(
        scene,
        readout_time=readout,
        switching_frequency=frequency,
        exposure_time=timing.exposure / frequency,
        start_time=first % len(explanation.chips) / frequency,
        gamma=timing.gamma,
        averaging=explanation.camera.averaging,
        enhancement=explanation.camera.enhancement,
    )


def uncertainties_of(
    fit: StripeFit, estimate: str, scene: Scene, first_column: int
) -> dict[str, float]:
    """Propagate the fit's covariance to the estimated parameters, in SI units."""
    timing = fit.timing
    frequency = scene.transmitter.switching_frequency
    # Derivatives of the first column's start in chips by step, exposure, middle and gamma.
    half = 0.5 * (len(fit.profile) - 1) + first_column
    start = np.array([-half, -0.5, 1.0, 0.0])
    step = np.array([1.0, 0.0, 0.0, 0.0])
    exposure = np.array([0.0, 1.0, 0.0, 0.0])
    if estimate == "readout_time":
        slopes = {
            "readout_time": step / frequency,
            "exposure_time": exposure / frequency,
            "start_time": start / frequency,
        }
    else:
        readout = scene.camera.readout_time
        begin = scene.model.start_time * frequency
        slopes = {
            "switching_frequency": step / readout,
            # In seconds these are chips times t_r / step, so that the step's uncertainty adds.
            "exposure_time": (exposure - step * (timing.exposure / timing.step)) / frequency,
            "start_time": (start - step * (begin / timing.step)) / frequency,
        }
    if fit.covariance[3, 3] > 0.0:
        slopes["gamma"] = np.array([0.0, 0.0, 0.0, 1.0])
    variances = {name: float(slope @ fit.covariance @ slope) for name, slope in slopes.items()}
    return {name: math.sqrt(max(variance, 0.0)) for name, variance in variances.items()}


def round_estimates(scene: Scene, uncertainties: Mapping[str, float]) -> Scene:
    """Round estimates to the digits that their uncertainties leave, at least to one."""

    def round_value(parameter: Quantity) -> float:
        value = float(scene.value(parameter.name))
        deviation = min(uncertainties[parameter.name], abs(value))
        return parameter.unit.round_estimate(value, deviation)

    parameters = [PARAMETERS[name] for name in uncertainties]
    return scene.replace(**{p.name: round_value(p) for p in parameters if isinstance(p, Quantity)})
