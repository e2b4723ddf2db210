"""Pictures of lamps, made apart from the program."""

import math
from dataclasses import dataclass

import cv2
import numpy as np
from photo_world.photograph import compress
from photo_world.tone_curves import srgb
from simulated_photos import photo_of

import occ_model as occ
from occ_model.arrays import FloatArray


@dataclass(frozen=True)
class LampPicture:
    photo: occ.Photo
    period: float  # Columns


def lit(columns: FloatArray, duty: float, exposure: float) -> FloatArray:
    """Return the light of exposures that start at some periods, by its closed integral."""

    def until(time: FloatArray) -> FloatArray:
        return np.asarray(np.floor(time) * duty + np.minimum(time % 1.0, duty))

    return np.asarray((until(columns + exposure) - until(columns)) / exposure)


def draw_lamp(
    random: np.random.Generator, *, duty: float, exposure: float, periods: float, columns: int = 160
) -> LampPicture:
    """Draw a round lamp in a dark room: hot spot, noise, tone curve and JPEG of a camera."""
    rows, around = 70, 20
    period, place = columns / periods, random.uniform(0.0, 20.0)
    column = np.arange(columns + 2 * around, dtype=np.float64)
    y, x = np.mgrid[0 : rows + 2 * around, 0 : columns + 2 * around]
    middle_x, middle_y = columns / 2 + around, rows / 2 + around
    shape = np.hypot((x - middle_x) / (columns / 2), (y - middle_y) / (rows / 2)) < 1.0
    spot = np.exp(-(((x - middle_x) / columns) ** 2) - ((y - middle_y) / rows) ** 2)
    light = 0.7 * cv2.GaussianBlur(shape * spot, (0, 0), 0.7)
    stripes = lit((column - place) / period, duty, exposure)
    light = cv2.GaussianBlur(light * stripes / stripes.max(), (0, 0), 0.5)
    caught = random.poisson(np.clip(light, 0.0, None) * 3000.0) / 3000.0
    light = caught + random.normal(0.0, 0.001, light.shape)
    return LampPicture(photo_of_light(light, quality=90), period)


def photo_of_light(light: FloatArray, quality: int | None = None) -> occ.Photo:
    """Return sRGB's levels of light, 1 being white, as a photo; as a JPEG of a quality, if any."""
    image = np.rint(255.0 * srgb(np.clip(light, 0.0, 1.0))).astype(np.uint8)
    return photo_of(image if quality is None else compress(image, quality))


FREQUENCY = 1000.0


def readout_of(period: float) -> float:
    """Return the readout time with which a lamp of 1 kHz has a period in columns."""
    return 1.0 / (FREQUENCY * period)


def is_near(value: float, right: float, error: float, most: float) -> bool:
    return math.isfinite(error) and abs(value - right) <= most * error
