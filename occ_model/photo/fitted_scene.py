"""The scene whose picture is the photo's, from a fit of its stripes."""

import math
from dataclasses import replace

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.photometry import luminance_of
from occ_model.camera.projection import image_rays
from occ_model.effects.distortion import distorted
from occ_model.errors import MatchError, ParameterError
from occ_model.photo.fit.best_timing import Explanation
from occ_model.photo.fit.least_squares import StripeFit
from occ_model.photo.reading.load import Photo
from occ_model.results import Match, Region, Stripes
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Lens, Scene
from occ_model.transmitter import line_code
from occ_model.transmitter.packet import HEADER, code_of, packet_length, sent_chips

ESTIMATES = ("readout_time", "switching_frequency")
"""Which of the two is estimated; the other one is known."""

_STRAIGHTENINGS = 40
"""Steps to a ray that a lens bends by a few percent at most: each makes it so much more exact."""

_NOTED = ("iso", "f_number")
"""What the camera notes in a photo besides the exposure time, which is fitted."""


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


def with_chips(scene: Scene, chips: ByteArray) -> tuple[Scene, int]:
    """Let a scene send chips: as the code whose packet they are, else as a raw pattern.

    Returns
    -------
    scene
        The scene.
    turned
        By how many chips its period starts later than the chips given.
    """
    bits = scene.transmitter.bits
    if len(chips) == packet_length(bits):
        for turned in range(len(chips)):
            packet = np.roll(chips, -turned)
            if tuple(packet[: len(HEADER)]) != HEADER:
                continue
            read, violations = line_code.decode(packet[len(HEADER) :], level=HEADER[-1])
            sent = scene.replace(pattern="", code=code_of(read.tolist()))
            if not violations and np.array_equal(sent_chips(sent.transmitter), packet):
                return sent, turned
    return scene.replace(pattern="".join(map(str, chips.tolist()))), 0


def at_the_photo(scene: Scene, photo: Photo, region: Region) -> Scene:
    """Give the scene the photo's size, and a panel that fills a region of it.

    The panel stands as far away as it did, level and upright.
    """
    rows, columns = photo.samples.shape
    try:
        scene = scene.replace(rows=rows, columns=columns, yaw=0.0, pitch=0.0, roll=0.0)
    except ParameterError as error:
        raise MatchError(f"The photo is no picture of a scene's camera: {error}") from None
    # A pixel's centre is at a whole number, a rim half a pixel beside it.
    across = 0.5 * (region.first_column + region.last_column) - 0.5
    down = 0.5 * (region.first_row + region.last_row) - 0.5
    rims = np.array(
        [
            [region.first_column - 0.5, down],
            [region.last_column - 0.5, down],
            [across, region.first_row - 0.5],
            [across, region.last_row - 0.5],
        ]
    )
    rays = _straight(image_rays(rims, scene.camera), scene.lens) * scene.pose.distance
    (left, _), (right, _), (_, top), (_, bottom) = rays.tolist()
    return with_allowed(
        scene,
        panel_width=right - left,
        panel_height=bottom - top,
        offset_x=0.5 * (left + right),
        offset_y=0.5 * (top + bottom),
    )


def _straight(rays: FloatArray, lens: Lens) -> FloatArray:
    """Give the rays that a lens pictures at some others; those it cannot stay as they are."""
    if not lens.distorts:
        return rays
    straight = rays
    for _ in range(_STRAIGHTENINGS):
        straight = straight - (distorted(straight, lens) - rays)
    off = np.abs(distorted(straight, lens) - rays)
    return np.where(np.isfinite(off) & (off < 1e-6), straight, rays)


def with_levels(scene: Scene, fit: StripeFit) -> Scene:
    """Give the scene the light that makes the photo's grey levels."""
    low, high = float(np.median(fit.low)), float(np.median(fit.low + fit.swing))
    levels = np.array([max(low, 0.0), max(high, low, 0.0)])
    dark, bright = luminance_of(levels, scene.camera).tolist()
    scene = with_allowed(scene, luminance=bright - dark)
    reflectance = scene.surroundings.reflectance
    if reflectance > 0.0:
        scene = with_allowed(scene, illuminance=math.pi * dark / reflectance)
    return scene


def with_notes(scene: Scene, photo: Photo) -> Scene:
    """Give the scene what the camera noted of its settings, as far as it did."""
    noted = {name: getattr(photo, name) for name in _NOTED}
    return with_allowed(scene, **{n: value for n, value in noted.items() if value is not None})


def with_allowed(scene: Scene, **changes: ParameterValue) -> Scene:
    """Change what is within its range, and leave the rest: it is no part of what was fitted."""
    for name, value in changes.items():
        try:
            PARAMETERS[name].check(value)
        except ParameterError:
            continue
        scene = scene.replace(**{name: value})
    return scene
