"""Photographs of several lamps at once, drawn without the model: one seed, one scene.

Round and rectangular lamps, some of them touching, send square waves, pulses or codes of 2 to 5 kHz
before a dark or a lit background. Beside them are lamps of constant light, window panes, and
reflections. Light is scattered in the lens before the shutter samples it, and the camera adds a
tone curve that nobody knows, noise, white that is clipped, and JPEG.
"""

import math
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import cv2
import numpy as np
from numpy.typing import NDArray

from photo_world.exposures import mean_light
from photo_world.photograph import compress

Floats: TypeAlias = NDArray[np.float64]
Shape = Literal["round", "rectangular"]

_PLACES = 400
"""Number of random places that are tried for a thing before it is left out."""

_GAP = 14
"""Fewest pixels between things that do not touch."""


@dataclass(frozen=True, slots=True)
class Thing:
    """A bright thing in the picture: what it is, where, how bright, and what it sends.

    ``wave`` holds the light of each chip, ``chip`` the columns of one, ``radiance`` is relative to
    white.
    """

    shape: Shape
    row: float
    column: float
    height: float
    width: float
    radiance: float
    wave: tuple[float, ...] = (1.0,)
    chip: float = 1.0
    phase: float = 0.0

    @property
    def box(self) -> tuple[float, float, float, float]:
        """First row, last row, first column, last column."""
        down, across = self.height / 2, self.width / 2
        return self.row - down, self.row + down, self.column - across, self.column + across


@dataclass(frozen=True, eq=False, slots=True)
class LampScene:
    """A simulated photograph, and the lamps in it."""

    image: NDArray[np.uint8]
    lamps: tuple[Thing, ...]
    constant: tuple[Thing, ...]


def lamp_scene(seed: int) -> LampScene:
    """Draw a scene with one to eight lamps."""
    random = np.random.default_rng([seed, 17])
    rows, columns = int(random.integers(900, 1300)), int(random.integers(1200, 2000))
    readout = float(np.exp(random.uniform(np.log(4e-6), np.log(20e-6))))
    placed: list[Thing] = []
    lamps = _lamps(random, rows, columns, readout, placed)
    constant = _others(random, rows, columns, placed, int(random.integers(0, 3)))
    panes = _panes(random, rows, columns, placed) if random.random() < 0.4 else ()
    reflections = _reflections(random, rows, columns, placed, lamps)
    longest = min(len(lamp.wave) * lamp.chip for lamp in lamps)
    shortest_chip = min(lamp.chip for lamp in lamps)
    exposure = min(float(np.exp(random.uniform(np.log(0.5), np.log(1.5 * shortest_chip)))), longest)
    light = _background(random, rows, columns)
    for thing in (*lamps, *constant, *panes, *reflections):
        _add_light(light, random, thing, exposure)
    return LampScene(_photograph(random, light), lamps, constant)


def _lamps(
    random: np.random.Generator, rows: int, columns: int, readout: float, placed: list[Thing]
) -> tuple[Thing, ...]:
    """Place lamps, each beside another one or away from all."""
    lamps: list[Thing] = []
    for _ in range(int(random.integers(1, 9))):
        wave, chip = _wave(random, readout)
        period = chip * len(wave)
        least = max(2.6 * period if len(wave) < 9 else 1.3 * period, 45.0)
        if least > 0.45 * columns:
            continue
        shape: Shape = "round" if random.random() < 0.5 else "rectangular"
        width = float(random.uniform(least, max(1.2 * least, min(4.0 * least, 0.3 * columns))))
        height = width if shape == "round" else float(random.uniform(40.0, 0.35 * rows))
        phase, radiance = random.uniform(0.0, period), float(np.exp(random.uniform(-1.0, 1.2)))
        lamp = Thing(shape, 0.0, 0.0, height, width, radiance, wave, chip, phase)
        touching = lamps[-1] if lamps and random.random() < 0.35 else None
        found = _place(random, lamp, rows, columns, placed, touching)
        if found is not None:
            lamps.append(found)
    return tuple(lamps) if lamps else _lamps(random, rows, columns, readout, placed)


def _wave(random: np.random.Generator, readout: float) -> tuple[tuple[float, ...], float]:
    """Draw what a lamp sends: the light of each chip, and the columns of a chip."""
    kind = random.random()
    columns = 1.0 / (float(random.uniform(2e3, 5e3)) * readout)
    if kind < 0.7:
        return (1.0, 0.0), columns
    if kind < 0.85:  # a pulse of a quarter to three quarters of a cycle
        on = int(random.integers(2, 7))
        return (1.0,) * on + (0.0,) * (8 - on), columns / 4.0
    bits = random.integers(0, 2, 6)
    code = [1.0, 1.0, 1.0, 0.0]
    for bit in bits:
        code += [1.0, 0.0] if bit else [0.0, 1.0]
    return tuple(code), columns


def _place(
    random: np.random.Generator,
    thing: Thing,
    rows: int,
    columns: int,
    placed: list[Thing],
    touching: Thing | None = None,
) -> Thing | None:
    """Move a thing to a free place, beside another one if that is named, and take that place."""
    for _ in range(_PLACES):
        row = float(random.uniform(thing.height / 2 + 8, max(rows - thing.height / 2 - 8, 9)))
        column = float(random.uniform(thing.width / 2 + 8, max(columns - thing.width / 2 - 8, 9)))
        if touching is not None and random.random() < 0.8:
            row, column = _beside(random, thing, touching)
        moved = replace(thing, row=row, column=column)
        top, bottom, left, right = moved.box
        inside = top >= 4 and left >= 4 and bottom <= rows - 4 and right <= columns - 4
        gaps = [(-1.0 if other is touching else float(_GAP)) for other in placed]
        free = all(apart(moved, other, gap) for other, gap in zip(placed, gaps, strict=True))
        if inside and free:
            placed.append(moved)
            return moved
    return None


def _beside(random: np.random.Generator, thing: Thing, other: Thing) -> tuple[float, float]:
    """Return a place at which two things touch, above, below, or to a side."""
    side, aside = random.integers(0, 2), 1.0 if random.random() < 0.5 else -1.0
    off = float(random.uniform(-0.3, 0.3))
    if thing.shape == other.shape == "round":
        off = 0.0  # discs touch at one point
    if side:
        return other.row + off * other.height, other.column + aside * (
            thing.width + other.width
        ) / 2
    return other.row + aside * (thing.height + other.height) / 2, other.column + off * other.width


def apart(one: Thing, other: Thing, gap: float) -> bool:
    """Whether the boxes of two things are so many pixels apart; less than 0: they may touch."""
    top, bottom, left, right = one.box
    above, below, before, after = other.box
    return (
        bottom + gap <= above or below + gap <= top or right + gap <= before or after + gap <= left
    )


def _others(
    random: np.random.Generator, rows: int, columns: int, placed: list[Thing], count: int
) -> tuple[Thing, ...]:
    """Place lamps of constant light."""
    found: list[Thing | None] = []
    for _ in range(count):
        shape: Shape = "round" if random.random() < 0.5 else "rectangular"
        width = float(random.uniform(50.0, 200.0))
        height = width if shape == "round" else float(random.uniform(50.0, 200.0))
        thing = Thing(shape, 0.0, 0.0, height, width, float(np.exp(random.uniform(-0.6, 1.2))))
        found.append(_place(random, thing, rows, columns, placed))
    return tuple(one for one in found if one is not None)


def _panes(
    random: np.random.Generator, rows: int, columns: int, placed: list[Thing]
) -> tuple[Thing, ...]:
    """Place a window: up to two by two panes between bars."""
    across, down = int(random.integers(1, 3)), int(random.integers(1, 3))
    width, height = float(random.uniform(60, 160)), float(random.uniform(60, 160))
    bar = float(random.uniform(15, 30))
    radiance = float(random.uniform(0.4, 1.5))
    whole = Thing(
        "rectangular", 0.0, 0.0, down * (height + bar) - bar, across * (width + bar) - bar, radiance
    )
    here = _place(random, whole, rows, columns, placed)
    if here is None:
        return ()
    top, _, left, _ = here.box
    return tuple(
        Thing(
            "rectangular", top + height / 2 + i * (height + bar),
            left + width / 2 + j * (width + bar), height, width, radiance,
        )
        for i in range(down) for j in range(across)
    )  # fmt: skip


def _reflections(
    random: np.random.Generator,
    rows: int,
    columns: int,
    placed: list[Thing],
    lamps: tuple[Thing, ...],
) -> tuple[Thing, ...]:
    """Place fainter pictures of lamps: they blink with them."""
    found: list[Thing | None] = []
    for lamp in lamps[:2]:
        if random.random() < 0.5:
            fraction = float(random.uniform(0.05, 0.3))
            faint = replace(lamp, radiance=fraction * min(lamp.radiance, 1.0))
            found.append(_place(random, faint, rows, columns, placed))
    return tuple(one for one in found if one is not None)


def _background(random: np.random.Generator, rows: int, columns: int) -> Floats:
    """Draw a dark or a lit wall, darker towards one side, with a soft texture."""
    lit = random.random() < 0.5
    level = float(random.uniform(0.01, 0.1)) if lit else float(random.uniform(0.0, 0.004))
    down, across = np.mgrid[0:rows, 0:columns] / max(rows, columns)
    slope = random.uniform(-0.6, 0.6, 2)
    wall = level * (1.0 + slope[0] * (down - 0.3) + slope[1] * (across - 0.5))
    rough = cv2.GaussianBlur(random.standard_normal((rows, columns)), (0, 0), 6.0)
    return np.asarray(np.maximum(wall * (1.0 + 1.5 * rough), 0.0), dtype=np.float64)


def _add_light(light: Floats, random: np.random.Generator, thing: Thing, exposure: float) -> None:
    """Add the light of a thing, scattered in the lens, as the shutter's columns sample it."""
    darker = float(random.uniform(0.0, 0.5))
    halo, wide = float(random.uniform(0.002, 0.02)), float(random.uniform(12.0, 40.0))
    blur = float(random.uniform(0.5, 1.6))
    rows, columns = light.shape
    # OpenCV's blur reaches four standard deviations: beyond, nothing is added.
    reach = math.ceil(4.0 * wide) + 4
    top, bottom, left, right = (round(side) for side in thing.box)
    here = (
        slice(max(top - reach, 0), min(bottom + reach, rows)),
        slice(max(left - reach, 0), min(right + reach, columns)),
    )
    surface = _surface(thing, rows, columns)[here]
    # A lamp's disc is darker towards its rim.
    down, across = np.mgrid[here].astype(np.float32)
    far = ((down - thing.row) / thing.height) ** 2 + ((across - thing.column) / thing.width) ** 2
    surface = surface * (1.0 - darker * np.minimum(4.0 * far, 1.0))
    seen = (1.0 - halo) * cv2.GaussianBlur(surface, (0, 0), blur)
    seen += halo * cv2.GaussianBlur(surface, (0, 0), wide)
    light[here] += thing.radiance * seen * _shutter(thing, columns, exposure)[here[1]]


def _surface(thing: Thing, rows: int, columns: int) -> NDArray[np.float32]:
    """Draw a thing's outline, filled."""
    surface = np.zeros((rows, columns), dtype=np.float32)
    if thing.shape == "round":
        centre = (round(thing.column * 16), round(thing.row * 16))
        axes = (round(thing.width * 8), round(thing.height * 8))
        cv2.ellipse(surface, centre, axes, 0, 0, 360, 1.0, -1, cv2.LINE_8, 4)
    else:
        top, bottom, left, right = (round(side) for side in thing.box)
        surface[top:bottom, left:right] = 1.0
    return surface


def _shutter(thing: Thing, columns: int, exposure: float) -> Floats:
    """Average a thing's light over each column's exposure, exactly."""
    begin = (np.arange(columns, dtype=np.float64) + thing.phase) / thing.chip
    return mean_light(thing.wave, begin, exposure / thing.chip)


def _photograph(random: np.random.Generator, light: Floats) -> NDArray[np.uint8]:
    """Add shot and read noise, clip at white, apply a tone curve, and store as JPEG."""
    electrons = float(random.uniform(500.0, 5000.0))
    noisy = random.poisson(np.clip(light, 0.0, 3.0) * electrons) / electrons
    noisy += random.normal(0.0, 2.0 / electrons, light.shape)
    toned = np.clip(noisy, 0.0, 1.0) ** (1.0 / float(random.uniform(1.7, 2.5)))
    bend = float(random.uniform(0.0, 0.4))
    toned = (1.0 - bend) * toned + bend * (3.0 - 2.0 * toned) * toned**2
    grey = np.rint(255.0 * toned).astype(np.uint8)
    quality = int(random.integers(60, 96))
    return compress(grey, quality)
