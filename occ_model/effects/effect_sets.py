"""The sets of effects with which a scene can be simulated, with their times and errors.

The times were measured once on one computer, as the shortest of several pictures of the presets, so
that a plan is the same on every computer. If any effect needs single pixels, exposing and storing
them takes the same time for all effects.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Self

import numpy as np

from occ_model.arrays import FloatArray, IndexArray
from occ_model.effects.effect import Effect, NoiseEffect, PaperView
from occ_model.effects.estimates import Estimates
from occ_model.effects.registry import EFFECTS
from occ_model.effects.sensor_effects import Jpeg
from occ_model.results.frame import EffectSet
from occ_model.scene.scene import SimulationSettings

_SUM_RATIO = 1.15
"""Largest ratio of the sum of changes to the tolerance at which the effects are tried together, as
changes may partly cancel."""


@dataclass(frozen=True, eq=False, slots=True)
class EffectSets:
    """The Pareto front of sets of effects, fastest first: each slower set has a smaller error."""

    estimates: Estimates
    names: frozenset[str]  # All effects of the scene that are not switched off
    complete_seconds: float  # Seconds for a picture with all of them
    effect_sets: tuple[EffectSet, ...]  # Their errors assume that changes add

    @classmethod
    def of(cls, estimates: Estimates, view: PaperView, settings: SimulationSettings) -> Self:
        """Compare all subsets of the effects that the user has not switched on or off."""
        force = settings.force
        free = tuple(e for e in EFFECTS if e.name in estimates.sizes and e.name not in force)
        forced_in = tuple(e for e in EFFECTS if force.get(e.name))
        pixels = view.scene.camera.rows * view.scene.camera.columns
        subsets = _list_subsets(free, forced_in, pixels)
        errors = _errors_if_added(estimates, free, subsets.left_out)
        ordered = errors[subsets.order]
        is_closer = ordered[1:] < np.minimum.accumulate(ordered)[:-1]
        front = subsets.order[np.append(True, is_closer)]
        effect_sets = tuple(
            EffectSet(subsets.effects[at], seconds, error)
            for at, seconds, error in zip(
                front.tolist(), subsets.seconds[front].tolist(), errors[front].tolist(), strict=True
            )
        )
        return cls(estimates, subsets.effects[0], float(subsets.seconds[0]), effect_sets)

    def errors_of(self, effect_sets: Sequence[EffectSet]) -> list[float]:
        """Return the smallest tolerance for each set, leaving out all that it omits together."""
        errors = self.estimates.errors_of(
            [self.names - effect_set.effects for effect_set in effect_sets]
        )
        return [
            max(error, effect_set.error / _SUM_RATIO)
            for error, effect_set in zip(errors, effect_sets, strict=True)
        ]

    def choose(self, tolerance: float) -> tuple[EffectSet, float]:
        """Choose the fastest set within a tolerance; return it and its error."""
        if tolerance == math.inf:
            return EffectSet(frozenset(), self.effect_sets[0].seconds, math.inf), math.inf
        near = [each for each in self.effect_sets if each.error <= tolerance * _SUM_RATIO]
        for batch in (near[:1], near[1:5], near[5:]) if tolerance else ():  # usually the first
            errors = self.errors_of(batch) if batch else ()
            for effect_set, error in zip(batch, errors, strict=True):
                if error <= tolerance:
                    return effect_set, error
        return EffectSet(self.names, self.complete_seconds, 0.0), 0.0


@dataclass(frozen=True, eq=False, slots=True)
class _Subsets:
    effects: tuple[frozenset[str], ...]
    left_out: FloatArray  # 1 where a subset lacks an effect, shape (subsets, effects)

    seconds: FloatArray
    order: IndexArray  # Indices of the subsets, fastest first


@lru_cache(maxsize=8)
def _list_subsets(free: tuple[Effect, ...], forced_in: tuple[Effect, ...], pixels: int) -> _Subsets:
    number = np.arange(2 ** len(free))[:, None]
    left_out = ((number >> np.arange(len(free))) & 1).astype(np.float64)
    inside = np.hstack([1.0 - left_out, np.ones((len(left_out), len(forced_in)))])
    seconds = seconds_of([*free, *forced_in], inside, pixels)
    names = [
        frozenset(e.name for e, is_out in zip(free, row, strict=True) if not is_out)
        for row in left_out.tolist()
    ]
    return _Subsets(tuple(names), left_out, seconds, np.argsort(seconds, kind="stable"))


def _errors_if_added(
    estimates: Estimates, free: tuple[Effect, ...], left_out: FloatArray
) -> FloatArray:
    """Return the change without each set of effects, in levels, assuming that changes add."""
    if estimates.observed is None:
        return np.where(left_out.any(axis=1), math.inf, 0.0)
    if not free:
        return np.zeros(1)
    names = [effect.name for effect in free]
    factors = np.array([estimates.factors[name] for name in names])
    squares = estimates.observed.largest_squares_if_added(names, left_out)
    factor = np.maximum((left_out * factors).max(axis=1), 1.0)
    errors = np.sqrt(squares) * estimates.stretch * factor
    errors[0] = 0.0
    return np.asarray(errors)


_PIXEL_SECONDS = 1.1e-3  # seconds for a million pixels in rows that differ

_NOISY_FILE_SECONDS = 6e-3  # extra seconds to store a million pixels with noise in a file


def seconds_of(effects: Sequence[Effect], sets: FloatArray, pixels: int) -> FloatArray:
    """Return the time of each set, given by rows of ``sets``: 1 where an effect is simulated."""
    millions = pixels * 1e-6
    effect_seconds = np.array(
        [effect.cost.picture + effect.cost.pixels * millions for effect in effects]
    )
    by_pixel = np.array([effect.kind != "column" for effect in effects], dtype=bool)
    noises = np.array([isinstance(effect, NoiseEffect) for effect in effects], dtype=bool)
    files = np.array([isinstance(effect, Jpeg) for effect in effects], dtype=bool)
    noisy = (sets[:, noises] > 0.0).any(axis=1)
    shared = _PIXEL_SECONDS * (sets[:, by_pixel] > 0.0).any(axis=1)
    shared = shared + _NOISY_FILE_SECONDS * (noisy & (sets[:, files] > 0.0).any(axis=1))
    return np.asarray(sets @ effect_seconds + shared * millions)
