"""Pairs of pictures of rooms under lamps on the mains, drawn without the model's own simulation.

Lamps of several kinds hang on the three phases of the mains and light parts of a textured room;
their light is integrated over each line's exposure from a table of one cycle.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from photo_world.exposures import mean_light
from photo_world.photograph import compress
from photo_world.tone_curves import Curve, unknown_curve

_PHASES = 3
_STEPS = 2048  # of the table of one cycle of light


@dataclass(frozen=True)
class Room:
    """The truth of one pair, in SI units."""

    seed: int
    mains_frequency: float
    frame_readout: float  # from the first to after the last line
    exposures: tuple[float, float]
    starts: tuple[float, float]  # of the first lines' exposures
    size: tuple[int, int]  # lines, columns
    has_bars: bool
    is_textured: bool
    shift: tuple[float, float]  # pixels by which the second picture is moved, across and down
    curve: Curve
    full_well: float
    quality: int
    gain: float  # brightness of the picture
    has_slats: bool

    @property
    def bars(self) -> float:
        """Cycles of the light while a frame is read."""
        return 2.0 * self.mains_frequency * self.frame_readout


def random_room(seed: int, *, has_bars: bool = True) -> Room:
    """Draw a room and a camera; half of the second pictures are exposed long, half as the first."""
    random = np.random.default_rng([6707, seed])
    frequency = float(random.choice([50.0, 60.0]))
    bars = float(np.exp(random.uniform(np.log(0.8), np.log(7.0))))
    first = 1.0 / float(random.choice([250.0, 500.0, 1000.0, 2000.0, 4000.0]))
    second = first if random.random() < 0.5 else float(random.uniform(1 / 30, 1 / 12))
    largest = 1.0 if has_bars else 3.0
    return Room(
        seed=seed,
        mains_frequency=frequency,
        frame_readout=bars / (2.0 * frequency),
        exposures=(first, second),
        starts=(float(random.uniform(0, 1)), float(random.uniform(2, 3))),
        size=(int(random.integers(240, 700)), int(random.integers(300, 900))),
        has_bars=has_bars,
        is_textured=bool(random.random() < 0.8),
        shift=(float(random.uniform(-largest, largest)), float(random.uniform(-largest, largest))),
        curve=unknown_curve(random),
        full_well=float(np.exp(random.uniform(np.log(800), np.log(10_000)))),
        quality=int(random.integers(75, 96)),
        gain=float(random.uniform(0.15, 0.7)),
        has_slats=bool(random.random() < 0.3),
    )


def photograph_room(room: Room) -> list[np.ndarray]:
    """Take both pictures, arrays of uint8 of shape (lines, columns)."""
    random = np.random.default_rng([6708, room.seed])
    albedo = _albedo(room, random)
    places = [_spread(room, random) for _ in range(int(random.integers(1, 5)))]
    lamps = [_cycle(random) if room.has_bars else np.ones(_STEPS) for _ in places]
    phases = [int(random.integers(_PHASES)) / _PHASES + 0.02 * random.normal() for _ in places]
    ambient = float(random.choice([0.0, 0.1, 0.5])) * _spread(room, random)
    pictures, scale = [], 0.0
    for index, (exposure, start) in enumerate(zip(room.exposures, room.starts, strict=True)):
        light = ambient.copy()
        for place, lamp, phase in zip(places, lamps, phases, strict=True):
            light += place * _expose(room, lamp, phase, start, exposure)[:, None]
        seen = light * (_move(albedo, room.shift) if index else albedo)
        brightness = float(np.quantile(seen, 0.8)) / random.uniform(0.8, 1.25)
        same = index and room.exposures[0] == exposure
        scale = scale if same else room.gain / brightness
        pictures.append(_sense(room, seen * scale, random))
    return pictures


def _albedo(room: Room, random: np.random.Generator) -> np.ndarray:
    """Draw what the walls reflect: noise at all scales, furniture, and perhaps slats."""
    rows, columns = room.size
    picture = np.zeros(room.size)
    if room.is_textured:
        for size in (2, 6, 20, 60):
            noise = cv2.GaussianBlur(random.standard_normal(room.size), (0, 0), size)
            picture += random.uniform(0.0, 0.25) * noise / noise.std()
        for _ in range(int(random.integers(3, 25))):
            top, left = int(random.integers(rows)), int(random.integers(columns))
            high, wide = int(random.integers(4, rows // 2)), int(random.integers(4, columns // 2))
            picture[top : top + high, left : left + wide] += random.normal(0.0, 0.6)
    if room.has_slats and room.is_textured:
        period, tilt = random.uniform(8, rows / 3), random.normal(0.0, 0.01)
        place = np.arange(rows)[:, None] + tilt * np.arange(columns)[None, :]
        picture += random.uniform(0.1, 1.0) * ((place / period) % 1.0 < random.uniform(0.3, 0.7))
    down, across = np.indices(room.size)
    radius = ((down / rows - 0.5) ** 2 + (across / columns - 0.5) ** 2) * 2.0
    vignetting = 1.0 - random.uniform(0.0, 0.5) * radius
    return np.asarray(np.exp(picture - picture.max() * 0.5) * vignetting)


def _spread(room: Room, random: np.random.Generator) -> np.ndarray:
    """Draw how one lamp lights the picture: by its distance, with soft shadows."""
    down, across = np.indices(room.size) / np.array(room.size).reshape(2, 1, 1)
    middle, height = random.uniform(-0.3, 1.3, 2), random.uniform(0.3, 1.5)
    light = 1.0 / ((down - middle[0]) ** 2 + (across - middle[1]) ** 2 + height**2)
    shadow = cv2.GaussianBlur(random.standard_normal(room.size), (0, 0), room.size[0] / 5)
    return np.asarray(light / light.mean() * np.exp(random.uniform(0, 0.4) * shadow / shadow.std()))


def _cycle(random: np.random.Generator) -> np.ndarray:
    """Draw a lamp's light over a cycle, of mean 1; its depth is 5 to 100 %."""
    phase = np.arange(_STEPS) / _STEPS
    sine = np.abs(np.sin(np.pi * phase))
    kind = int(random.integers(5))
    if kind == 0:  # light as the current, or as its square
        light = sine ** random.uniform(1.0, 2.0)
    elif kind == 1:  # a capacitor that the mains load
        light = np.exp(-phase / random.uniform(0.2, 2.0)) + random.uniform(0, 1) * sine
    elif kind == 2:  # current above a threshold only, with soft ends
        light = np.clip((sine - random.uniform(0.2, 0.7)) / random.uniform(0.05, 0.3), 0.0, 1.0)
    elif kind == 3:  # cut by a dimmer
        light = np.where(phase > random.uniform(0.1, 0.5), sine, 0.0)
    else:
        light = 1.0 + np.cos(2.0 * np.pi * phase)
    light = light / light.mean()
    depth = float(np.exp(random.uniform(np.log(0.1), 0.0)))
    return np.asarray(1.0 + depth * (light - 1.0))


def _expose(
    room: Room, lamp: np.ndarray, phase: float, start: float, exposure: float
) -> np.ndarray:
    """Return the mean light of a lamp in each line's exposure, shape (lines,)."""
    rows = room.size[0]
    begin = start + room.frame_readout * np.arange(rows) / rows
    frequency = 2.0 * room.mains_frequency
    return mean_light(lamp, (begin * frequency + phase) * _STEPS, exposure * frequency * _STEPS)


def _move(picture: np.ndarray, shift: tuple[float, float]) -> np.ndarray:
    matrix = np.array([[1.0, 0.0, shift[0]], [0.0, 1.0, shift[1]]])
    return cv2.warpAffine(
        picture, matrix, picture.shape[::-1], flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REFLECT
    )


def _sense(room: Room, light: np.ndarray, random: np.random.Generator) -> np.ndarray:
    electrons = random.poisson(light * room.full_well) + 3.0 * random.standard_normal(room.size)
    values = room.curve(np.clip(electrons / room.full_well, 0.0, 1.0))
    return compress(np.rint(255.0 * values).astype(np.uint8), room.quality)
