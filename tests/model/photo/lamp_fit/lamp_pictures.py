"""Pictures of lamps, made apart from the program."""

import math
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

import occ_model as occ
from occ_model.arrays import ByteArray, FloatArray


@dataclass(frozen=True)
class LampPicture:
    photo: occ.Photo
    period: float  # Columns
    duty: float
    exposure: float  # Periods


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
    light = np.clip(caught + random.normal(0.0, 0.001, light.shape), 0.0, 1.0)
    return LampPicture(photo_of(srgb(light), jpeg=90), period, duty, exposure)


def srgb(light: FloatArray) -> ByteArray:
    level = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return np.asarray(np.rint(255.0 * level), dtype=np.uint8)


def photo_of(image: ByteArray, jpeg: int = 0) -> occ.Photo:
    if jpeg:
        _, file = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, jpeg])
        image = np.asarray(cv2.imdecode(file, cv2.IMREAD_GRAYSCALE), dtype=np.uint8)
    profile = image.mean(axis=0, dtype=np.float64)
    return occ.Photo(
        path=Path("drawn.png"), samples=image, white=255, image=image, profile=profile,
        turned=False, channel="grey",
    )  # fmt: skip


FREQUENCY = 1000.0


def readout_of(period: float) -> float:
    """Return the readout time with which a lamp of 1 kHz has a period in columns."""
    return 1.0 / (FREQUENCY * period)


def is_near(value: float, right: float, error: float, most: float) -> bool:
    return math.isfinite(error) and abs(value - right) <= most * error
