"""Photographs of lamps as they are found in rooms, drawn without the model: one seed, one picture.

Round lamps, and tubes on a slope, are bright in their middle and fall off by up to a factor of
thirty to their rim; light is scattered around them and mirrored below them. They are small or
large, one or several, exposed for 0.05 to 8 chips. What they send is given by the places of its
edges, so that a transmitter may pause between bursts, and its edges jitter by up to half a column.
"""

import math
from dataclasses import dataclass, replace

import cv2
import numpy as np

from photo_world.lamp_scenes import LampScene, Thing, apart
from photo_world.photograph import blurred, compress
from photo_world.tone_curves import unknown_curve

_PLACES = 60
"""Places that are tried for a lamp before it is left out."""

_GAP = 20.0  # fewest pixels between lamps
_STEEPEST = 0.15
_SEEN = 0.1
"""Depth of a lamp's stripes, as a fraction of its light, from which it is to be found."""


@dataclass(frozen=True)
class Sent:
    """What a lamp sends, in columns: ``on`` and ``off`` are the places of its edges."""

    chips: str
    chip: float
    on: np.ndarray
    off: np.ndarray
    pauses: bool

    def lit_fraction(self, columns: int, exposure: float) -> np.ndarray:
        """Return the lit fraction of each column's exposure, shape (columns,)."""
        edges = np.stack([self.on, self.off], axis=1).ravel()
        gathered = np.repeat(np.cumsum(self.off - self.on), 2)
        gathered[0::2] -= self.off - self.on
        begin = np.arange(columns, dtype=np.float64)
        lit = np.interp(begin + exposure, edges, gathered) - np.interp(begin, edges, gathered)
        return np.asarray(lit / exposure)


@dataclass(frozen=True)
class HotLamps:
    """A picture, and the truth of it; lengths and times are counted in columns."""

    image: np.ndarray
    lamps: tuple[Thing, ...]
    sent: tuple[Sent, ...]
    exposure: float

    @property
    def scene(self) -> LampScene:
        """What a search for lamps is to find: an exposure may hide what a lamp sends."""
        columns = self.image.shape[1]
        blinks = [np.ptp(one.lit_fraction(columns, self.exposure)) > _SEEN for one in self.sent]
        both = list(zip(self.lamps, blinks, strict=True))
        seen, hidden = (tuple(one for one, is_ in both if is_ == yes) for yes in (True, False))
        return LampScene(self.image, seen, hidden)


def hot_lamps(seed: int, most: int = 1) -> HotLamps:
    """Draw up to so many lamps in a picture; where there is only one, most of it is in view."""
    random = np.random.default_rng([seed, 2203])
    shape = (
        int(random.integers(160, 500)) if most == 1 else int(random.integers(700, 1200)),
        int(random.integers(500, 1600)) if most == 1 else int(random.integers(1000, 1800)),
    )
    things: list[Thing] = []
    sent: list[Sent] = []
    for _ in range(int(random.integers(1, most + 1))):
        wave = _draw_sent(random, shape[1])
        thing = _place(random, wave, shape, things, alone=most == 1)
        if thing is not None:
            things.append(thing)
            sent.append(wave)
    if not things:
        return hot_lamps(seed + 1_000_000, most)
    exposure = min(wave.chip for wave in sent) * _over_decades(random, 0.05, 8.0)
    light = np.full(shape, _over_decades(random, 2e-4, 0.05))
    for thing, wave in zip(things, sent, strict=True):
        lit = wave.lit_fraction(shape[1], exposure)
        light += thing.radiance * _surface(random, thing, shape) * lit
        if random.random() < 0.3:
            mirrored = _mirror(random, thing, shape)
            light += mirrored.radiance * _surface(random, mirrored, shape) * lit
    return HotLamps(_photograph(random, light), tuple(things), tuple(sent), exposure)


def hot_lamp_scene(seed: int) -> LampScene:
    """Draw a scene with up to eight lamps to be found."""
    return hot_lamps(seed, most=8).scene


def _over_decades(random: np.random.Generator, low: float, high: float) -> float:
    return math.exp(random.uniform(math.log(low), math.log(high)))


def _draw_sent(random: np.random.Generator, columns: int) -> Sent:
    """Draw a square wave (six of ten), a pulse of another duty, or a packet behind a header."""
    kind, chip = random.random(), _over_decades(random, 3.0, 30.0)
    if kind < 0.6:
        chips = "10"
    elif kind < 0.75:
        chips, chip = ("1" * int(random.integers(2, 9))).ljust(10, "0"), chip / 5.0
    else:
        chips = "1110" + "".join("10" if bit else "01" for bit in random.integers(0, 2, 6))
    levels = np.array([int(one) for one in chips], dtype=np.int8)
    periods = math.ceil((columns + 9 * chip) / (chip * len(chips))) + 2
    waves = np.tile(levels, periods)
    rising = np.flatnonzero(np.diff(waves, prepend=0) == 1).astype(np.float64)
    falling = np.flatnonzero(np.diff(waves, append=0) == -1) + 1.0
    start = -random.uniform(0.0, len(chips))
    on, off = chip * (rising + start), chip * (falling + start)
    jitter = max(0.0, random.uniform(-0.5, 0.5))
    pauses = random.random() < 0.1
    if pauses:  # some periods, and a time that is not a whole number of chips
        burst = rising // (len(chips) * int(random.integers(3, 8)))
        late = burst * random.uniform(1.0, 6.0) * chip
        on, off = on + late, off + late
    move = min(jitter, 0.1 * chip) * random.standard_normal((2, len(on)))
    return Sent(chips, chip, on + move[0], off + move[1], pauses)


def _place(
    random: np.random.Generator,
    wave: Sent,
    shape: tuple[int, int],
    others: list[Thing],
    *,
    alone: bool,
) -> Thing | None:
    """Choose a lamp's size, and a place where it touches no other."""
    rows, columns = shape
    period = wave.chip * len(wave.chips)
    least = max(3.5 * period, 40.0)
    for _ in range(_PLACES):
        width = random.uniform(0.3, 0.9) * columns if alone else least * random.uniform(1.0, 2.5)
        round_lamp = random.random() < 0.6
        height = width if round_lamp else random.uniform(40.0, 0.5 * rows) + _STEEPEST * width
        height = min(height, 0.95 * rows)
        if alone and round_lamp:
            width = min(width, 1.3 * height)
        room = columns - width, rows - height
        if width < least or min(room) < 4.0:
            continue
        thing = Thing(
            "round" if round_lamp else "rectangular",
            height / 2 + random.uniform(2.0, room[1] - 2.0),
            width / 2 + random.uniform(2.0, room[0] - 2.0),
            height, width, math.exp(random.uniform(-1.5, 2.0)),
            tuple(map(float, wave.chips)), wave.chip,
        )  # fmt: skip
        if all(apart(thing, other, _GAP) for other in others):
            return thing
    return None


def _mirror(random: np.random.Generator, thing: Thing, shape: tuple[int, int]) -> Thing:
    """Mirror a lamp in what lies below it: fainter, and as wide."""
    fraction = random.uniform(0.02, 0.15)
    row = min(thing.row + thing.height * random.uniform(1.2, 2.0), shape[0] - 1.0)
    return replace(thing, row=row, radiance=fraction * thing.radiance)


def _surface(random: np.random.Generator, thing: Thing, shape: tuple[int, int]) -> np.ndarray:
    """Return the light of each pixel of a lamp that is on: 1 in its hot middle."""
    slope = random.uniform(-1.0, 1.0) * _STEEPEST if thing.shape == "rectangular" else 0.0
    across = np.arange(shape[1])[None, :] - thing.column
    down = np.arange(shape[0])[:, None] - thing.row - slope * across
    down = down / (0.5 * (thing.height - abs(slope) * thing.width))
    across = across / (0.5 * thing.width)
    far = np.hypot(across, down)
    rim = far if thing.shape == "round" else np.maximum(np.abs(across), np.abs(down))
    edge = 0.5 * min(thing.width, thing.height) / random.uniform(1.0, 8.0)
    direct = np.clip((1.0 - rim) * edge + 0.5, 0.0, 1.0)
    direct *= 10.0 ** (-random.uniform(0.0, 1.5) * np.minimum(far, 1.2) ** 2)
    halo, size = random.uniform(0.0, 0.15), random.uniform(0.1, 0.5) * thing.height
    scattered = _scatter(direct, size)
    return np.asarray((1.0 - halo) * direct + halo * scattered)


def _scatter(light: np.ndarray, size: float) -> np.ndarray:
    """Blur by a standard deviation in pixels; a wide blur needs no fine pixels."""
    coarse = max(1, int(size / 6.0))
    rows, columns = light.shape
    small = cv2.resize(
        light, (-(-columns // coarse), -(-rows // coarse)), interpolation=cv2.INTER_AREA
    )
    small = cv2.GaussianBlur(small, (0, 0), size / coarse)
    return cv2.resize(small, (columns, rows), interpolation=cv2.INTER_LINEAR)


def _photograph(random: np.random.Generator, light: np.ndarray) -> np.ndarray:
    """Add noise, clip at white, and apply a blur, a tone curve that nobody knows, and JPEG."""
    full_well = _over_decades(random, 500.0, 8000.0)
    electrons = random.poisson(np.minimum(light, 3.0) * full_well)
    seen = np.clip(electrons / full_well, 0.0, 1.0)
    seen = np.clip(blurred(seen, random.uniform(0.0, 1.5), "normal"), 0.0, 1.0)
    values = np.rint(255.0 * unknown_curve(random)(seen)).astype(np.uint8)
    return compress(values, int(random.integers(60, 96)))
