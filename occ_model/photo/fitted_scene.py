"""Make the scene whose picture is the photo's, with uncertainties in SI units, from a fit."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from occ_model.errors import MatchError, ParameterError, distinct_texts
from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.chip_runs import is_single_pulse, runs_of
from occ_model.photo.fit.joint_estimate import refined
from occ_model.photo.fit.least_squares import StripeFit
from occ_model.photo.photo_scene import at_the_photo, with_chips, with_levels
from occ_model.photo.reading.load import Photo
from occ_model.photo.stripes.evenly_lit import Cells
from occ_model.results.decoding import Region
from occ_model.results.match import Match, Stripes
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import PARAMETERS, quantity
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import sent_chips

_MOST_DEVIATIONS = 3.0  # standard deviations above which two exposure times contradict each other
_NOTE_ERROR = 0.012  # relative deviation of a noted exposure time: 1/500 stands for 1/512 s

_DOUBTFUL_DEVIATION, _REFUSED_DEVIATION = 0.03, 0.1
"""Relative standard deviations of the readout time, or the frequency, above which a match is
doubtful, and above which it is refused."""

DOUBTFUL_EXPOSURE_DEVIATION = 0.5
"""Relative standard deviation of the exposure time above which it is doubtful: two of them reach
from it to nothing."""

_MOST_EDGE_ERROR = 0.25  # maximum error of the outermost edges in shortest pulses


def at_rate(scene: Scene, rate: float) -> Scene:
    """Return a scene at ``rate`` times its switching frequency."""
    if rate == 1.0:
        return scene
    frequency = scene.transmitter.switching_frequency * rate
    try:
        return scene.replace(switching_frequency=frequency)
    except ParameterError as error:
        raise MatchError(f"A setting that explains the stripes is not allowed: {error}") from None


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


def described(
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

    Of fits that are as good with another exposure the one is taken that is nearest to the exposure
    time in the photo's EXIF data, or the shortest. ``check`` is called every few hundredths of a
    second; what it raises ends the work. A pulse that ``was_read`` has a duty that was estimated.
    """
    region = stripes.region
    better = refined(stripes, Cells.of(photo, region), explanation, scene.camera.gamma, check)
    explanation = replace(explanation, fits=better.fits)
    best = explanation.nearest(lambda one: exposure_time(one, scene, estimate), photo.exposure_time)
    fit = _within_pulse(best, min(runs_of(explanation.chips)))
    scene = _with_timing(scene, fit, explanation, estimate, region)
    scene = with_levels(
        at_the_photo(scene, photo, region),
        float(np.median(fit.low)),
        float(np.median(fit.low + fit.swing)),
    )
    uncertainties = _uncertainties(fit, estimate, scene, region.first_column)
    unsure = doubts_by_error(estimate, float(scene.value(estimate)), uncertainties[estimate])
    unknown = uncertainties["exposure_time"] / scene.camera.exposure_time
    scene = round_estimates(scene, uncertainties)
    if was_read and is_single_pulse(explanation.chips):
        # The duty stated is that of whole chips, and so off by its change in the fit, too.
        least = min(runs_of(explanation.chips))  # of which no more can be missing
        uncertainties["duty"] = min(math.hypot(*fit.longer), least) / len(explanation.chips)
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
            exposure_time(other, scene, estimate) for other in explanation.fits if other is not best
        ),
        reasons=(*better.doubts, *unsure),
        exposure_reasons=(
            *better.exposure_doubts,
            *doubts_by_fraction("exposure_time", unknown, DOUBTFUL_EXPOSURE_DEVIATION),
            *doubts_by_enhancement(photo),
            *_doubts_by_others(photo, explanation),
            *_doubts_by_note(photo, camera.exposure_time, uncertainties["exposure_time"]),
        ),
    )


def doubts_by_error(estimate: str, value: float, deviation: float) -> list[str]:
    fraction = deviation / value
    if refusal := doubts_by_fraction(estimate, fraction, _REFUSED_DEVIATION):
        raise MatchError(*refusal)
    return doubts_by_fraction(estimate, fraction, _DOUBTFUL_DEVIATION)


def doubts_by_fraction(name: str, fraction: float, limit: float) -> list[str]:
    """Return a sentence where a relative standard deviation is beyond its limit, else none."""
    if fraction <= limit:
        return []
    shown, most = distinct_texts(100.0 * fraction, 100.0 * limit)
    what = PARAMETERS[name].in_sentence
    return [f"The {what} is known only to {shown} %; at most {most} % are allowed."]


def doubts_by_enhancement(photo: Photo) -> list[str]:
    """Doubt what was fitted to equalized levels: the noise decides how they are spread."""
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


def _doubts_by_note(photo: Photo, exposure: float, deviation: float) -> list[str]:
    noted = photo.exposure_time
    if noted is None:
        return []
    # Of both: the camera rounds what it notes.
    deviations = abs(exposure - noted) / math.hypot(deviation, _NOTE_ERROR * noted)
    if deviations <= _MOST_DEVIATIONS:
        return []
    unit = quantity("exposure_time")
    return [
        f"The exposure time found, {unit.format(exposure)}, and the one that the camera noted, "
        f"{unit.format(noted)}, are {deviations:.1f} standard deviations apart."
    ]


def _within_pulse(fit: StripeFit, shortest: int) -> StripeFit:
    """Let a step be no more uncertain than by what edges are at the right chips.

    Sharp edges that lie exactly between columns leave a fit without a slope over the step.
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
    scene, turned = with_chips(scene, explanation.chips)
    first = timing.start(columns) - timing.step * region.first_column - turned
    try:
        return scene.replace(
            readout_time=readout,
            switching_frequency=frequency,
            exposure_time=timing.exposure / frequency,
            start_time=first % len(explanation.chips) / frequency,
            gamma=timing.gamma,
            averaging=explanation.camera.averaging,
            enhancement=explanation.camera.enhancement,
        )
    except ParameterError as error:
        raise MatchError(f"A setting that explains the stripes is not allowed: {error}") from None


def _uncertainties(
    fit: StripeFit, estimate: str, scene: Scene, first_column: int
) -> dict[str, float]:
    """Propagate the fit's covariance to the estimated parameters, in SI units."""
    timing = fit.timing
    frequency = scene.transmitter.switching_frequency
    # The first column's start in chips, as it depends on step, exposure and middle.
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
            # In seconds these are chips times t_r / step, and have the step's uncertainty.
            "exposure_time": (exposure - step * (timing.exposure / timing.step)) / frequency,
            "start_time": (start - step * (begin / timing.step)) / frequency,
        }
    if fit.covariance[3, 3] > 0.0:
        slopes["gamma"] = np.array([0.0, 0.0, 0.0, 1.0])
    variances = {name: float(slope @ fit.covariance @ slope) for name, slope in slopes.items()}
    return {name: math.sqrt(max(variance, 0.0)) for name, variance in variances.items()}


def round_estimates(scene: Scene, uncertainties: Mapping[str, float]) -> Scene:
    """Round what was estimated to the digits that its uncertainty leaves, at least to one of it."""

    def rounded(name: str, declared: Quantity) -> float:
        value = float(scene.value(name))
        return declared.unit.round_estimate(value, min(uncertainties[name], abs(value)))

    found = {name: PARAMETERS[name] for name in uncertainties}
    return scene.replace(
        **{n: rounded(n, one) for n, one in found.items() if isinstance(one, Quantity)}
    )
