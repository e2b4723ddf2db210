"""Sources of noise: random numbers drawn for each pixel, or taken again from one plane."""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Protocol, TypeAlias
from zlib import crc32

import numpy as np

from occ_model.arrays import Pixels
from occ_model.effects.effect import NoiseEffect
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import NoiseSource

Drawn: TypeAlias = Callable[[], Sequence[tuple[Sequence[NoiseEffect], Pixels]]]
"""Return numbers of the standard normal distribution, shape (rows, columns), which are the caller's
own, and the effects whose noise they are together."""

_PLANE_SIZE = 2**21  # numbers in the plane: eight megabytes, which fit the processor's cache


class Noise(Protocol):
    """A source of the deviation of every pixel from its mean."""

    def draw(self, rows: int) -> Drawn:
        """Draw the numbers of the next rows, in order; any thread may use them at any time."""


def stream(effect: NoiseEffect, seed: int) -> np.random.Generator:
    """Return an effect's own stream of random numbers: switching others on does not change it.

    That of an effect of the camera itself does not depend on the seed either.
    """
    entropy = 0 if effect.of_the_camera else seed
    own = np.random.SeedSequence(entropy, spawn_key=(crc32(effect.name.encode()),))
    return np.random.default_rng(own)


class ExactNoise:
    """Noise drawn for every pixel, for each effect from its own stream."""

    def __init__(self, effects: Sequence[NoiseEffect], scene: Scene, seed: int) -> None:
        self._columns = scene.camera.columns
        self._streams = [(effect, stream(effect, seed)) for effect in effects]

    def draw(self, rows: int) -> Drawn:
        shape = rows, self._columns
        drawn = [
            ((effect,), random.standard_normal(shape, dtype=np.float32))
            for effect, random in self._streams
        ]
        return lambda: drawn


class ReusedNoise:
    """Noise reused: each row is a piece of one long row of numbers, from a random place.

    Much faster than drawing. All effects share the numbers, scaled to their total deviation. The
    pieces overlap at random, which shows neither in rows nor in columns' means.
    """

    def __init__(self, effects: Sequence[NoiseEffect], scene: Scene, seed: int) -> None:
        self._effects = effects
        self._random = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,)))
        self._places = _plane(scene.camera.columns)

    def draw(self, rows: int) -> Drawn:
        chosen = self._random.integers(0, len(self._places), rows)
        return lambda: [(self._effects, self._places[chosen])]


@lru_cache(maxsize=2)
def _plane(columns: int) -> Pixels:
    """Return all pieces of the plane of a row's length, shape (pieces, columns)."""
    length = max(_PLANE_SIZE, 8 * columns)
    numbers = np.random.default_rng(0).standard_normal(length, dtype=np.float32)
    numbers -= numbers.mean(dtype=np.float64)
    numbers /= numbers.std(dtype=np.float64)
    return np.lib.stride_tricks.sliding_window_view(numbers, columns)


class NoiseMaker(Protocol):
    def __call__(self, effects: Sequence[NoiseEffect], scene: Scene, seed: int, /) -> Noise:
        """Return a source of these effects' noise together."""


NOISE_MAKERS: dict[NoiseSource, NoiseMaker] = {"exact": ExactNoise, "reused": ReusedNoise}
