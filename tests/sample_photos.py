"""Make the sample photos, which are simulated and say so; run this file to write them again."""

import math
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image
from PIL.ExifTags import IFD, Base

import occ_model as occ
from occ_model.camera.photometry import luminance_of
from occ_model.scene.scene import Scene

FOLDER = Path(__file__).parents[1] / "resources" / "photos"
QUALITY = 85
DESCRIPTION = "Simulated by occ_model with every effect; no real photograph."


def _scene_of_photo(preset: str, brightest: float, **changes: str | float) -> Scene:
    """Return the scene of a photo, not enhanced, whose panel has the pixel value ``brightest``."""
    scene = occ.load_preset(preset).replace(
        rows=1200, columns=1600, averaging="light", enhancement="none", distance=0.8,
        jpeg_quality=QUALITY, point_spread=1.2, start_time=0.003, **changes,
    )  # fmt: skip
    (white,) = luminance_of(np.array([brightest]), scene.camera).tolist()
    reflected = 0.01 * white
    return scene.replace(
        luminance=white - reflected,
        illuminance=math.pi * reflected / scene.surroundings.reflectance,
    )


SCENES = {
    "led-1khz": _scene_of_photo(
        "phone-68us-real", 205.0, light="lamp", lamp_frequency=1e3, readout_time=12.8e-6
    ),
    "packets-6khz": _scene_of_photo(
        "phone-136us-real", 215.0, code=345, switching_frequency=6e3, readout_time=8.9e-6
    ),
}
"""A lamp by which the readout time is measured, and a code to read, by the names of the files."""


def take_photo(scene: Scene) -> np.ndarray:
    """Simulate the picture, without the losses of its file."""
    return occ.render(scene.replace(jpeg_quality=0), tolerance=0.0).image


def encode_as_jpeg(scene: Scene) -> bytes:
    """Encode the picture as a camera does, with its settings as EXIF data."""
    picture = Image.fromarray(take_photo(scene))
    exif = picture.getexif()
    exif.update({Base.ImageDescription: DESCRIPTION, Base.Make: "Simulated", Base.Model: "phone"})
    exif.get_ifd(IFD.Exif).update({
        Base.ExposureTime: scene.camera.exposure_time,
        Base.FNumber: scene.camera.f_number,
        Base.ISOSpeedRatings: round(scene.camera.iso),
    })  # fmt: skip
    buffer = BytesIO()
    picture.save(buffer, "JPEG", quality=scene.camera.jpeg_quality, exif=exif)
    return buffer.getvalue()


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for name, scene in SCENES.items():
        (FOLDER / f"{name}.jpg").write_bytes(encode_as_jpeg(scene))
        (FOLDER / f"{name}.toml").write_text(scene.to_toml(), encoding="utf-8")
