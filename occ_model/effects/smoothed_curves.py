"""The receiver's enhancement as a noisy pixel passes it in the mean: a curve that noise smooths.

Also what light changes in few columns, of which a sample may have none or too many.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import PassedSteps
from occ_model.camera.photometry import WHITE
from occ_model.effects.observed import Observed
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.simulated_columns import Names

LEAST_SMOOTHING_NOISE = 0.5
"""Noise in grey levels below which the enhancement's steps show between the levels."""

_LEAST_TABULATED_NOISE = 1.5
"""Noise in steps of the table from which a curve that it smooths is interpolated closely."""


class _Noise(NamedTuple):
    """The deviation at each level, as a file has it, its least, and the steps that pixels pass."""

    spread: FloatArray
    least: float
    passed: PassedSteps


class SmoothedCurves:
    """The enhancement's curves, smoothed by the noise that some effects leave, over the levels."""

    def __init__(self, pixels: SampledPixels) -> None:
        self._pixels = pixels
        self._levels = np.clip(pixels.levels, 0.0, WHITE)
        self._moving = frozenset(pixels.moving)
        self._lenses = frozenset(effect.name for effect in pixels.lenses)
        self.files = frozenset(effect.name for effect in pixels.files)
        self._noises: dict[Names, _Noise] = {}
        self._curves: dict[Names, FloatArray] = {}

    def noise(self, included: Names) -> _Noise:
        key = included - self._moving
        if key not in self._noises:
            spread, file = self._pixels.spread(included), self._pixels.file
            if file is not None and self.files & included:
                spread = file.spread(spread)
            passed = PassedSteps.of(self._levels, spread)
            self._noises[key] = _Noise(spread, float(spread.min()), passed)
        return self._noises[key]

    def curve(self, included: Names) -> FloatArray:
        """Return the mean of enhanced pixels at each level."""
        key = included - self._lenses
        if key not in self._curves:
            enhancement = self._pixels.columns.enhancement(included)
            self._curves[key] = enhancement.mean(self.noise(included).passed)
        return self._curves[key]

    def enhanced(self, sets: Sequence[Names], values: FloatArray) -> FloatArray:
        """Return the means of enhanced pixels of some mean values, shape as ``values``."""
        pixels = self._pixels
        found = pixels.table.look_each(np.stack([self.curve(one) for one in sets]), values)
        tabulated = max(LEAST_SMOOTHING_NOISE, _LEAST_TABULATED_NOISE * pixels.table.step)
        for included, own, of_own in zip(sets, values, found, strict=True):
            noise = self.noise(included)
            if noise.least < tabulated:
                flat = np.clip(own, 0.0, WHITE)
                filed = self.files & included
                own_noise = (
                    pixels.table.look(noise.spread, flat)
                    if filed
                    else pixels.noise_at(included, flat)
                )
                sharp = own_noise < tabulated
                if sharp.any():
                    steps = PassedSteps.of(flat[sharp], own_noise[sharp])
                    of_own[sharp] = pixels.columns.enhancement(included).mean(steps)
        return found


_MISSED_FRACTION = 0.1  # part of a change that a sample must miss for its columns to be too few


def add_unsampled(
    pixels: SampledPixels, found: Observed, curves: SmoothedCurves | None = None
) -> None:
    """Add to the mean square of each change what columns beside the sample add to it.

    Where most columns are white or black, or an enhancement makes them so, a change of the light
    shows in the few that are not, and where little noise spreads the rounding, so does noise. All
    columns of a profile cost microseconds, without the enhancement's curves.
    """
    lacking = pixels.unsampled
    if lacking is None:
        return

    def add(name: str, seen: FloatArray) -> None:
        missed = float((seen[1] - seen[0]) ** 2 @ lacking)
        found.alone[name] = found.alone.get(name, 0.0) + max(missed, 0.0)

    for effect in (*pixels.lights, *pixels.limits, *pixels.lenses):
        profiles = _profiles(pixels, effect.name)
        if profiles is None:
            continue
        sets = [pixels.names, pixels.names - {effect.name}]
        changed = profiles
        if curves is not None:  # as if there were no noise
            pairs = zip(sets, profiles, strict=True)
            levels = [pixels.columns.enhancement(one)(own) for one, own in pairs]
            changed = np.array(levels, dtype=np.float64)
        squares = (changed[1] - changed[0]) ** 2
        if squares @ lacking <= _MISSED_FRACTION * squares.mean():
            continue
        if curves is not None:
            changed = curves.enhanced(sets, profiles)
        add(effect.name, changed)
    if curves is not None and pixels.least_noise(pixels.names) < LEAST_SMOOTHING_NOISE:
        profiles = np.stack([pixels.profile(pixels.names)] * 2)
        for noise in pixels.noises:
            sets = [pixels.names, pixels.names - {noise.name}]
            add(noise.name, curves.enhanced(sets, profiles))


def _profiles(pixels: SampledPixels, name: str) -> FloatArray | None:
    """Return the profile with an effect and without it, None where it moves rims alone.

    What dims each pixel otherwise is taken for its mean over the rows.
    """
    whole, dimming = pixels.profile(pixels.names), pixels.dimming(name)
    if dimming is None:
        is_rim = name in pixels.sample.outline
        return None if is_rim else np.stack([whole, pixels.profile(pixels.names - {name})])
    return np.stack([pixels.profile(pixels.names, pixels.over_columns(dimming)), whole])
