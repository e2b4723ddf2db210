"""What effects take, as measured: the shortest of some pictures of the presets on one computer.

A plan compares times, and must be the same on every computer. Where pixels are simulated at all,
for whatever effect, exposing and keeping them takes what it takes; noise from a stored plane is
scaled once for all noise.
"""

from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.effects.effect import Effect, FileEffect, NoiseEffect
from occ_model.scene.simulation_settings import NoiseSource

_PIXELS = 1.1e-3
"""Seconds for a million pixels whose rows differ."""

_NOISE: dict[NoiseSource, float] = {"exact": 10e-3, "reused": 0.9e-3}
"""Seconds to draw a million numbers, or to fetch them."""

_NOISY_FILE = 6e-3
"""Seconds by which a million noisy pixels take longer in a file."""


def seconds_of(
    effects: Sequence[Effect], sets: FloatArray, pixels: int, noise: NoiseSource
) -> FloatArray:
    """Return what sets of effects take, (sets, effects), 1 where a set simulates an effect."""
    millions = pixels * 1e-6
    each = np.array([effect.cost.picture + effect.cost.pixels * millions for effect in effects])
    by_pixel = np.array([effect.kind != "column" for effect in effects], dtype=bool)
    noises = np.array([isinstance(effect, NoiseEffect) for effect in effects], dtype=bool)
    files = np.array([isinstance(effect, FileEffect) for effect in effects], dtype=bool)
    drawn = sets[:, noises].sum(axis=1)
    if noise == "reused":
        drawn = np.minimum(drawn, 1.0)
    shared = _PIXELS * (sets[:, by_pixel] > 0.0).any(axis=1) + _NOISE[noise] * drawn
    shared = shared + _NOISY_FILE * ((drawn > 0.0) & (sets[:, files] > 0.0).any(axis=1))
    return np.asarray(sets @ each + shared * millions)
