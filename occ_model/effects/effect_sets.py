"""The sets of effects that a scene can be simulated with, with their times and errors.

Times are as measured: the shortest of some pictures of the presets on one computer. A plan compares
times, and must be the same on every computer. Where pixels are simulated at all, exposing and
storing them takes the same time for any effects; noise from a stored plane is scaled once for all
noise.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Self

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.effects.effect import Effect, FileEffect, NoiseEffect
from occ_model.effects.estimates import Estimates
from occ_model.effects.paper_view import PaperView
from occ_model.effects.registry import EFFECTS
from occ_model.results.plan import Way
from occ_model.scene.simulation_settings import NoiseSource, SimulationSettings

_SUM_RATIO = 1.15
"""Largest ratio of the sum of changes to the tolerance at which the changes are tried together."""


@dataclass(frozen=True, eq=False, slots=True)
class EffectSets:
    """The sets of effects that no other is both faster and more exact than, the fastest first."""

    estimates: Estimates
    names: frozenset[str]  # The effects that may be left out
    everything: float  # Seconds with all of them
    ways: tuple[Way, ...]  # The sets, with their errors as if changes added

    @classmethod
    def of(cls, estimates: Estimates, view: PaperView, settings: SimulationSettings) -> Self:
        """Compare all sets of a scene's effects that are not switched by hand."""
        force = settings.force
        free = tuple(e for e in EFFECTS if e.name in estimates.sizes and e.name not in force)
        forced_in = tuple(e for e in EFFECTS if force.get(e.name))
        pixels = view.scene.camera.rows * view.scene.camera.columns
        subsets = _subsets(free, forced_in, pixels, settings.noise)
        errors = _errors_of(estimates, free, subsets.left_out)
        ordered = errors[subsets.order]
        is_closer = ordered[1:] < np.minimum.accumulate(ordered)[:-1]
        front = subsets.order[np.append(True, is_closer)]
        ways = tuple(
            Way(subsets.effects[at], seconds, error)
            for at, seconds, error in zip(
                front.tolist(), subsets.seconds[front].tolist(), errors[front].tolist(), strict=True
            )
        )
        return cls(estimates, subsets.effects[0], float(subsets.seconds[0]), ways)

    def errors_of(self, ways: Sequence[Way]) -> list[float]:
        """Return each set's least tolerance, for its effects together: changes need not add."""
        found = self.estimates.errors_of([self.names - way.effects for way in ways])
        return [max(own, way.error / _SUM_RATIO) for own, way in zip(found, ways, strict=True)]

    def chosen(self, tolerance: float) -> tuple[Way, float]:
        """Return the fastest set within a tolerance, and its error."""
        if tolerance == math.inf:
            return Way(frozenset(), self.ways[0].seconds, math.inf), math.inf
        near = (
            [way for way in self.ways if way.error <= tolerance * _SUM_RATIO] if tolerance else []
        )
        for some in (near[:1], near[1:5], near[5:]):  # mostly the first one is within it
            for way, error in zip(some, self.errors_of(some) if some else (), strict=True):
                if error <= tolerance:
                    return way, error
        return Way(self.names, self.everything, 0.0), 0.0


@dataclass(frozen=True, eq=False, slots=True)
class _Subsets:
    effects: tuple[frozenset[str], ...]
    left_out: FloatArray  # 1 where a subset does not have an effect: (subsets, effects)

    seconds: FloatArray
    order: IndexArray  # The fastest first


@lru_cache(maxsize=8)
def _subsets(
    free: tuple[Effect, ...], forced_in: tuple[Effect, ...], pixels: int, noise: NoiseSource
) -> _Subsets:
    number = np.arange(2 ** len(free))[:, None]
    left_out = ((number >> np.arange(len(free))) & 1).astype(np.float64)
    inside = np.hstack([1.0 - left_out, np.ones((len(left_out), len(forced_in)))])
    seconds = seconds_of([*free, *forced_in], inside, pixels, noise)
    names = [
        frozenset(e.name for e, out in zip(free, row, strict=True) if not out)
        for row in left_out.tolist()
    ]
    return _Subsets(tuple(names), left_out, seconds, np.argsort(seconds, kind="stable"))


def _errors_of(estimates: Estimates, free: tuple[Effect, ...], left_out: FloatArray) -> FloatArray:
    """Return the changes by leaving out sets of effects, in levels, as if changes added."""
    if estimates.seen is None:
        return np.where(left_out.any(axis=1), math.inf, 0.0)
    if not free:
        return np.zeros(1)
    names = [effect.name for effect in free]
    factors = np.array([estimates.factors[name] for name in names])
    squares = estimates.seen.of_subsets(names, left_out)
    factor = np.maximum((left_out * factors).max(axis=1), 1.0)
    errors = np.sqrt(squares) * estimates.stretch * factor
    errors[0] = 0.0
    return np.asarray(errors)


_PIXEL_SECONDS = 1.1e-3  # seconds for a million pixels whose rows differ

_NOISE_SECONDS: dict[NoiseSource, float] = {"exact": 10e-3, "reused": 0.9e-3}
"""Seconds to draw a million random numbers, or to fetch them."""

_NOISY_FILE_SECONDS = 6e-3  # seconds by which a million noisy pixels take longer in a file


def seconds_of(
    effects: Sequence[Effect], sets: FloatArray, pixels: int, noise: NoiseSource
) -> FloatArray:
    """Return the times of sets of effects, given as (sets, effects): 1 where simulated."""
    millions = pixels * 1e-6
    each = np.array([effect.cost.picture + effect.cost.pixels * millions for effect in effects])
    by_pixel = np.array([effect.kind != "column" for effect in effects], dtype=bool)
    noises = np.array([isinstance(effect, NoiseEffect) for effect in effects], dtype=bool)
    files = np.array([isinstance(effect, FileEffect) for effect in effects], dtype=bool)
    drawn = sets[:, noises].sum(axis=1)
    if noise == "reused":
        drawn = np.minimum(drawn, 1.0)
    shared = _PIXEL_SECONDS * (sets[:, by_pixel] > 0.0).any(axis=1) + _NOISE_SECONDS[noise] * drawn
    shared = shared + _NOISY_FILE_SECONDS * ((drawn > 0.0) & (sets[:, files] > 0.0).any(axis=1))
    return np.asarray(sets @ each + shared * millions)
