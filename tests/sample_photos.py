"""The sample photos: simulated, and said to be. Run it to write them anew."""

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
KNOWN = "Simulated by occ_model with every effect; no real photograph."


def _photographed(preset: str, brightest: float, **changes: str | float) -> Scene:
    """Let a phone take a picture that is not enhanced, of a panel that does not saturate it."""
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
    "led-1khz": _photographed(
        "phone-68us-real", 205.0, light="lamp", lamp_frequency=1e3, readout_time=12.8e-6
    ),
    "packets-6khz": _photographed(
        "phone-136us-real", 215.0, code=345, switching_frequency=6e3, readout_time=8.9e-6
    ),
}
"""By the file's name: a lamp to measure a readout time with, and a code to read."""


def taken(scene: Scene) -> np.ndarray:
    """Simulate the picture before it is kept in a file."""
    return occ.render(scene.replace(jpeg_quality=0), tolerance=0.0).image


def as_jpeg(scene: Scene) -> bytes:
    """Write it as a camera would, with what it notes of its settings."""
    picture = Image.fromarray(taken(scene))
    exif = picture.getexif()
    exif.update({Base.ImageDescription: KNOWN, Base.Make: "Simulated", Base.Model: "phone"})
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
        (FOLDER / f"{name}.jpg").write_bytes(as_jpeg(scene))
        (FOLDER / f"{name}.toml").write_text(scene.to_toml(), encoding="utf-8")
