"""Set a scene's chips, panel, light and camera from a photo."""

import math

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.camera.photometry import luminance_of
from occ_model.camera.projection import image_rays
from occ_model.effects.distortion import undistort
from occ_model.errors import MatchError, ParameterError
from occ_model.photo.reading.load import Photo
from occ_model.results.decoding import Region
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import code_of, scheme_of, sent_chips

_EXIF_PARAMETERS = ("iso", "f_number")  # from a photo's EXIF data; the exposure time is fitted


def with_chips(scene: Scene, chips: ByteArray) -> tuple[Scene, int]:
    """Set a scene's chips: as a code or payload if they are one, else as a raw pattern.

    Return the scene, and the number of chips by which its period starts later than ``chips``.
    """
    sending_scene = _scene_of_payload(scene, chips)
    if sending_scene is not None:
        packet = sent_chips(sending_scene.transmitter)
        for shift in range(len(chips)):
            if np.array_equal(np.roll(chips, -shift), packet):
                return sending_scene, shift
    return scene.replace(pattern="".join(map(str, chips.tolist()))), 0


def _scene_of_payload(scene: Scene, chips: ByteArray) -> Scene | None:
    """Return the scene with the payload that its scheme decodes from a period of chips, if any."""
    scene = scene.replace(pattern="")
    scheme = scheme_of(scene.transmitter)
    if len(chips) != scheme.length:
        return None
    # A frame starts anywhere in the first period, and the next header follows it.
    decoded = scheme.decode(np.tile(chips, 3))
    bits = decoded.bits.tolist()
    if decoded.failure is not None:
        return None
    if not scene.transmitter.payload:
        return scene.replace(code=code_of(bits))
    if bits == list(scene.transmitter.payload_bits):
        return scene
    return scene.replace(payload="bits:" + "".join(map(str, bits)))


def fit_to_photo(scene: Scene, photo: Photo, region: Region) -> Scene:
    """Set the picture's size to the photo's, and an upright panel to a region of it."""
    rows, columns = photo.samples.shape
    try:
        scene = scene.replace(rows=rows, columns=columns, yaw=0.0, pitch=0.0, roll=0.0)
    except ParameterError as error:
        raise MatchError(f"The photo cannot be a picture of the scene's camera: {error}") from None
    # A pixel's centre is at a whole number, its edge half a pixel away.
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
    rays = image_rays(undistort(rims, scene), scene.camera) * scene.pose.distance
    (left, _), (right, _), (_, top), (_, bottom) = rays.tolist()
    return with_allowed(
        scene,
        panel_width=right - left,
        panel_height=bottom - top,
        offset_x=0.5 * (left + right),
        offset_y=0.5 * (top + bottom),
    )


def with_levels(scene: Scene, low: float, high: float) -> Scene:
    """Set the light of panel and surroundings so that dark and lit columns have these levels."""
    levels = np.array([max(low, 0.0), max(high, low, 0.0)])
    dark, bright = luminance_of(levels, scene.camera).tolist()
    scene = with_allowed(scene, luminance=bright - dark)
    reflectance = scene.surroundings.reflectance
    if reflectance > 0.0:
        scene = with_allowed(scene, illuminance=math.pi * dark / reflectance)
    return scene


def with_notes(scene: Scene, photo: Photo) -> Scene:
    noted = {name: getattr(photo, name) for name in _EXIF_PARAMETERS}
    return with_allowed(scene, **{n: value for n, value in noted.items() if value is not None})


def with_explanation(scene: Scene, **settings: ParameterValue) -> Scene:
    """Change the settings that explain a photo's stripes; MatchError if one is out of range."""
    try:
        return scene.replace(**settings)
    except ParameterError as error:
        raise MatchError(f"A setting that explains the stripes is not allowed: {error}") from None


def with_allowed(scene: Scene, **changes: ParameterValue) -> Scene:
    """Change the values that are in range, and ignore the others."""
    for name, value in changes.items():
        try:
            PARAMETERS[name].check(value)
        except ParameterError:
            continue
        scene = scene.replace(**{name: value})
    return scene
