"""What a fit found, in SI units and as a scene."""

import math
from dataclasses import replace

import numpy as np

from occ_model.errors import MatchError, ParameterError
from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.least_squares import StripeFit
from occ_model.photo.fitted_scene import at_the_photo, with_chips, with_levels
from occ_model.photo.reading.load import Photo
from occ_model.results import Match, Stripes
from occ_model.scene.scene import Scene
from occ_model.transmitter.packet import sent_chips

ESTIMATES = ("readout_time", "switching_frequency")
"""Which of the two is estimated; the other one is known."""


def exposure_time(fit: StripeFit, scene: Scene, estimate: str) -> float:
    """Give a fit's exposure time in seconds."""
    if estimate == "readout_time":
        return fit.timing.exposure * scene.transmitter.switching_period
    return fit.timing.exposure / fit.timing.step * scene.camera.readout_time


def described(
    photo: Photo, scene: Scene, estimate: str, stripes: Stripes, explanation: Explanation
) -> Match:
    """Put what was found in SI units, and in a scene.

    Of fits that are as good with another exposure the one is taken that is nearest to what the
    camera noted, or the shortest.

    Raises
    ------
    MatchError
        It is outside a parameter's range.
    """
    fit = explanation.nearest(lambda one: exposure_time(one, scene, estimate), photo.exposure_time)
    timing, region = fit.timing, stripes.region
    if estimate == "readout_time":
        frequency = scene.transmitter.switching_frequency
        readout = timing.step / frequency
    else:
        readout = scene.camera.readout_time
        frequency = timing.step / readout
    scene, turned = with_chips(scene, explanation.chips)
    period = len(explanation.chips)
    first = timing.start(len(stripes.profile)) - timing.step * region.first_column - turned
    try:
        scene = scene.replace(
            readout_time=readout,
            switching_frequency=frequency,
            exposure_time=timing.exposure / frequency,
            start_time=first % period / frequency,
            gamma=timing.gamma,
            averaging=explanation.camera.averaging,
            enhancement=explanation.camera.enhancement,
        )
    except ParameterError as error:
        raise MatchError(f"What explains the stripes cannot be: {error}") from None
    scene = with_levels(at_the_photo(scene, photo, region), fit)
    camera = scene.camera
    return Match(
        scene=scene,
        stripes=replace(stripes, low=fit.low, high=fit.low + fit.swing),
        readout_time=camera.readout_time,
        switching_frequency=frequency,
        exposure_time=camera.exposure_time,
        start_time=scene.model.start_time,
        gamma=camera.gamma,
        uncertainties=_uncertainties(fit, estimate, scene, region.first_column),
        pattern="".join(map(str, sent_chips(scene.transmitter).tolist())),
        pattern_was_read=False,
        profile=fit.profile,
        correlation=fit.correlation,
        other_exposures=tuple(
            exposure_time(other, scene, estimate) for other in explanation.fits if other is not fit
        ),
    )


def _uncertainties(
    fit: StripeFit, estimate: str, scene: Scene, first_column: int
) -> dict[str, float]:
    """Carry the fit's covariance over to what was estimated, in SI units."""
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
            # In seconds these are chips times t_r / step: they share the step's uncertainty.
            "exposure_time": (exposure - step * (timing.exposure / timing.step)) / frequency,
            "start_time": (start - step * (begin / timing.step)) / frequency,
        }
    if fit.covariance[3, 3] > 0.0:
        slopes["gamma"] = np.array([0.0, 0.0, 0.0, 1.0])
    variances = {name: float(slope @ fit.covariance @ slope) for name, slope in slopes.items()}
    return {name: math.sqrt(max(variance, 0.0)) for name, variance in variances.items()}
