"""The receiver's enhancement averaged over a pixel's noise, which smooths its curve.

Also changes that a sample may miss: in few columns, and at the panel's rims.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import LevelSteps
from occ_model.camera.photometry import WHITE
from occ_model.effects.observed import SampledObservable
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.simulated_columns import Names

_UNSAMPLED_PIXELS = 1.0  # pixels of a rim that may change without being sampled


def unsampled_rim_square(pixels: SampledPixels, square: float) -> float:
    """Return the mean square change of a few pixels of a rim, none of which may be sampled.

    A file spreads it over their block.
    """
    if pixels.sample.is_covered:
        return 0.0
    unsampled = _UNSAMPLED_PIXELS * square
    if pixels.file is not None:
        region = pixels.view.region
        blocks = min(64.0 / (region.rows * region.columns), pixels.rims.fraction)
        unsampled += pixels.file.growth_at_rim(blocks, unsampled)
    return unsampled


def cut_block_square(pixels: SampledPixels) -> float:
    """Return the mean square change by a file of the means of columns beside an upright rim.

    If the rim moves outwards, only a part of its blocks is observed. Where noise spreads the change
    over the file's steps, it differs from block to block.
    """
    file = pixels.file
    if file is None:
        return 0.0
    upright = pixels.rims.fractions[1]
    added = file.growth_at_rim(upright, upright * pixels.contrast**2 / 8.0)
    equal_fraction = file.undithered_fraction
    return added * (equal_fraction + (1.0 - equal_fraction) / file.block_rows)


LEAST_SMOOTHING_NOISE = 0.5
"""Noise in grey levels below which single steps of the enhancement remain visible in its mean."""

_LEAST_TABULATED_NOISE = 1.5
"""Noise, in steps of the table, above which interpolating a smoothed curve is accurate."""


class _CurveNoise(NamedTuple):
    """The noise at each level after the file, its smallest value, and the steps it crosses."""

    spread: FloatArray
    least: float
    steps: LevelSteps


class SmoothedCurves:
    """The enhancement's curves over the levels, smoothed by the noise of some effects."""

    def __init__(self, pixels: SampledPixels) -> None:
        self._pixels = pixels
        self._levels = np.clip(pixels.levels, 0.0, WHITE)
        self._moving = frozenset(pixels.moving)
        self._lenses = frozenset(effect.name for effect in pixels.lenses)
        self.files = frozenset(effect.name for effect in pixels.files)
        self._noises: dict[Names, _CurveNoise] = {}
        self._curves: dict[Names, FloatArray] = {}

    def noise(self, included: Names) -> _CurveNoise:
        key = included - self._moving
        if key not in self._noises:
            spread, file = self._pixels.spread(included), self._pixels.file
            if file is not None and self.files & included:
                spread = file.spread(spread)
            steps = LevelSteps.of(self._levels, spread)
            self._noises[key] = _CurveNoise(spread, float(spread.min()), steps)
        return self._noises[key]

    def curve(self, included: Names) -> FloatArray:
        """Return the mean of the enhanced pixels at each level."""
        key = included - self._lenses
        if key not in self._curves:
            enhancement = self._pixels.columns.enhancement(included)
            self._curves[key] = enhancement.mean(self.noise(included).steps)
        return self._curves[key]

    def enhance(self, sets: Sequence[Names], values: FloatArray) -> FloatArray:
        """Return the mean of the enhanced pixels for each mean value, shape as ``values``."""
        pixels = self._pixels
        means = pixels.table.interpolate_each(
            np.stack([self.curve(included) for included in sets]), values
        )
        tabulated = max(LEAST_SMOOTHING_NOISE, _LEAST_TABULATED_NOISE * pixels.table.step)
        for included, set_values, mean in zip(sets, values, means, strict=True):
            noise = self.noise(included)
            if noise.least < tabulated:
                flat = np.clip(set_values, 0.0, WHITE)
                with_file = self.files & included
                own_noise = (
                    pixels.table.interpolate(noise.spread, flat)
                    if with_file
                    else pixels.noise_at(included, flat)
                )
                sharp = own_noise < tabulated
                if sharp.any():
                    steps = LevelSteps.of(flat[sharp], own_noise[sharp])
                    mean[sharp] = pixels.columns.enhancement(included).mean(steps)
        return means


_MISSED_FRACTION = 0.1  # fraction of a change above which the sample counts as missing it


def add_unsampled(
    pixels: SampledPixels, observed: SampledObservable, curves: SmoothedCurves | None = None
) -> None:
    """Add to the mean square of each change the contribution of columns outside the sample.

    If most columns are white or black, or become so by the enhancement, a change of the light
    appears only in the few others; so does a change of the noise if there is too little to spread
    the rounding. Computing all columns takes microseconds, apart from the enhancement's curves.
    """
    weights = pixels.unsampled
    if weights is None:
        return

    def add(name: str, values: FloatArray) -> None:
        square = float((values[1] - values[0]) ** 2 @ weights)
        observed.independent[name] = observed.independent.get(name, 0.0) + max(square, 0.0)

    for effect in (*pixels.lights, *pixels.limits, *pixels.lenses):
        profiles = _profiles(pixels, effect.name)
        if profiles is None:
            continue
        sets = [pixels.names, pixels.names - {effect.name}]
        changed = profiles
        if curves is not None:  # first as if there were no noise
            pairs = zip(sets, profiles, strict=True)
            levels = [pixels.columns.enhancement(included)(profile) for included, profile in pairs]
            changed = np.array(levels, dtype=np.float64)
        squares = (changed[1] - changed[0]) ** 2
        if squares @ weights <= _MISSED_FRACTION * squares.mean():
            continue
        if curves is not None:
            changed = curves.enhance(sets, profiles)
        add(effect.name, changed)
    if curves is not None and pixels.least_noise(pixels.names) < LEAST_SMOOTHING_NOISE:
        profiles = np.stack([pixels.profile(pixels.names)] * 2)
        for noise in pixels.noises:
            sets = [pixels.names, pixels.names - {noise.name}]
            add(noise.name, curves.enhance(sets, profiles))


def _profiles(pixels: SampledPixels, name: str) -> FloatArray | None:
    """Return the profile with and without an effect, None if the effect only moves rims.

    Dimming is averaged over the rows.
    """
    complete, dimming = pixels.profile(pixels.names), pixels.dimming(name)
    if dimming is None:
        is_rim = name in pixels.sample.outline
        return None if is_rim else np.stack([complete, pixels.profile(pixels.names - {name})])
    return np.stack([pixels.profile(pixels.names, pixels.interpolate_columns(dimming)), complete])
