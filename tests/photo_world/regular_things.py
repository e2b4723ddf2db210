"""Regular things that are no lamps, and what is said of them where a lamp is asked for.

Upright blinds with black gaps are drawn, too, but counted by themselves: one picture cannot tell
them from a lamp.
"""

from collections.abc import Callable, Sequence

import cv2
import numpy as np
from simulated_photos import photo_of

import occ_model as occ
from occ_model.arrays import FloatArray
from photo_world import negatives

Random = np.random.Generator
Kind = Callable[[Random], FloatArray]


def _grid(random: Random) -> tuple[FloatArray, FloatArray]:
    rows, columns = int(random.integers(120, 300)), int(random.integers(240, 600))
    y, x = np.mgrid[0:rows, 0:columns].astype(np.float64)
    return y, x


def _in_perspective(y: FloatArray, x: FloatArray, random: Random) -> tuple[FloatArray, FloatArray]:
    """Return places on a wall that is seen from the side."""
    depth = 1.0 + random.uniform(-0.8, 0.8) * (x / x.max() - 0.5)
    return (y - y.mean()) / depth + y.mean(), x / depth


def _grain(random: Random, shape: tuple[int, ...], size: float) -> FloatArray:
    noise = cv2.GaussianBlur(random.standard_normal(shape), (0, 0), size)
    return np.asarray(noise / noise.std(), dtype=np.float64)


def brick_wall(random: Random) -> FloatArray:
    """Draw courses of bricks that differ, every second moved by half a brick, half of them far."""
    y, x = _grid(random)
    if random.random() < 0.5:
        y, x = _in_perspective(y, x, random)
    length, height = random.uniform(24.0, 80.0), random.uniform(10.0, 30.0)
    joint, mortar = random.uniform(0.06, 0.15), random.uniform(0.3, 0.8)
    course = np.floor(y / height)
    along = x / length + 0.5 * (course % 2)
    tones = random.uniform(0.1, 0.35, (64, 64))
    brick = tones[course.astype(int) % 64, np.floor(along).astype(int) % 64]
    is_joint = (along % 1.0 < joint) | (y / height % 1.0 < joint * length / height)
    return np.where(is_joint, mortar, brick) * (1.0 + 0.15 * _grain(random, x.shape, 1.5))


def radiator(random: Random) -> FloatArray:
    """Draw rounded ribs with shadows between them."""
    y, x = _grid(random)
    pitch, depth = random.uniform(14.0, 60.0), random.uniform(0.3, 0.95)
    across = 2.0 * (x / pitch % 1.0) - 1.0
    rib = np.sqrt(np.clip(1.0 - across**2, 0.0, 1.0))
    side = random.uniform(-0.4, 0.4) * across
    top = random.uniform(0.0, 0.2) * y.max()
    return np.where(y < top, 0.5, 0.7 * (1.0 - depth + depth * rib) * (1.0 + side))


def bookshelf(random: Random) -> FloatArray:
    """Draw backs of books: some volumes of one series, with gaps."""
    y, x = _grid(random)
    is_series = random.random() < 0.5
    thick, light = random.uniform(12.0, 40.0), np.zeros(x.shape[1])
    edge, back = 0.0, random.uniform(0.2, 0.8)
    while edge < len(light):
        width = thick * (1.0 if is_series else random.uniform(0.6, 1.5))
        light[int(edge) : int(edge + width)] = back if is_series else random.uniform(0.05, 0.9)
        edge += width
        light[int(edge) : int(edge + 0.12 * thick) + 1] = random.uniform(0.01, 0.06)
        edge += 0.12 * thick
    label = (y % 90.0 < 14.0) & is_series
    return np.where(label, 0.9, light[None, :]) * (1.0 + 0.1 * _grain(random, x.shape, 2.0))


def piano(random: Random) -> FloatArray:
    """Draw white keys with thin gaps, and black ones in groups of two and three."""
    y, x = _grid(random)
    key = random.uniform(18.0, 60.0)
    place = x / key + random.uniform(0.0, 7.0)
    gap = np.abs(place % 1.0 - 0.5) > 0.5 - random.uniform(0.02, 0.05)
    near = np.round(place)
    is_black = np.isin(near.astype(int) % 7, (1, 2, 4, 5, 6)) & (np.abs(place - near) < 0.28)
    is_black &= y < random.uniform(0.4, 0.7) * y.max()
    return np.where(gap | is_black, 0.03, 0.85)


def corrugated(random: Random) -> FloatArray:
    """Draw a sheet lit from the side, seen in perspective or from the front."""
    y, x = _grid(random)
    if random.random() < 0.5:
        y, x = _in_perspective(y, x, random)
    phase = 2.0 * np.pi * x / random.uniform(12.0, 60.0)
    slope = np.cos(phase)
    lit = np.clip(random.uniform(0.2, 0.6) + random.uniform(0.2, 0.5) * slope, 0.0, None)
    return lit * (1.0 + 0.1 * _grain(random, x.shape, 3.0))


def railing(random: Random) -> FloatArray:
    """Draw thin bars before a bright sky, or bright ones before a dark wood."""
    _, x = _grid(random)
    pitch, bar = random.uniform(10.0, 50.0), random.uniform(0.1, 0.6)
    sky = np.clip(0.6 + 0.15 * _grain(random, x.shape, 25.0), 0.05, None)
    is_bar = (x / pitch + random.uniform()) % 1.0 < bar
    dark, bright = random.uniform(0.02, 0.1), random.uniform(0.5, 0.9)
    if random.random() < 0.5:
        return np.where(is_bar, dark, sky)
    return np.where(is_bar, bright, np.clip(0.25 * sky, 0.0, None))


def black_blinds(random: Random) -> FloatArray:
    """Draw upright lamellas of one light with black gaps."""
    _, x = _grid(random)
    lit = (x / random.uniform(12.0, 60.0)) % 1.0 < random.uniform(0.3, 0.8)
    return 0.8 * lit.astype(np.float64)


KINDS: tuple[Kind, ...] = (
    brick_wall, negatives.fence, negatives.keyboard, negatives.blinds, negatives.moire, radiator,
    bookshelf, piano, corrugated, negatives.stairs, railing, negatives.slats,
)  # fmt: skip


def verdict_on(seed: int, kinds: Sequence[Kind] = KINDS) -> tuple[str, str]:
    """Return what a picture shows, and the verdict on it as on a lamp of a known frequency."""
    random = np.random.default_rng([6733, seed])
    kind = kinds[seed % len(kinds)]
    image = negatives.photographed(kind(random), random)
    scene = occ.load_preset("phone-136us").replace(light="lamp", lamp_frequency=1000.0)
    try:
        return kind.__name__, occ.match_photo(photo_of(image), scene).verdict
    except occ.MatchError:
        return kind.__name__, "refused"


def verdict_on_black_blinds(seed: int) -> tuple[str, str]:
    return verdict_on(seed, (black_blinds,))
