"""Photos of known scenes, made by the model itself."""

import math
from pathlib import Path

import numpy as np

import occ_model as occ
from occ_model.arrays import ByteArray
from occ_model.camera.photometry import luminance_of
from occ_model.scene.scene import Scene


def photo_of(image: ByteArray) -> occ.Photo:
    """Make a photo of an image whose columns are the scan axis."""
    return occ.Photo(
        path=Path("simulated.png"),
        samples=image,
        white=255,
        image=image,
        profile=image.mean(axis=0),
        turned=False,
        channel="grey",
    )


def random_scene(seed: int) -> Scene:
    """Draw a scene whose photo has noise, vignetting, blur and JPEG artefacts."""
    random = np.random.default_rng(seed)

    def between(low: float, high: float) -> float:
        return float(random.uniform(low, high))

    rows, columns = int(random.integers(200, 500)), int(random.integers(1200, 3000))
    readout = between(5e-6, 30e-6)
    chip_columns = math.exp(between(math.log(4.0), math.log(30.0)))
    frequency = 1.0 / (chip_columns * readout)
    exposure = math.exp(between(math.log(0.1), math.log(3.0))) / frequency
    scene = occ.load_preset("phone-68us").replace(
        rows=rows,
        columns=columns,
        code=int(random.integers(0, 1024)),
        readout_time=readout,
        switching_frequency=frequency,
        exposure_time=exposure,
        start_time=between(0.0, 24.0 / frequency),
        vignetting_exponent=between(0.5, 6.0),
        point_spread=between(0.2, 1.5),
        jpeg_quality=int(random.integers(60, 96)),
        averaging=str(random.choice(["light", "pixel-value"])),
        enhancement="none",
    )
    metres = scene.pose.distance / scene.camera.focal_length_pixels
    width, height = between(0.5, 1.2) * columns * metres, between(0.4, 1.2) * rows * metres
    white = float(luminance_of(np.array([between(120.0, 240.0)]), scene.camera)[0])
    return scene.replace(
        panel_width=width,
        panel_height=height,
        offset_x=between(-0.2, 0.2) * width,
        offset_y=between(-0.2, 0.2) * height,
        luminance=white,
        illuminance=white * between(0.002, 0.2) * math.pi / scene.surroundings.reflectance,
    )


def take(scene: Scene, seed: int = 1) -> occ.Photo:
    """Take the photo of a scene, with every effect that it has."""
    return photo_of(occ.render(scene, tolerance=0.0, seed=seed).image)
