"""The receiver's enhancement averaged over a pixel's noise, which smooths its curve.

Also changes that a sample may miss: in few columns, and at the panel's rims.
"""

import math
from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import LevelSteps
from occ_model.camera.photometry import WHITE
from occ_model.camera.pixel_noise import GREY_LEVELS
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
        unsampled += float(pixels.file.growth_at_rims(blocks, unsampled))
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
    added = float(file.growth_at_rims(upright, upright * pixels.table.contrast**2 / 8.0))
    equal_fraction = file.undithered_fraction
    return added * (equal_fraction + (1.0 - equal_fraction) / file.block_rows)


LEAST_SMOOTHING_NOISE = 0.5
"""Noise in grey levels below which single steps of the enhancement remain visible in its mean."""


class SmoothedCurves:
    """Means over the pixels' noise of what the enhancement makes of them."""

    def __init__(self, pixels: SampledPixels) -> None:
        self._pixels = pixels
        self._levels = np.clip(pixels.table.levels, 0.0, WHITE)
        self.files = frozenset(effect.name for effect in pixels.files)
        self._spreads: dict[Names, FloatArray] = {}
        self._tables: dict[tuple[Names, bytes], FloatArray] = {}

    def spread(self, included: Names) -> FloatArray:
        """Return the deviation at each level of pixels that are not drawn, after the file."""
        key = included - frozenset(self._pixels.moving)
        if key not in self._spreads:
            spread, file = self._pixels.spread(included), self._pixels.file
            has_file = file is not None and self.files & included
            self._spreads[key] = file.spread_read_back(spread) if file and has_file else spread
        return self._spreads[key]

    def tabulate(self, included: Names, of_greys: FloatArray) -> FloatArray:
        """Return the mean at each level of a quantity given for each of 256 grey levels."""
        if self._pixels.noisy.is_drawn(included):
            return self._mean_of_drawn(included, self._levels, of_greys)
        return LevelSteps.of(self._levels, self.spread(included)).mean_of(of_greys)

    def _mean_of_drawn(
        self, included: Names, values: FloatArray, of_greys: FloatArray
    ) -> FloatArray:
        """Return the mean over drawn pixels of some means, which the file changes further."""
        law = self._pixels.noisy.law(included)
        if law is None:
            return values
        key = included.difference(self._pixels.sample.outline, self._pixels.light.dimming)
        if (key, of_greys.tobytes()) not in self._tables:
            after_file = self._blur_by_file(included, of_greys)
            self._tables[key, of_greys.tobytes()] = law.mean_of(after_file)
        return law.at_means(self._tables[key, of_greys.tobytes()], values)

    def _blur_by_file(self, included: Names, of_greys: FloatArray) -> FloatArray:
        file = self._pixels.file
        if file is None or not self.files & included:
            return of_greys
        before = self._pixels.noise_rms(included)
        after = float(file.spread_read_back(np.array([before]))[0])
        error = np.full(256, math.sqrt(max(after**2 - before**2, 0.0)))
        return LevelSteps.of(GREY_LEVELS, error).mean_of(of_greys)

    def enhance(self, sets: Sequence[Names], values: FloatArray) -> FloatArray:
        """Return the mean of the enhanced pixels for each mean value, shape as ``values``."""
        means = np.empty(values.shape)
        for included, own, mean in zip(sets, values, means, strict=True):
            curve = self._pixels.columns.enhancement(included).curve.astype(np.float64)
            if self._pixels.noisy.is_drawn(included):
                mean[:] = self._mean_of_drawn(included, own, curve)
            else:
                mean[:] = self.smooth(included, own, curve)
        return means

    def smooth(self, included: Names, values: FloatArray, curve: FloatArray) -> FloatArray:
        """Return the mean of a curve over pixels of some means that are not drawn."""
        flat = np.clip(values, 0.0, WHITE).ravel()
        noise = self._pixels.table.interpolate(self.spread(included), flat)
        return LevelSteps.of(flat, noise).mean_of(curve).reshape(values.shape)


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
    complete = pixels.profile(pixels.names)
    if name not in pixels.light.dimming:
        is_rim = name in pixels.sample.outline
        return None if is_rim else np.stack([complete, pixels.profile(pixels.names - {name})])
    dimming = pixels.interpolate_columns(pixels.mean_of_rows(pixels.light.dimming[name]))
    return np.stack([pixels.profile(pixels.names, dimming), complete])
