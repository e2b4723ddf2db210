"""How much the enhanced signal changes without some effects, estimated from a sample."""

import math
from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import Enhancement, LevelSteps
from occ_model.camera.photometry import FLAT_SPAN, WHITE, saturate
from occ_model.camera.pixel_noise import GREY_LEVELS
from occ_model.effects.observed import SURE_DEVIATIONS, SampledObservable
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.signal_sampling import SignalSampling
from occ_model.effects.simulated_columns import Names
from occ_model.effects.smoothed_curves import (
    LEAST_SMOOTHING_NOISE,
    SmoothedCurves,
    add_unsampled,
    cut_block_square,
    unsampled_rim_square,
)

_DOUBTED_RIM, _DOUBTED_RIM_OF_FEW = 0.5, 1.0
"""Fraction of a moving rim's pixels that may or may not be enhanced: in many columns, in few."""

_ROUNDING_MARGIN = 0.02
"""Distance, in grey levels, from a rounding boundary within which rounding is unpredictable."""

_LARGE_STEP = 32.0
"""Step of the enhancement between neighbouring levels above which a single column matters."""

_MOST_GAIN = 8.0  # largest contrast gain of an enhancement that noise smooths

_CLIPPED_NOISE = 8.0  # noise in grey levels above which clipping matters


def signal_swing(pixels: SampledPixels) -> float:
    """Return the largest minus the smallest value of the enhanced bare profile, at least 1."""
    profile = saturate(pixels.view.values)
    enhanced = Enhancement(profile, pixels.scene.model.enhancement)(profile)
    return max(float(enhanced.max()) - float(enhanced.min()), FLAT_SPAN)


def observe_signal(pixels: SampledPixels) -> SampledObservable:
    """Observe the means of the columns after the receiver's enhancement."""
    sample = pixels.sample
    weights = np.sqrt(sample.weights)
    curves = SmoothedCurves(pixels)

    def compute_signals(sets: Sequence[Names]) -> FloatArray:
        values = pixels.values_read_back(sets)
        signals, masks = curves.enhance(sets, values), pixels.panel_mask(sets)
        if masks is not None:  # pixels beside the panel are not enhanced
            for included, own, signal, mask in zip(sets, values, signals, masks, strict=True):
                is_drawn = pixels.noisy.is_drawn(included)
                beside = own if is_drawn else curves.smooth(included, own, GREY_LEVELS)
                np.copyto(signal, beside, where=~mask)
        return pixels.mean_of_rows(signals) * weights

    observed = SampledObservable(pixels.names, compute_signals, sorted(pixels.names))
    region = pixels.view.region
    if pixels.file is None and pixels.noisy.is_drawn(pixels.names):
        greys = pixels.columns.enhancement(pixels.names).curve.astype(np.float64)
        inside = pixels.panel_mask([pixels.names])
        squares = pixels.random_squares(greys, None if inside is None else inside[0])
        means = {name: moved.mean / region.rows for name, moved in squares.items()}
        fluctuations = {n: m.doubt(region.columns, region.rows) for n, m in squares.items()}
    else:
        sampling = SignalSampling(pixels, curves)
        means, fluctuations = sampling.effect_squares(), sampling.fluctuations()
        observed.doubt.update({effect.name: sampling.doubt_of_file for effect in pixels.files})
    observed.independent.update(means)
    add_unsampled(pixels, observed, curves)
    contrast = float(np.ptp(observed.complete / weights))
    step_size = contrast if pixels.scene.model.enhancement == "none" else WHITE
    few = len(sample.columns) >= region.columns
    part = _DOUBTED_RIM_OF_FEW if few else _DOUBTED_RIM
    doubt = unsampled_rim_square(pixels, contrast**2 / (region.rows**2 * region.columns))
    gain = min(contrast / pixels.view.swing, _MOST_GAIN)
    doubt += cut_block_square(pixels) * gain**2
    for name in pixels.sample.outline:  # a pixel of a rim is either enhanced or not
        own = pixels.rims.count_moved_rims(name) * (part * step_size / region.rows) ** 2
        observed.doubt[name] = doubt + own + pixels.rims.upright_rim_error(name) * step_size**2
    for name, square in fluctuations.items():
        observed.add_doubt([name], square)
    _doubt_sharp_steps(pixels, observed)
    _doubt_large_steps(pixels, observed)
    _doubt_clipped_noise(pixels, observed)
    return observed


def _doubt_sharp_steps(pixels: SampledPixels, observed: SampledObservable) -> None:
    """Add doubt about rounding where no noise spreads the pixels over the enhancement's steps.

    All pixels of one value near a rounding boundary may round to either level. In a file this holds
    for any value closer to it than the file's error, which is the same in all blocks of equal rows.
    """
    values = np.clip(pixels.complete_values, 0.0, WHITE)
    sharp = pixels.table.interpolate(pixels.spread(pixels.names), values) < LEAST_SMOOTHING_NOISE
    if not sharp.any():
        return
    enhancement = pixels.columns.enhancement(pixels.names)
    if pixels.file is None:
        curve = enhancement.curve.astype(np.float64)
        below = np.minimum(values, WHITE - 1.0).astype(np.int64)
        is_near = np.abs(values - below - 0.5) < _ROUNDING_MARGIN
        step = np.where(is_near, curve[below + 1] - curve[below], 0.0) / 2.0
    else:
        error = np.full(values.size, math.sqrt(pixels.file.own_change))
        steps, curve = LevelSteps.of(values.ravel(), error), enhancement.curve.astype(np.float64)
        variance = steps.mean_of(curve**2) - steps.mean_of(curve) ** 2
        step = np.sqrt(np.maximum(variance, 0.0)).reshape(values.shape)
    square = pixels.mean_of_rows(np.where(sharp, step, 0.0) ** 2)
    observed.add_doubt(pixels.names, float((square * pixels.sample.weights).sum()))


def _doubt_large_steps(pixels: SampledPixels, observed: SampledObservable) -> None:
    """Add doubt about columns outside the sample that are near a large step of the enhancement.

    An equalization makes a large step where many columns have the same value. The changes there are
    summed over all columns of the profile, minus those that the sample's columns represent.
    """
    weights, region = pixels.unsampled, pixels.view.region
    if weights is None:
        return
    enhancement = pixels.columns.enhancement(pixels.names)
    steps = np.diff(enhancement.curve.astype(np.float64))
    large = np.flatnonzero(steps > _LARGE_STEP)
    if not len(large):
        return
    profile = _dimmed_profile(pixels)
    middles = np.asarray(large + 0.5, dtype=np.float64)[:, None]
    noise = pixels.noise_at(pixels.names, profile)  # a saturated pixel has none
    squares = pixels.mean_of_rows((pixels.stack[1:] - pixels.complete_values) ** 2)
    changes = np.sqrt(squares.max(axis=1)).tolist()
    reach = max(2.0 * float(noise.max()), *changes, _ROUNDING_MARGIN)
    close = (np.abs(profile - middles) < reach).any(axis=0)
    profile, weights, noise = profile[close], weights[close], noise[close]
    distance = np.abs(profile - middles)

    def add_doubt(name: str, reach: FloatArray | float, fraction: FloatArray | float) -> None:
        nearness = np.maximum(1.0 - distance / reach, 0.0)
        # A column of the sample represents others that are as close to the step.
        counts = np.where(weights < 0.0, nearness, nearness > 0.0)
        squares = (steps[large][:, None] * counts * np.minimum(fraction, 0.5)) ** 2
        observed.add_doubt([name], max(float((squares @ weights).sum()), 0.0))

    for effect in pixels.noises:
        own = pixels.noise_at(frozenset({effect.name}), profile) ** 2
        rest = noise**2 - own
        rest[own > rest] = 0.0  # without the larger noise, the rest may be left out too
        rest = np.maximum(rest, _ROUNDING_MARGIN**2)
        chance = np.sqrt(own / (rest + own)) / 3.0 / region.rows
        fraction = np.sqrt((own / rest / 8.0) ** 2 + chance)
        add_doubt(effect.name, np.maximum(2.0 * noise, _ROUNDING_MARGIN), fraction)
    spreads = np.maximum(pixels.noise_at(pixels.names, middles), _ROUNDING_MARGIN)
    for name, own in zip(pixels.moving, changes, strict=True):
        add_doubt(name, max(own, _ROUNDING_MARGIN), 0.4 * own / spreads)
        if spreads.min() < LEAST_SMOOTHING_NOISE:  # each column then crosses a step as a whole
            error = observed.sampling_error(name, region.columns)
            observed.add_doubt([name], SURE_DEVIATIONS * error)


def _dimmed_profile(pixels: SampledPixels) -> FloatArray:
    """Return the panel's profile after dimming by the lens."""
    region, columns = pixels.view.region, pixels.sample.columns
    profile = pixels.profile(pixels.names)
    means = pixels.complete_values[:, pixels.sample.inner].mean(axis=1)
    gain = means / np.maximum(profile[columns - region.first_column], 1.0)
    return profile * pixels.interpolate_columns(gain)


def _doubt_clipped_noise(pixels: SampledPixels, observed: SampledObservable) -> None:
    """Add doubt about a file's change of clipped noise, which is not normally distributed."""
    if pixels.file is None:
        return
    spread = pixels.spread(pixels.names)
    ends = sum(pixels.noisy.end_fractions(pixels.names, pixels.table.levels))
    clipped_fraction = np.where(spread > _CLIPPED_NOISE, ends, 0.0)
    clipped = pixels.mean_over_pixels(clipped_fraction)
    gain = float(np.ptp(observed.complete / np.sqrt(pixels.sample.weights))) / pixels.view.swing
    doubt = clipped * pixels.file.own_change * min(gain, _MOST_GAIN) ** 2 / 4.0
    observed.add_doubt((effect.name for effect in (*pixels.noises, *pixels.files)), doubt)
