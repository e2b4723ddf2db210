"""The scene whose picture is the photo's, from a fit of its stripes."""

import math

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.camera.photometry import luminance_of
from occ_model.declarations import ParameterValue
from occ_model.errors import ParameterError
from occ_model.parameters import PARAMETERS
from occ_model.photo.load import Photo
from occ_model.photo.stripe_fit import StripeFit
from occ_model.results import Region
from occ_model.scene import Scene
from occ_model.transmitter import line_code
from occ_model.transmitter.packet import HEADER, code_of, packet_length, sent_chips

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
    scene = scene.replace(rows=rows, columns=columns, yaw=0.0, pitch=0.0, roll=0.0)
    metres = scene.pose.distance / scene.camera.focal_length_pixels
    # A pixel's centre is at a whole number, the picture's in the middle of them.
    across = 0.5 * (region.first_column + region.last_column - columns)
    down = 0.5 * (region.first_row + region.last_row - rows)
    return with_allowed(
        scene,
        panel_width=region.columns * metres,
        panel_height=region.rows * metres,
        offset_x=across * metres,
        offset_y=down * metres,
    )


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
