"""How much the enhanced signal changes without some effects, estimated from a sample."""

import math
from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import Enhancement, LevelSteps
from occ_model.camera.photometry import FLAT_SPAN, WHITE, saturate
from occ_model.effects.normal_noise import mean_after_clipping, unclipped_fraction
from occ_model.effects.observed import SampledObservable
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.signal_sampling import SURE_DEVIATIONS, SignalSampling
from occ_model.effects.simulated_columns import Names
from occ_model.effects.smoothed_curves import (
    LEAST_SMOOTHING_NOISE,
    SmoothedCurves,
    add_unsampled,
    cut_block_square,
    unsampled_rim_square,
)

_DOUBTED_RIM, _DOUBTED_RIM_OF_FEW = 0.5, 1.0
"""Fraction of a moving rim's pixels of which the sample cannot tell whether they are enhanced: in
many columns, and in few."""

_ROUNDING_MARGIN = 0.02
"""Distance from the middle between two grey levels within which rounding cannot be predicted."""

_LARGE_STEP = 32.0
"""Step of the enhancement, between neighbouring levels, above which a single column matters."""

_MOST_GAIN = 8.0  # largest gain of contrast by an enhancement that noise smooths

_LEVELS = np.arange(256.0)

_CLIPPED_NOISE = 8.0  # noise in grey levels above which clipping matters


def signal_swing(pixels: SampledPixels) -> float:
    """Return the largest minus the smallest value of the enhanced bare profile, at least 1."""
    seen = saturate(pixels.view.values)
    enhanced = Enhancement(seen, pixels.scene.model.enhancement)(seen)
    return max(float(enhanced.max()) - float(enhanced.min()), FLAT_SPAN)


def observe_signal(pixels: SampledPixels) -> SampledObservable:
    """Observe the means of the columns after the receiver's enhancement."""
    sample = pixels.sample
    weights = np.sqrt(sample.weights)
    curves = SmoothedCurves(pixels)

    def seen(sets: Sequence[Names]) -> FloatArray:
        values = pixels.values_read_back(sets)
        found, inside = curves.enhance(sets, values), pixels.panel_mask(sets)
        if inside is not None:  # pixels beside the panel are not enhanced
            for included, own, of_own, on in zip(sets, values, found, inside, strict=True):
                if not on.all():
                    of_own[~on] = _mean_rounded(pixels, included, own[~on])
        return pixels.mean_of_rows(found) * weights

    found = SampledObservable(pixels.names, seen, sorted(pixels.names))
    sampling = SignalSampling(pixels, curves)
    found.alone.update(sampling.effect_squares())
    add_unsampled(pixels, found, curves)
    fluctuations = sampling.fluctuations()
    found.doubt.update({effect.name: sampling.doubt_of_file for effect in pixels.files})
    region, contrast = pixels.view.region, float(np.ptp(found.complete / weights))
    jump = contrast if pixels.scene.model.enhancement == "none" else WHITE
    few = len(sample.columns) >= region.columns
    part = _DOUBTED_RIM_OF_FEW if few else _DOUBTED_RIM
    doubt = unsampled_rim_square(pixels, contrast**2 / (region.rows**2 * region.columns))
    gain = min(contrast / pixels.view.swing, _MOST_GAIN)
    doubt += cut_block_square(pixels) * gain**2
    for name in pixels.sample.outline:  # a pixel of a rim is either enhanced or not
        own = pixels.rims.count_moved_rims(name) * (part * jump / region.rows) ** 2
        found.doubt[name] = doubt + own + pixels.rims.upright_rim_error(name) * jump**2
    for name, square in fluctuations.items():
        found.add_doubt([name], square)
    _doubt_sharp_steps(pixels, found)
    _doubt_large_steps(pixels, found)
    _doubt_a_cut_file(pixels, found)
    return found


def _mean_rounded(pixels: SampledPixels, included: Names, values: FloatArray) -> FloatArray:
    """Return the mean of pixels that are rounded but not enhanced."""
    spread = pixels.spread(included)
    if float(spread.max()) < LEAST_SMOOTHING_NOISE:
        flat = np.clip(values, 0.0, WHITE)
        return LevelSteps.of(flat, pixels.noise_at(included, flat)).mean_of(_LEVELS)
    return pixels.table.interpolate(mean_after_clipping(pixels.levels, spread, WHITE), values)


def _doubt_sharp_steps(pixels: SampledPixels, found: SampledObservable) -> None:
    """Add doubt about rounding where no noise spreads the pixels over the enhancement's steps.

    A plateau of values midway between two levels may round to either one as a whole. In a file any
    value within its own error may, since that error is the same in all blocks of equal rows.
    """
    whole = np.clip(pixels.whole, 0.0, WHITE)
    sharp = pixels.table.interpolate(pixels.spread(pixels.names), whole) < LEAST_SMOOTHING_NOISE
    if not sharp.any():
        return
    enhancement = pixels.columns.enhancement(pixels.names)
    if pixels.file is None:
        curve = enhancement.curve.astype(np.float64)
        below = np.minimum(whole, WHITE - 1.0).astype(np.int64)
        near = np.abs(whole - below - 0.5) < _ROUNDING_MARGIN
        reached = np.where(near, curve[below + 1] - curve[below], 0.0) / 2.0
    else:
        error = np.full(whole.size, math.sqrt(pixels.file.own_change))
        reached = enhancement.moments(whole.ravel(), error)[1].reshape(whole.shape)
    square = pixels.mean_of_rows(np.where(sharp, reached, 0.0) ** 2)
    found.add_doubt(pixels.names, float((square * pixels.sample.weights).sum()))


def _doubt_large_steps(pixels: SampledPixels, found: SampledObservable) -> None:
    """Add doubt about columns beside the sample that are near a large step of the enhancement.

    An equalization makes a large step where many columns have the same value. The changes there are
    summed over all columns of the profile, less those for which the sample's columns stand.
    """
    missed, region = pixels.unsampled, pixels.view.region
    if missed is None:
        return
    enhancement = pixels.columns.enhancement(pixels.names)
    steps = np.diff(enhancement.curve.astype(np.float64))
    large = np.flatnonzero(steps > _LARGE_STEP)
    if not len(large):
        return
    profile = _seen_profile(pixels)
    middles = np.asarray(large + 0.5, dtype=np.float64)[:, None]
    noise = pixels.noise_at(pixels.names, profile)  # a saturated pixel has none
    squares = pixels.mean_of_rows((pixels.stack[1:] - pixels.whole) ** 2)
    moved = np.sqrt(squares.max(axis=1)).tolist()
    reach = max(2.0 * float(noise.max()), *moved, _ROUNDING_MARGIN)
    close = (np.abs(profile - middles) < reach).any(axis=0)
    profile, missed, noise = profile[close], missed[close], noise[close]
    away = np.abs(profile - middles)

    def doubt(name: str, reach: FloatArray | float, carried: FloatArray | float) -> None:
        nearness = np.maximum(1.0 - away / reach, 0.0)
        # A column of the sample stands for others as close to the step.
        counted = np.where(missed < 0.0, nearness, nearness > 0.0)
        squares = (steps[large][:, None] * counted * np.minimum(carried, 0.5)) ** 2
        found.add_doubt([name], max(float((squares @ missed).sum()), 0.0))

    for effect in pixels.noises:
        own = pixels.noise_at(frozenset({effect.name}), profile) ** 2
        rest = noise**2 - own
        rest[own > rest] = 0.0  # without the larger noise, the rest may be left out too
        rest = np.maximum(rest, _ROUNDING_MARGIN**2)
        by_chance = np.sqrt(own / (rest + own)) / 3.0 / region.rows
        carried = np.sqrt((own / rest / 8.0) ** 2 + by_chance)
        doubt(effect.name, np.maximum(2.0 * noise, _ROUNDING_MARGIN), carried)
    least = np.maximum(pixels.noise_at(pixels.names, middles), _ROUNDING_MARGIN)
    for name, own in zip(pixels.moving, moved, strict=True):
        doubt(name, max(own, _ROUNDING_MARGIN), 0.4 * own / least)
        if least.min() < LEAST_SMOOTHING_NOISE:  # each column then crosses a step as a whole
            error = found.sampling_error(name, region.columns)
            found.add_doubt([name], SURE_DEVIATIONS * error)


def _seen_profile(pixels: SampledPixels) -> FloatArray:
    """Return the panel's profile as dimmed by the lens."""
    region, columns = pixels.view.region, pixels.sample.columns
    profile = pixels.profile(pixels.names)
    seen = pixels.whole[:, pixels.sample.inner].mean(axis=1)
    gain = seen / np.maximum(profile[columns - region.first_column], 1.0)
    return profile * pixels.interpolate_columns(gain)


def _doubt_a_cut_file(pixels: SampledPixels, found: SampledObservable) -> None:
    """Add doubt about what a file does to clipped noise, which is not normal."""
    if pixels.file is None:
        return
    spread = pixels.spread(pixels.names)
    lost = np.where(
        spread > _CLIPPED_NOISE, 1.0 - unclipped_fraction(pixels.levels, spread, WHITE), 0.0
    )
    cut = pixels.mean_over_pixels(lost)
    gain = float(np.ptp(found.complete / np.sqrt(pixels.sample.weights))) / pixels.view.swing
    doubt = cut * pixels.file.own_change * min(gain, _MOST_GAIN) ** 2 / 4.0
    found.add_doubt((effect.name for effect in (*pixels.noises, *pixels.files)), doubt)
