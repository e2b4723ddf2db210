"""Effects of the sensor (full well, fixed pattern, shot and read noise) and of the JPEG file."""

import math
from dataclasses import replace
from typing import TypeVar

import cv2
import numpy as np

from occ_model.arrays import ByteArray, FloatArray, Pixels
from occ_model.camera.photometry import (
    WHITE,
    converter_step,
    luminance_levels,
    pixel_value,
    saturation_value,
)
from occ_model.camera.pixel_noise import PixelNoise
from occ_model.effects.effect import Cost, Effect, NoiseEffect
from occ_model.errors import ParameterError
from occ_model.files.writing import LONGEST_SIDE
from occ_model.scene.scene import Scene

Values = TypeVar("Values", FloatArray, Pixels)  # pixel values in double or in single precision

_LUMINANCE_STEPS = (
    (16, 11, 10, 16, 24, 40, 51, 61),
    (12, 12, 14, 19, 26, 58, 60, 55),
    (14, 13, 16, 24, 40, 57, 69, 56),
    (14, 17, 22, 29, 51, 87, 80, 62),
    (18, 22, 37, 56, 68, 109, 103, 77),
    (24, 35, 55, 64, 81, 104, 113, 92),
    (49, 64, 78, 87, 103, 121, 120, 101),
    (72, 92, 95, 98, 112, 100, 103, 99),
)
"""Steps of the 8 x 8 cosine coefficients at quality 50 (ITU-T T.81, table K.1)."""


class Jpeg(Effect):
    """The file in which the camera stores the picture.

    Each block of 8 x 8 pixels is written as cosine coefficients, rounded to steps.

    The cosine transform is orthonormal, so that the mean square error of the pixels is that of the
    coefficients (Parseval). The receiver enhances the contrast of the picture read from the file.
    """

    name = "jpeg"
    label = "JPEG"
    kind = "image"
    stage = "processing"
    parameters = ("jpeg_quality",)
    cost = Cost(pixels=1.5e-3)

    def is_present(self, scene: Scene) -> bool:
        return scene.camera.jpeg_quality != 0

    def check_size(self, scene: Scene, shape: tuple[int, ...]) -> None:
        """Raise a ParameterError for a picture that the file cannot hold."""
        if self.is_present(scene) and max(shape) > LONGEST_SIDE["JPEG"]:
            raise ParameterError.of(
                "jpeg_quality",
                f"{scene.camera.jpeg_quality}, and the picture has {shape[0]} rows and "
                f"{shape[1]} columns",
                f"0, or up to {LONGEST_SIDE['JPEG']} rows and columns",
                parameters=("jpeg_quality", "rows", "columns"),
            )

    def apply(self, scene: Scene, image: ByteArray) -> ByteArray:
        """Return the picture as read from the file; each row of 8 x 8 blocks is independent."""
        if not self.is_present(scene):
            return image
        quality = [cv2.IMWRITE_JPEG_QUALITY, scene.camera.jpeg_quality]
        _, file = cv2.imencode(".jpg", image, quality)
        return np.asarray(cv2.imdecode(file, cv2.IMREAD_GRAYSCALE), dtype=np.uint8)


def quantization_steps(quality: int) -> FloatArray:
    """Return the steps of cosine coefficients for a quality from 1 to 100, shape (8, 8).

    They are scaled as in the Independent JPEG Group's library, the usual convention.
    """
    percent = 5000 // quality if quality < 50 else 200 - 2 * quality
    scaled = (np.array(_LUMINANCE_STEPS) * percent + 50) // 100
    return np.asarray(np.clip(scaled, 1, 255), dtype=np.float64)


class FullWell(Effect):
    """A pixel holds at most its full well of electrons; more light does not change it.

    At low ISO speeds the well is full before the pixel value reaches 255.
    """

    name = "full-well"
    label = "Full well"
    kind = "column"
    stage = "sensor"
    parameters = ("full_well",)
    cost = Cost(pixels=0.05e-3)

    def is_present(self, scene: Scene) -> bool:
        """Return whether any column can get more light than fills the well."""
        dark, bright = luminance_levels(scene)
        brightest = bright + dark * scene.surroundings.flicker_depth
        return min(float(pixel_value(brightest, scene.camera)), WHITE) > saturation_value(scene)

    def apply(self, scene: Scene, values: Values) -> Values:
        """Limit pixel values before they saturate."""
        full = np.asarray(saturation_value(scene), dtype=values.dtype)
        return np.minimum(values, full)


class FixedPattern(NoiseEffect):
    """Photo response non-uniformity: each pixel's gain differs from the mean by a fraction p.

    n electrons become n (1 + p z), where z is standard normal and the same in every picture of the
    sensor (J. R. Janesick, *Photon Transfer*, 2007).
    """

    name = "fixed-pattern"
    label = "Fixed-pattern gain"
    parameters = ("gain_variation", "sensor_seed")
    cost = Cost(pixels=0.2e-3)

    def is_present(self, scene: Scene) -> bool:
        return scene.sensor.gain_variation != 0.0

    def apply(self, scene: Scene, noise: PixelNoise) -> PixelNoise:
        variation = math.hypot(noise.gain_variation, scene.sensor.gain_variation)
        return replace(noise, gain_variation=variation)


class SensorNoise(NoiseEffect):
    """Shot noise, read noise, and the converter's steps.

    Electrons are counted, read with normal noise, and rounded to the converter's codes; see
    :mod:`occ_model.camera.pixel_noise`.
    """

    name = "sensor-noise"
    label = "Shot and read noise"
    parameters = ("pixel_pitch", "quantum_efficiency", "read_noise", "adc_bits")
    cost = Cost(pixels=2.0e-3)

    def is_present(self, scene: Scene) -> bool:  # noqa: ARG002 - light is always there
        """Return True, since all light has shot noise."""
        return True

    def apply(self, scene: Scene, noise: PixelNoise) -> PixelNoise:
        read_noise = math.hypot(noise.read_noise, scene.sensor.read_noise)
        return replace(noise, is_counted=True, read_noise=read_noise, step=converter_step(scene))
