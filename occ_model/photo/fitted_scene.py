"""The scene whose picture is the photo's, from a fit of its stripes."""

import math

import numpy as np

from occ_model.arrays import ByteArray, FloatArray
from occ_model.camera.photometry import luminance_of
from occ_model.camera.projection import image_rays
from occ_model.effects.distortion import distorted
from occ_model.errors import MatchError, ParameterError
from occ_model.photo.fit.least_squares import StripeFit
from occ_model.photo.reading.load import Photo
from occ_model.results import Region
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Lens, Scene
from occ_model.transmitter import line_code
from occ_model.transmitter.packet import HEADER, code_of, packet_length, sent_chips

_STRAIGHTENINGS = 40
"""Steps to a ray that a lens bends by a few percent at most: each makes it so much more exact."""

_NOTED = ("iso", "f_number")
"""What the camera notes in a photo besides the exposure time, which is fitted."""


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
