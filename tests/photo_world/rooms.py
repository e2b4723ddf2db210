"""Photographs of whole rooms, drawn without the model: small lamps of all kinds, far apart.

Reflectors with dark lines across and patches of light, globes that glow without a rim, flat strips,
discs; bright and dim by a factor of sixty in light, in a dark room with windows and door frames.
Each lamp has a frequency and a phase of its own, and all are exposed alike.
"""

import math
from dataclasses import replace

import cv2
import numpy as np

from photo_world.exposures import mean_light
from photo_world.lamp_scenes import LampScene, Thing, apart
from photo_world.photograph import compress
from photo_world.tone_curves import unknown_curve

_GAP = 90.0  # fewest pixels between lamps, whose light is scattered around them
_GLOW = 1.75  # radii of a globe's glow within which it is brighter than a quarter, by grey level


def room_scene(seed: int) -> LampScene:
    """Draw a room with two to six lamps."""
    random = np.random.default_rng([seed, 90210])
    rows, columns = int(random.integers(1200, 2200)), int(random.integers(1200, 2200))
    readout = math.exp(random.uniform(math.log(9e-6), math.log(22e-6)))
    exposure = random.uniform(20e-6, 80e-6) / readout
    light = _room(random, rows, columns)
    lamps: list[Thing] = []
    for _ in range(int(random.integers(2, 7))):
        period = 1.0 / (random.uniform(2000.0, 5000.0) * readout)
        lamp, surface = _lamp(random, period)
        for _ in range(60):
            row = random.uniform(lamp.height, rows - lamp.height)
            column = random.uniform(lamp.width, columns - lamp.width)
            placed = replace(lamp, row=row, column=column)
            if all(apart(placed, other, _GAP) for other in lamps):
                _add(light, placed, surface, exposure)
                lamps.append(placed)
                break
    return LampScene(_photograph(random, light), tuple(lamps), ())


def _room(random: np.random.Generator, rows: int, columns: int) -> np.ndarray:
    """Draw a dark room with a few bright frames, upright and level."""
    light = np.full((rows, columns), math.exp(random.uniform(math.log(1e-4), math.log(3e-3))))
    for _ in range(int(random.integers(0, 4))):
        thick, long = int(random.integers(8, 60)), int(random.integers(200, 900))
        high, wide = (long, thick) if random.random() < 0.7 else (thick, long)
        top = int(random.integers(0, max(rows - high, 1)))
        left = int(random.integers(0, max(columns - wide, 1)))
        light[top : top + high, left : left + wide] += random.uniform(0.01, 0.15)
    return cv2.GaussianBlur(light, (0, 0), 2.0)


def _lamp(random: np.random.Generator, period: float) -> tuple[Thing, np.ndarray]:
    """Choose a lamp, and draw the light of each of its pixels while it is lit."""
    width = period * random.uniform(3.5, 9.0)
    kind = str(random.choice(["reflector", "globe", "strip", "disc"]))
    height = random.uniform(18.0, 40.0) if kind == "strip" else width
    across = np.linspace(-1.0, 1.0, round(width * (2.0 if kind == "globe" else 1.0)))
    down = np.linspace(-1.0, 1.0, round(height * (2.0 if kind == "globe" else 1.0)))
    far = np.hypot(down[:, None], across[None, :])
    if kind == "globe":
        surface = np.exp(-((2.0 * _GLOW * far) ** 2))
    elif kind == "strip":
        surface = np.ones_like(far)
    else:
        surface = np.where(far < 1.0, 1.0, 0.0)
    if kind == "reflector":
        rough = cv2.GaussianBlur(random.standard_normal(far.shape), (0, 0), 0.06 * width)
        surface *= np.exp(0.7 * rough / rough.std()) / 3.0
        for _ in range(int(random.integers(2, 5))):
            angle, off = random.uniform(0.0, math.pi), random.uniform(-0.6, 0.6)
            line = np.abs(math.cos(angle) * down[:, None] + math.sin(angle) * across[None] - off)
            surface[line * width < random.uniform(2.0, 8.0)] *= 0.1
    radiance = math.exp(random.uniform(math.log(0.05), math.log(3.0)))
    thing = Thing(
        "rectangular" if kind == "strip" else "round", 0.0, 0.0, height, width, radiance,
        (1.0, 0.0), 0.5 * period, random.uniform(0.0, period),
    )  # fmt: skip
    return thing, surface


def _add(light: np.ndarray, lamp: Thing, surface: np.ndarray, exposure: float) -> None:
    high, wide = surface.shape
    top, left = round(lamp.row - 0.5 * high), round(lamp.column - 0.5 * wide)
    top, left = max(top, 0), max(left, 0)
    part = light[top : top + high, left : left + wide]
    surface = surface[: part.shape[0], : part.shape[1]]
    begin = (np.arange(left, left + part.shape[1]) + lamp.phase) / lamp.chip
    part += lamp.radiance * surface * mean_light(lamp.wave, begin, exposure / lamp.chip)


def _photograph(random: np.random.Generator, light: np.ndarray) -> np.ndarray:
    scattered = 0.004 * cv2.GaussianBlur(light, (0, 0), 30.0)
    seen = cv2.GaussianBlur(light + scattered, (0, 0), random.uniform(0.4, 1.2))
    well = math.exp(random.uniform(math.log(800.0), math.log(6000.0)))
    seen = np.clip(random.poisson(np.clip(seen, 0.0, 3.0) * well) / well, 0.0, 1.0)
    grey = np.rint(255.0 * unknown_curve(random)(seen)).astype(np.uint8)
    return compress(grey, int(random.integers(70, 96)))
