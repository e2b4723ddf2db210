"""Photographs of blinking lamps, drawn without the model's own simulation.

Light is added before the camera's tone curve, as in any real camera. What the model does not know
is drawn at random: the curve, blur by image processing, scattered light, the lamp's shape, noise.
"""

import math
from dataclasses import dataclass

import cv2
import numpy as np

from photo_world.exposures import mean_light
from photo_world.lamps import Lamp, random_lamp
from photo_world.tone_curves import Curve, power, unknown_curve

KNOWN_GAMMA = 2.22

MOST_SATURATED = 0.6

_REACH = 12
"""Pixels to which blur reaches."""

_SEEN_PERIODS = 1.6
"""Smallest number of periods of the sent chips within the lamp."""


@dataclass(frozen=True)
class World:
    """The truth of one photograph, in SI units."""

    seed: int
    chips: str  # one period of what is sent, as a text of 0 and 1
    switching_frequency: float
    readout_time: float
    exposure_time: float
    start_time: float
    rows: int
    columns: int
    lamp: Lamp
    curve: Curve
    # Fraction of the lamp's pixels that shall be white; a lamp that is mostly dark has fewer.
    saturated: float
    ambient: float  # light of the surroundings, as a fraction of the lamp's
    # The brightest light of a lamp that is not saturated, as a fraction of what makes white.
    peak: float
    vignetting: float
    blur: float  # standard deviation in columns of the blur by image processing
    # ``"normal"``; ``"box"``, as resizing blurs; or ``"exponential"``, with long tails.
    blur_shape: str
    # Whether pixel values are blurred (noise reduction, resizing) instead of light (demosaicing).
    blur_of_values: bool
    full_well: float  # full_well, read_noise: in electrons; white is ``full_well``
    read_noise: float
    quality: int  # of the JPEG

    @property
    def exposure_in_chips(self) -> float:
        """The exposure as a number of chips."""
        return self.exposure_time * self.switching_frequency

    @property
    def columns_a_chip(self) -> float:
        """The columns that are read out while one chip is sent."""
        return 1.0 / (self.switching_frequency * self.readout_time)


def random_world(seed: int) -> World:
    """Draw what is photographed and by which camera."""
    random = np.random.default_rng([1907, seed])

    def between(low: float, high: float) -> float:
        return float(random.uniform(low, high))

    def over_decades(low: float, high: float) -> float:
        return math.exp(between(math.log(low), math.log(high)))

    rows, columns = int(random.integers(160, 400)), int(random.integers(1000, 2400))
    lamp = random_lamp(random, rows, columns)
    chip_columns = over_decades(2.0, 40.0)
    most = int(2.0 * lamp.half_width / (_SEEN_PERIODS * chip_columns))
    chips = _random_chips(random, most)
    readout = over_decades(2e-6, 30e-6)
    frequency = 1.0 / (chip_columns * readout)
    known = bool(random.integers(2))
    return World(
        seed=seed,
        chips=chips,
        switching_frequency=frequency,
        readout_time=readout,
        exposure_time=over_decades(0.1, 4.0) / frequency,
        start_time=between(0.0, len(chips)) / frequency,
        rows=rows,
        columns=columns,
        lamp=lamp,
        curve=power(KNOWN_GAMMA) if known else unknown_curve(random),
        saturated=max(0.0, between(-0.1, MOST_SATURATED)),
        ambient=over_decades(0.0005, 0.1),
        peak=between(0.15, 0.9),
        vignetting=between(0.0, 0.5),
        blur=between(0.0, 1.5),
        blur_shape=_random_shape(seed),
        blur_of_values=bool(random.integers(2)),
        full_well=over_decades(300.0, 8000.0),
        read_noise=between(1.0, 6.0),
        quality=int(random.integers(50, 96)),
    )


def _random_chips(random: np.random.Generator, most: int) -> str:
    """Draw a square wave, a Manchester-coded packet behind a header, or any other sequence."""
    kind = int(random.integers(4))
    if kind == 0 or most < 5:
        return "10"
    if kind == 1 and most >= 14:
        bits = random.integers(0, 2, min(10, (most - 4) // 2))
        return "1110" + "".join("10" if bit else "01" for bit in bits)
    while True:
        chips = "".join(map(str, random.integers(0, 2, int(random.integers(5, min(most, 30) + 1)))))
        if "10" in chips + chips[0] and "1111" not in 2 * chips and "0000" not in 2 * chips:
            return chips


def _random_shape(seed: int) -> str:
    # By its own seed, so that all else is drawn as it would be without.
    random = np.random.default_rng([1951, seed])
    return str(random.choice(["normal", "normal", "box", "exponential"]))


def lit_fraction(world: World) -> np.ndarray:
    """Return the fraction of each column's exposure in which the lamp is lit, shape (columns,)."""
    levels = [float(chip) for chip in world.chips]
    begin = world.start_time + world.readout_time * np.arange(world.columns)
    return mean_light(levels, begin * world.switching_frequency, world.exposure_in_chips)


def falloff(world: World) -> np.ndarray:
    """Return the fraction of the light that the lens passes on to each pixel."""
    rows, columns = world.rows, world.columns
    down = (np.arange(rows)[:, None] / rows - 0.5) * rows / columns
    across = np.arange(columns)[None, :] / columns - 0.5
    return np.asarray(1.0 - world.vignetting * 2.0 * (down**2 + across**2))


def scale(world: World) -> float:
    """Return what makes a lamp of light 1 white, or as bright as the world's is."""
    light = _light(world)
    seen = light[world.lamp.covers(world.rows, world.columns)]
    if world.saturated == 0.0:
        return float(world.peak / seen.max())
    # Where a lamp is mostly off, its dark pixels stay well below white.
    least = 3.0 * world.ambient + 0.05
    return 1.0 / max(float(np.quantile(seen, 1.0 - world.saturated)), least)


def _light(world: World) -> np.ndarray:
    brightness = world.lamp.brightness(world.rows, world.columns)
    return np.asarray((brightness * lit_fraction(world)[None, :] + world.ambient) * falloff(world))


def photograph(world: World) -> np.ndarray:
    """Take the photograph, shape (rows, columns), uint8."""
    random = np.random.default_rng([1933, world.seed])
    light = _light(world) * scale(world)
    electrons = random.poisson(light * world.full_well).astype(np.float64)
    electrons += world.read_noise * random.standard_normal(electrons.shape)
    light = np.clip(electrons / world.full_well, 0.0, 1.0)
    if not world.blur_of_values:
        light = blurred(light, world.blur, world.blur_shape)
    values = 255.0 * world.curve(light)
    if world.blur_of_values:
        values = blurred(values, world.blur, world.blur_shape)
    return compress(np.rint(values).astype(np.uint8), world.quality)


def blurred(values: np.ndarray, deviation: float, shape: str) -> np.ndarray:
    """Blur a picture by a standard deviation in columns, and a shape as a world's."""
    if deviation <= 0.1:  # no shape has weight beyond its own pixel
        return values
    if shape == "normal":
        return cv2.GaussianBlur(values, (0, 0), deviation)
    off = np.abs(np.arange(-_REACH, _REACH + 1))
    if shape == "box":
        kernel = np.clip(math.sqrt(3.0) * deviation + 0.5 - off, 0.0, 1.0)
    else:
        kernel = np.exp(-math.sqrt(2.0) / deviation * off)
    kernel /= kernel.sum()
    return cv2.sepFilter2D(values, -1, kernel, kernel)


def compress(image: np.ndarray, quality: int) -> np.ndarray:
    """Keep a picture as a JPEG and read it again."""
    _, data = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, quality])
    return np.asarray(cv2.imdecode(data, cv2.IMREAD_GRAYSCALE))
