"""Noise: random numbers drawn for each pixel or reused from one plane, and their deviation."""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Protocol, TypeAlias
from zlib import crc32

import numpy as np

from occ_model.arrays import FloatArray, Pixels
from occ_model.camera.photometry import saturation_value
from occ_model.camera.picture_rows import Rows
from occ_model.camera.row_interpolation import find_smooth_columns
from occ_model.effects.effect import NoiseEffect
from occ_model.scene.scene import NoiseSource, Scene

Drawn: TypeAlias = Callable[[], Sequence[tuple[Sequence[NoiseEffect], Pixels]]]
"""Returns numbers of the standard normal distribution, shape (rows, columns), which the caller may
change, with the effects whose noise they are together."""

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

    Much faster than drawing. All effects use the same numbers, scaled to their total deviation. The
    pieces overlap at random, which shows neither in rows nor in columns' means.
    """

    def __init__(self, effects: Sequence[NoiseEffect], scene: Scene, seed: int) -> None:
        self._effects = effects
        self._random = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,)))
        self.places = _plane(scene.camera.columns)

    def draw(self, rows: int) -> Drawn:
        chosen = self._random.integers(0, len(self.places), rows)
        return lambda: [(self._effects, self.places[chosen])]


@lru_cache(maxsize=2)
def _plane(columns: int) -> Pixels:
    """Return all pieces of the plane of a row's length, shape (pieces, columns)."""
    length = max(_PLANE_SIZE, 8 * columns)
    numbers = np.random.default_rng(0).standard_normal(length, dtype=np.float32)
    numbers -= numbers.mean(dtype=np.float64)
    numbers /= numbers.std(dtype=np.float64)
    return np.lib.stride_tricks.sliding_window_view(numbers, columns)


NoiseMaker: TypeAlias = Callable[[Sequence[NoiseEffect], Scene, int], Noise]

NOISE_MAKERS: dict[NoiseSource, NoiseMaker] = {"exact": ExactNoise, "reused": ReusedNoise}


_PER_LEVEL = 4  # entries of the table to a grey level

_TABULATED: FloatArray = np.arange(256 * _PER_LEVEL + 1) / _PER_LEVEL

_TOLERANCE = 0.01  # largest error of an interpolated deviation, in grey levels


class NoiseSpread:
    """The standard deviation of all noise of some effects together, in grey levels."""

    def __init__(self, effects: Sequence[NoiseEffect], scene: Scene) -> None:
        self._effects = effects
        self._scene = scene
        self._table = self._exact(_TABULATED).astype(np.float32)
        self._steps = np.append(np.diff(self._table), np.float32(0.0))
        self._full = np.float32(saturation_value(scene))
        self._known: tuple[Pixels | None, Pixels] = (None, self._table)

    def __call__(self, values: Pixels) -> Pixels:
        """Return the deviations of pixels with some mean values before saturation, same shape.

        Those of more than one row are read from a table, in quarters of a grey level. A full pixel,
        whose value need not be one of them, has none.
        """
        if len(values) == 1:
            return self._exact(values.astype(np.float64)).astype(np.float32)
        place = np.minimum(values, np.float32(_TABULATED[-1]))
        np.maximum(place, np.float32(0.0), out=place)
        place *= np.float32(_PER_LEVEL)
        entry = place.astype(np.int32)
        place -= entry
        place *= self._steps[entry]
        place += self._table[entry]
        place[values >= self._full] = 0.0
        return place

    def scale(self, normal: Pixels, rows: Rows, each_row: Rows) -> None:
        """Multiply numbers by the deviations of rows, given with weights and as ``each_row``."""
        known, spread = self._known
        if rows.nodes is not known:  # most rows are like the previous rows
            spread = self(rows.nodes)
            self._known = (rows.nodes, spread)
        rims = [self(rim.values) for rim in rows.rims]
        if rows.weights is None or find_smooth_columns(spread, _TOLERANCE).all():
            rows.combine(np.multiply, normal, spread, rims)
        else:
            each_row.combine(np.multiply, normal, self(each_row.nodes), rims)

    def _exact(self, values: FloatArray) -> FloatArray:
        squares = sum(effect.spread(self._scene, values) ** 2 for effect in self._effects)
        return np.asarray(np.sqrt(squares))
