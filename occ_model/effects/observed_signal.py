"""How leaving effects out changes the enhanced signal, estimated from a sample."""

import math
from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import Enhancement, PassedSteps
from occ_model.camera.photometry import FLAT_SPAN, WHITE, saturate
from occ_model.effects.normal_noise import clipped_mean, fraction_unclipped
from occ_model.effects.observed import Observed
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.signal_sampling import SURE_DEVIATIONS, SignalSampling
from occ_model.effects.simulated_columns import Names
from occ_model.effects.smoothed_curves import LEAST_SMOOTHING_NOISE, SmoothedCurves, add_unsampled
from occ_model.effects.unsampled_rims import cut_blocks_of_means, unsampled

_DOUBTED_RIM, _DOUBTED_RIM_OF_FEW = 0.5, 1.0
"""Part of the pixels of a rim that moves of which no sample shows whether they are enhanced: in
many columns, and in few."""

_ROUNDING_MARGIN = 0.02
"""Grey levels from the middle between two levels within which rounding cannot be predicted."""

_LARGE_STEP = 32.0
"""Step between neighbouring levels after the enhancement above which a single column matters."""

_MOST_GAIN = 8.0  # times by which an enhancement raises contrasts at most, where noise smooths it

_LEVELS = np.arange(256.0)

_CLIPPED_NOISE = 8.0  # noise in grey levels that black and white cut off noticeably


def signal_swing(pixels: SampledPixels) -> float:
    """Largest less smallest value of the enhanced profile without effects, at least 1."""
    seen = saturate(pixels.view.values)
    enhanced = Enhancement(seen, pixels.scene.model.enhancement)(seen)
    return max(float(enhanced.max()) - float(enhanced.min()), FLAT_SPAN)


def observed_signal(pixels: SampledPixels) -> Observed:
    """Return the means of the columns after the receiver's enhancement."""
    sample = pixels.sample
    weights = np.sqrt(sample.weights)
    curves = SmoothedCurves(pixels)

    def seen(sets: Sequence[Names]) -> FloatArray:
        values = pixels.read_back(sets)
        found, inside = curves.enhanced(sets, values), pixels.inside(sets)
        if inside is not None:  # beside the panel nothing is enhanced
            for included, own, of_own, on in zip(sets, values, found, inside, strict=True):
                if not on.all():
                    of_own[~on] = _mean_rounded(pixels, included, own[~on])
        return pixels.mean_of_rows(found) * weights

    found = Observed(pixels.names, seen, sorted(pixels.names))
    sampling = SignalSampling(pixels, curves)
    found.alone.update(sampling.of_effects())
    add_unsampled(pixels, found, curves)
    fluctuations = sampling.fluctuations()
    found.doubt.update({effect.name: sampling.doubt_of_file for effect in pixels.files})
    region, contrast = pixels.view.region, float(np.ptp(found.complete / weights))
    jump = contrast if pixels.scene.model.enhancement == "none" else WHITE
    few = len(sample.columns) >= region.columns
    part = _DOUBTED_RIM_OF_FEW if few else _DOUBTED_RIM
    doubt = unsampled(pixels, contrast**2 / (region.rows**2 * region.columns))
    gain = min(contrast / pixels.view.swing, _MOST_GAIN)
    doubt += cut_blocks_of_means(pixels) * gain**2
    for name in pixels.sample.outline:  # a pixel of a rim is enhanced or not
        own = pixels.rims.moved(name) * (part * jump / region.rows) ** 2
        found.doubt[name] = doubt + own + pixels.rims.crossed(name) * jump**2
    for name, square in fluctuations.items():
        found.add_doubt([name], square)
    _doubt_sharp_steps(pixels, found)
    _doubt_large_steps(pixels, found)
    _doubt_a_cut_file(pixels, found)
    return found


def _mean_rounded(pixels: SampledPixels, included: Names, values: FloatArray) -> FloatArray:
    """Return the mean of pixels of some mean values that are rounded and not enhanced."""
    spread = pixels.spread(included)
    if float(spread.max()) < LEAST_SMOOTHING_NOISE:
        flat = np.clip(values, 0.0, WHITE)
        return PassedSteps.of(flat, pixels.noise_at(included, flat)).mean_of(_LEVELS)
    return pixels.table.look(clipped_mean(pixels.levels, spread, WHITE), values)


def _doubt_sharp_steps(pixels: SampledPixels, found: Observed) -> None:
    """Add doubt about the rounding of pixels that no noise spreads over the enhancement's steps.

    Whole plateaus of values that lie between two levels may be rounded otherwise; in a file
    whatever its own error reaches, since that is the same in blocks of equal rows.
    """
    whole = np.clip(pixels.whole, 0.0, WHITE)
    sharp = pixels.table.look(pixels.spread(pixels.names), whole) < LEAST_SMOOTHING_NOISE
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


def _doubt_large_steps(pixels: SampledPixels, found: Observed) -> None:
    """Add doubt about columns near a large step of the enhancement that the sample lacks.

    An equalization makes one where many columns have the same value. What each column of the
    profile changes there is summed over all columns, less what those of the sample stand for.
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
    noise = pixels.noise_at(pixels.names, profile)  # a full pixel has none
    squares = pixels.mean_of_rows((pixels.stack[1:] - pixels.whole) ** 2)
    moved = np.sqrt(squares.max(axis=1)).tolist()
    reach = max(2.0 * float(noise.max()), *moved, _ROUNDING_MARGIN)
    close = (np.abs(profile - middles) < reach).any(axis=0)
    profile, missed, noise = profile[close], missed[close], noise[close]
    away = np.abs(profile - middles)

    def doubt(name: str, reach: FloatArray | float, carried: FloatArray | float) -> None:
        nearness = np.maximum(1.0 - away / reach, 0.0)
        # A column of the sample stands for others that are as close to the step.
        counted = np.where(missed < 0.0, nearness, nearness > 0.0)
        squares = (steps[large][:, None] * counted * np.minimum(carried, 0.5)) ** 2
        found.add_doubt([name], max(float((squares @ missed).sum()), 0.0))

    for effect in pixels.noises:
        own = pixels.noise_at(frozenset({effect.name}), profile) ** 2
        rest = noise**2 - own
        rest[own > rest] = 0.0  # where most is left out, the rest may be left out too
        rest = np.maximum(rest, _ROUNDING_MARGIN**2)
        by_chance = np.sqrt(own / (rest + own)) / 3.0 / region.rows
        carried = np.sqrt((own / rest / 8.0) ** 2 + by_chance)
        doubt(effect.name, np.maximum(2.0 * noise, _ROUNDING_MARGIN), carried)
    least = np.maximum(pixels.noise_at(pixels.names, middles), _ROUNDING_MARGIN)
    for name, own in zip(pixels.moving, moved, strict=True):
        doubt(name, max(own, _ROUNDING_MARGIN), 0.4 * own / least)
        if least.min() < LEAST_SMOOTHING_NOISE:  # each column passes a step by itself
            error = found.sampling_error(name, region.columns)
            found.add_doubt([name], SURE_DEVIATIONS * error)


def _seen_profile(pixels: SampledPixels) -> FloatArray:
    """Return the profile of the panel as the lens dims it."""
    region, columns = pixels.view.region, pixels.sample.columns
    profile = pixels.profile(pixels.names)
    seen = pixels.whole[:, pixels.sample.inner].mean(axis=1)
    gain = seen / np.maximum(profile[columns - region.first_column], 1.0)
    return profile * pixels.over_columns(gain)


def _doubt_a_cut_file(pixels: SampledPixels, found: Observed) -> None:
    """Add doubt about a file's change of noise that black or white cuts off: it is not normal."""
    if pixels.file is None:
        return
    spread = pixels.spread(pixels.names)
    lost = np.where(
        spread > _CLIPPED_NOISE, 1.0 - fraction_unclipped(pixels.levels, spread, WHITE), 0.0
    )
    cut = pixels.mean_at_whole(lost)
    gain = float(np.ptp(found.complete / np.sqrt(pixels.sample.weights))) / pixels.view.swing
    doubt = cut * pixels.file.own_change * min(gain, _MOST_GAIN) ** 2 / 4.0
    found.add_doubt((effect.name for effect in (*pixels.noises, *pixels.files)), doubt)
