"""Pictures of single blinking lamps, drawn without the program's model: one seed, one picture.

The light of each line is the mean of a sampled waveform over the line's exposure. Whatever else
happens is what cameras do: hot spots, rims, lamps cut by the picture's border, light of the room
with bars of its own, photon noise, demosaicing, tone curves, sharpening, resizing, JPEG.
"""

import math
from dataclasses import dataclass

import cv2
import numpy as np

from photo_world.exposures import mean_light
from photo_world.tone_curves import any_camera_curve

_SAMPLES = 4096  # of a period
_LONGEST = 700  # columns of a lamp
_LEAST_CONTRAST = 0.05  # of the stripes, and of what is in view, over the brightest light


@dataclass(frozen=True)
class LampView:
    """A picture and its truth; lengths in columns of the picture, times in periods."""

    image: np.ndarray  # Shape (rows, columns), uint8
    period: float
    duty: float
    exposure: float
    classes: dict[str, str]  # What it is drawn with, by kind


@dataclass(frozen=True)
class _Recipe:
    """What is drawn, before the picture is resized by ``scale``."""

    period: float
    duty: float
    exposure: float
    periods: float
    rise: float  # time in which the light rises and falls, in periods
    lines: int  # that are read together
    spots: int
    contrast: float  # of the spots: their light over that beside them
    cut: bool
    peak: float  # light of the brightest pixel, 1 is white
    ambient: float
    has_bars: bool
    full_well: float
    sharpening: float
    scale: float
    quality: int
    is_coloured: bool


def lamp_view(seed: int) -> LampView:
    """Draw a lamp whose stripes can be seen."""
    random = np.random.default_rng([6701, seed])
    while True:
        recipe = _recipe(random)
        wave = _seen_light(np.linspace(0.0, 1.0, 500), recipe)
        if np.ptp(wave) <= _LEAST_CONTRAST * wave.max():
            continue
        light = _light(random, recipe)
        if light is not None:
            break
    image = _taken(random, recipe, light)
    return LampView(
        image, recipe.period * recipe.scale, recipe.duty, recipe.exposure, _classes(recipe)
    )


def _recipe(random: np.random.Generator) -> _Recipe:
    periods = _over_decades(random, 1.5, 40.0)
    columns = _over_decades(random, 70.0, _LONGEST)
    is_plain = random.random() < 0.4
    scale = float(random.uniform(0.4, 1.0)) if random.random() < 0.25 else 1.0
    duty = 0.5 if is_plain else float(random.uniform(0.05, 0.95))
    exposure = _over_decades(random, 0.02, 3.0)
    lines = int(random.choice([1, 1, 1, 1, 1, 1, 1, 1, 2, 4])) if scale == 1.0 else 1
    # Of fewer than two lines a period no camera tells a lamp from a slower one.
    period = max(columns / periods, 4.0 * lines)
    return _Recipe(
        period=period / scale,
        duty=duty,
        exposure=exposure,
        periods=min(periods, _LONGEST / period),
        rise=float(random.choice([0.0, 0.0, random.uniform(0.0, 0.01)])),
        lines=lines,
        spots=int(random.integers(0, 4)),
        contrast=_over_decades(random, 1.2, 12.0),
        cut=bool(random.random() < 0.25),
        peak=_over_decades(random, 0.2, 1.7),
        ambient=_over_decades(random, 1e-4, 0.03),
        has_bars=bool(random.random() < 0.3),
        full_well=_over_decades(random, 300.0, 20000.0),
        sharpening=float(random.uniform(0.1, 1.0)) if random.random() < 0.35 else 0.0,
        scale=scale,
        quality=int(random.integers(60, 99)),
        is_coloured=bool(random.random() < 0.5),
    )


def _classes(recipe: _Recipe) -> dict[str, str]:
    def part(value: float, *limits: float) -> str:
        above = [limit for limit in limits if value >= limit]
        return f"from {above[-1]:g}" if above else f"below {limits[0]:g}"

    return {
        "periods": part(recipe.periods, 2.5, 5.0, 10.0, 20.0),
        "columns a period": part(recipe.period * recipe.scale, 8.0, 16.0, 40.0, 100.0),
        "duty": part(recipe.duty, 0.15, 0.35, 0.65, 0.85),
        "exposure": part(recipe.exposure, 0.05, 0.15, 0.4, 1.0, 2.0),
        "hot spot": "none" if not recipe.spots else part(recipe.contrast, 3.0, 6.0),
        "white": part(recipe.peak, 0.5, 1.0, 1.3),
        "lines at once": str(recipe.lines),
        "sharpened": part(recipe.sharpening, 0.01, 0.4, 0.7),
        "JPEG": part(recipe.quality, 75, 90),
        "resized": part(recipe.scale, 1.0),
        "room": "bars" if recipe.has_bars else part(recipe.ambient, 0.003),
        "cut": "yes" if recipe.cut else "no",
    }


def _over_decades(random: np.random.Generator, low: float, high: float) -> float:
    return math.exp(random.uniform(math.log(low), math.log(high)))


def _seen_light(time: np.ndarray, recipe: _Recipe) -> np.ndarray:
    """Return the mean light of exposures that begin at some times, in periods."""
    instant = (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    steep = max(recipe.rise, 1.0 / _SAMPLES)
    # Lit from 0 to the duty, with straight flanks.
    off = np.abs((instant - 0.5 * recipe.duty + 0.5) % 1.0 - 0.5)
    wave = np.clip((0.5 * recipe.duty - off) / steep + 0.5, 0.0, 1.0)
    return mean_light(wave, time * _SAMPLES, recipe.exposure * _SAMPLES)


def _light(random: np.random.Generator, recipe: _Recipe) -> np.ndarray | None:
    """Return the light of each pixel before the camera, 1 is white; None if all lines are dark."""
    across = max(recipe.periods * recipe.period, 40.0)
    is_round = random.random() < 0.6
    down = across * float(random.uniform(0.7, 1.0)) if is_round else random.uniform(30.0, 250.0)
    down = min(max(down, 24.0), 200.0)
    beside = 0.12 * across + random.uniform(8.0, 60.0, 4)
    columns, rows = round(across + beside[0] + beside[1]), round(down + beside[2] + beside[3])
    y, x = np.mgrid[0:rows, 0:columns].astype(np.float64)
    x, y = (x - beside[0] - across / 2) / (across / 2), (y - beside[2] - down / 2) / (down / 2)
    far = np.hypot(x, y) if is_round else np.maximum(np.abs(x), np.abs(y))
    soft = random.uniform(1.0, 3.0) / min(across, down)
    lamp = np.clip((1.0 - far) / soft + 0.5, 0.0, 1.0)
    spots = np.zeros_like(x)
    for _ in range(recipe.spots):
        middle, size = random.uniform(-0.6, 0.6, 2), random.uniform(0.2, 0.9)
        near = ((x - middle[0]) ** 2 + (y - middle[1]) ** 2) / size**2
        spots += random.uniform(0.3, 1.0) * np.exp(-near)
    lamp = lamp * (1.0 + (recipe.contrast - 1.0) * spots / max(float(spots.max()), 1e-9))
    if random.random() < 0.3:  # a rim of its housing: darker, or brighter
        lamp = np.where(far > random.uniform(0.8, 0.95), lamp * random.uniform(0.3, 1.3), lamp)
    halo = random.uniform(0.0, 0.04)
    lens = cv2.GaussianBlur(lamp, (0, 0), float(random.uniform(0.5, 2.0)))
    lens = (1.0 - halo) * lens + halo * cv2.GaussianBlur(lamp, (0, 0), 0.15 * across)
    line = np.arange(columns) // recipe.lines * recipe.lines
    wave = _seen_light(line / recipe.period + random.uniform(0.0, 1.0), recipe)
    light = lens * wave
    brightest = float(np.quantile(light, 0.998))
    if brightest < _LEAST_CONTRAST * float(lens.max()):
        return None
    light *= recipe.peak / brightest
    room = _room(random, recipe, light.shape)
    if recipe.cut:
        first, last = random.uniform(0.0, 0.3, 2)
        light, room = (
            each[:, round(first * columns) : columns - round(last * columns)]
            for each in (light, room)
        )
    return np.asarray(light + room)


def _room(random: np.random.Generator, recipe: _Recipe, shape: tuple[int, ...]) -> np.ndarray:
    """Return the light of a wall, with a texture, and with the bars of mains lamps."""
    rough = cv2.GaussianBlur(random.standard_normal(shape), (0, 0), 5.0)
    room = recipe.ambient * np.clip(1.0 + 2.0 * rough, 0.0, None)
    if recipe.has_bars:
        period = recipe.period * random.uniform(7.0, 60.0)
        phase = np.arange(shape[1]) / period + random.uniform(0.0, 1.0)
        room = room * (1.0 + random.uniform(0.1, 0.8) * np.cos(2.0 * np.pi * phase))
    return np.asarray(room)


def _taken(random: np.random.Generator, recipe: _Recipe, light: np.ndarray) -> np.ndarray:
    """Take a picture of light by its photons, process it, and store it as a JPEG."""
    tint = random.uniform(0.55, 1.0, 3) if recipe.is_coloured else np.ones(1)
    tint[len(tint) // 2] = 1.0
    read_noise, blur = random.uniform(1.0, 5.0), float(random.uniform(0.15, 0.75))
    curve, radius = any_camera_curve(random), float(random.uniform(0.6, 1.8))
    planes = []
    for factor in tint:
        caught = random.poisson(np.minimum(light * factor, 4.0) * recipe.full_well)
        caught = caught + random.normal(0.0, read_noise, light.shape)
        seen = np.clip(caught / recipe.full_well, 0.0, 1.0)
        planes.append(curve(np.clip(cv2.GaussianBlur(seen, (0, 0), blur), 0.0, 1.0)))
    picture = np.stack(planes, axis=-1)
    soft = cv2.GaussianBlur(picture, (0, 0), radius).reshape(picture.shape)
    picture = np.clip(picture + recipe.sharpening * (picture - soft), 0.0, 1.0)
    if recipe.scale != 1.0:
        size = round(picture.shape[1] * recipe.scale), round(picture.shape[0] * recipe.scale)
        matrix = np.array([[recipe.scale, 0.0, 0.0], [0.0, recipe.scale, 0.0]])
        soft = cv2.GaussianBlur(picture, (0, 0), 0.4 / recipe.scale)
        picture = cv2.warpAffine(soft, matrix, size, flags=cv2.INTER_LINEAR)
    stored = np.rint(255.0 * np.clip(picture, 0.0, 1.0)).astype(np.uint8)
    how = [cv2.IMWRITE_JPEG_QUALITY, recipe.quality]
    how += [cv2.IMWRITE_JPEG_SAMPLING_FACTOR, cv2.IMWRITE_JPEG_SAMPLING_FACTOR_420]
    _, file = cv2.imencode(".jpg", stored, how)
    return np.asarray(cv2.imdecode(file, cv2.IMREAD_GRAYSCALE))
