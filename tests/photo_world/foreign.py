"""Photographs by a camera that neither the model nor `photograph` was made from.

The lamp's light rises and falls exponentially. The lens scatters it by a Moffat function. The
camera compresses light as film does, sharpens edges, resizes the picture, and keeps it as WebP.
"""

import math
from dataclasses import dataclass

import cv2
import numpy as np

READOUT = 10e-6
"""Seconds from a column of the stored picture to the next one."""

_FINE = 8
"""Samples of the light's course a row of the sensor."""


@dataclass(frozen=True)
class Foreign:
    """A picture, and its truth; lengths and times are counted in columns of the picture."""

    image: np.ndarray
    chips: str
    chip: float
    exposure: float


def foreign(seed: int) -> Foreign:
    """Draw a lamp and photograph it."""
    random = np.random.default_rng([seed, 3301])
    columns, rows = int(random.integers(500, 1500)), int(random.integers(60, 240))
    shrink = random.uniform(1.0, 2.5)
    chip = math.exp(random.uniform(math.log(2.5), math.log(30.0)))
    chips = _code(random, most=int(columns / (2.2 * chip)))
    exposure = chip * math.exp(random.uniform(math.log(0.1), math.log(3.0)))
    lines = int(columns * shrink) + 8
    light = _gather(random, chips, chip * shrink, exposure * shrink, lines)
    picture = _scatter(random, np.outer(_shape(random, int(rows * shrink)), light))
    picture = picture * _falloff(random, picture.shape) + 10.0 ** random.uniform(-3.0, -1.0)
    values = _develop(random, picture / np.quantile(picture, random.uniform(0.75, 0.9999)))
    size = (round(lines / shrink), round(len(values) / shrink))
    way = cv2.INTER_AREA if random.random() < 0.5 else cv2.INTER_LINEAR
    values = cv2.resize(values, size, interpolation=way)
    stored = np.rint(np.clip(values, 0.0, 1.0) * 255.0).astype(np.uint8)
    quality = int(random.integers(50, 96))
    _, data = cv2.imencode(".webp", stored, [cv2.IMWRITE_WEBP_QUALITY, quality])
    image = cv2.imdecode(data, cv2.IMREAD_GRAYSCALE)
    # What is resized has exactly the ratio of the two sizes.
    ratio = shrink * size[0] / lines
    return Foreign(np.asarray(image), chips, chip * ratio, exposure * ratio)


def _code(random: np.random.Generator, most: int) -> str:
    """Draw a square wave, pulse positions (1 of 4), pulse widths, or a maximum-length sequence."""
    kind = int(random.integers(4))
    if kind == 1 and most >= 20:
        return "11110" + "".join("0" * k + "1" + "0" * (3 - k) for k in random.integers(0, 4, 3))
    if kind == 2 and most >= 16:
        return "11111000" + "".join("100" if bit else "110" for bit in random.integers(0, 2, 3))
    if kind == 3 and most >= 15:
        return "000100110101111"
    return "10"


def _gather(
    random: np.random.Generator, chips: str, chip: float, exposure: float, lines: int
) -> np.ndarray:
    """Return the light that each line of the sensor gathers, by adding up fine samples."""
    time = np.arange(int((lines + exposure + 40.0 * chip) * _FINE)) / _FINE
    phase = random.uniform(0.0, len(chips))
    levels = np.array([float(one) for one in chips])
    on = levels[((time / chip + phase) % len(chips)).astype(int)]
    keep = math.exp(-1.0 / (_FINE * max(random.uniform(-0.02, 0.06) * chip, 1e-3)))
    kernel = (1.0 - keep) * keep ** np.arange(int(min(6.0 * chip, 400.0) * _FINE) + 1)
    lit = np.convolve(on, kernel)[: len(on)]
    total = np.concatenate([[0.0], np.cumsum(lit)]) / _FINE
    begin = 20.0 * chip + np.arange(lines)
    ends = np.arange(len(total)) / _FINE
    gathered = np.interp(begin + exposure, ends, total) - np.interp(begin, ends, total)
    return np.asarray(gathered / exposure)


def _shape(random: np.random.Generator, rows: int) -> np.ndarray:
    """Return how bright the lamp is in each row."""
    place = np.linspace(-1.0, 1.0, rows) + random.uniform(-0.3, 0.3)
    return np.asarray(np.exp(-random.uniform(0.0, 2.0) * np.abs(place) ** 3))


def _scatter(random: np.random.Generator, light: np.ndarray) -> np.ndarray:
    off = np.arange(-15, 16)
    width, power = random.uniform(0.3, 1.2), random.uniform(1.5, 3.5)
    kernel = (1.0 + (off[:, None] ** 2 + off[None, :] ** 2) / width**2) ** -power
    return cv2.filter2D(light, -1, kernel / kernel.sum())


def _falloff(random: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """Return a lamp that is brighter at some place along the scan, and a dirty glass before it."""
    place = np.linspace(-1.0, 1.0, shape[1]) - random.uniform(-0.6, 0.6)
    hot = 1.0 / (1.0 + random.uniform(0.0, 2.0) * place**2)
    return hot * (1.0 + 0.03 * np.sin(random.uniform(2.0, 9.0) * place + random.uniform(0.0, 6.0)))


def _develop(random: np.random.Generator, light: np.ndarray) -> np.ndarray:
    """Add noise, compress, sharpen."""
    full_well = math.exp(random.uniform(math.log(400.0), math.log(10_000.0)))
    noisy = random.poisson(np.minimum(light, 4.0) * full_well) / full_well
    noisy = np.clip(noisy + random.normal(0.0, 2.0 / full_well, light.shape), 0.0, 1.0)
    kind, strength = int(random.integers(3)), random.uniform(2.0, 40.0)
    if kind == 0:  # logarithmic, as for films
        values = np.log1p(strength * noisy) / math.log1p(strength)
    elif kind == 1:  # a power with a toe
        values = noisy ** random.uniform(0.4, 0.6) * (1.0 - 0.3 * np.exp(-strength * noisy))
    else:  # an arc tangent, whose lights are compressed
        values = np.arctan(0.25 * strength * noisy) / math.atan(0.25 * strength)
    soft = cv2.GaussianBlur(values, (0, 0), random.uniform(0.7, 2.0))
    return np.asarray(values + random.uniform(0.0, 1.0) * (values - soft))
