"""How leaving effects out changes the enhanced signal, estimated from a sample."""

import math
from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.enhancement import Enhancement, PassedSteps
from occ_model.camera.photometry import FLAT, WHITE, saturate
from occ_model.effects.normal import clipped_mean, share_unclipped
from occ_model.effects.observed import Observed
from occ_model.effects.sampled_pixels import Names, SampledPixels

_DOUBTED_RIM, _DOUBTED_RIM_OF_FEW = 0.5, 1.0
"""Part of the pixels of a rim that moves of which no sample shows whether they are enhanced: in
many columns, and in few."""

_FLUCTUATION = 4.0
"""Standard deviations by which few pixels that are rounded otherwise may exceed their mean."""

_ROUNDING_MARGIN = 0.02
"""Grey levels from the middle between two levels within which rounding cannot be foretold."""

_LARGE_STEP = 32.0
"""Levels by which an enhancement can part neighbouring levels, so that one column matters."""

_LEAST_SAMPLED_COLUMNS = 3
"""Sampled columns near a large step from which the sample shows what happens there."""

_CLIPPED_NOISE = 8.0
"""Noise in grey levels that black and white cut off noticeably."""

_LEAST_SMOOTHING_NOISE = 0.5
"""Noise in grey levels below which the enhancement's steps show between the levels."""


def signal_swing(pixels: SampledPixels) -> float:
    """Largest less smallest value of the enhanced profile without effects, at least 1."""
    seen = saturate(pixels.view.values)
    enhanced = Enhancement(seen, pixels.scene.model.enhancement)(seen)
    return max(float(enhanced.max()) - float(enhanced.min()), FLAT)


def observed_signal(pixels: SampledPixels) -> Observed:
    """Return the means of the columns after the receiver's enhancement."""
    sample = pixels.sample
    weights = np.sqrt(sample.weights)
    levels = np.clip(pixels.levels, 0.0, WHITE)
    spreads: dict[Names, FloatArray] = {}
    passed: dict[Names, PassedSteps] = {}
    curves: dict[Names, FloatArray] = {}
    optics = frozenset(effect.name for effect in pixels.lenses)
    moving = frozenset(pixels.moving)

    def spread_of(included: Names) -> FloatArray:
        key = included - moving
        if key not in spreads:
            own = pixels.spread(included)
            is_filed = pixels.file is not None and pixels.files[0].name in included
            spreads[key] = pixels.file.spread(own) if pixels.file and is_filed else own
        return spreads[key]

    def curve_of(included: Names) -> FloatArray:
        key = included - optics
        if key not in curves:
            spread, noises = spread_of(included), included - moving
            if noises not in passed:
                passed[noises] = PassedSteps.of(levels, spread)
            curves[key] = pixels.enhancement(included).mean(passed[noises])
        return curves[key]

    def seen(sets: Sequence[Names]) -> FloatArray:
        values = pixels.read_back(sets)
        found = pixels.look_each(np.stack([curve_of(one) for one in sets]), values)
        for included, own, of_own in zip(sets, values, found, strict=True):
            spread = spread_of(included)
            if float(spread.max()) < _LEAST_SMOOTHING_NOISE:
                flat = np.clip(own.ravel(), 0.0, WHITE)
                steps = PassedSteps.of(flat, pixels.look(spread, flat))
                of_own[:] = pixels.enhancement(included).mean(steps).reshape(own.shape)
        inside = pixels.inside(sets)
        if inside is not None:  # beside the panel nothing is enhanced
            for included, own, of_own, on in zip(sets, values, found, inside, strict=True):
                if not on.all():
                    of_own[~on] = _beside(pixels, included, own[~on])
        return pixels.mean_of_rows(found) * weights

    found = Observed(pixels.names, seen, sorted(pixels.names))
    found.alone.update(_signal_sampling(pixels))
    region, contrast = pixels.view.region, float(np.ptp(found.complete / weights))
    method = pixels.scene.model.enhancement
    jump = contrast if method == "none" else WHITE
    few = len(sample.columns) >= region.columns
    part = _DOUBTED_RIM_OF_FEW if few else _DOUBTED_RIM
    doubt = pixels.doubted_pixels(contrast**2 / (region.rows**2 * region.columns))
    for name in pixels.outline:  # a pixel of a rim is enhanced or not
        own = pixels.moved_rims(name) * (part * jump / region.rows) ** 2
        found.doubt[name] = doubt + own
    _doubt_sharp_steps(pixels, found)
    _doubt_large_steps(pixels, found)
    _doubt_a_cut_file(pixels, found)
    return found


def _beside(pixels: SampledPixels, included: Names, values: FloatArray) -> FloatArray:
    """Return the mean of pixels of some mean values that are rounded and not enhanced."""
    spread = pixels.spread(included)
    if float(spread.max()) < _LEAST_SMOOTHING_NOISE:
        return np.rint(np.clip(values, 0.0, WHITE))
    return pixels.look(clipped_mean(pixels.levels, spread, WHITE), values)


def _doubt_sharp_steps(pixels: SampledPixels, found: Observed) -> None:
    """Doubt how pixels are rounded that no noise spreads over the enhancement's steps.

    Whole plateaus of values that lie between two levels may be rounded otherwise; in a file
    whatever its own error reaches, since that is alike in blocks of equal rows.
    """
    spread = pixels.spread(pixels.names)
    if float(spread.min()) >= _LEAST_SMOOTHING_NOISE:
        return
    whole = np.clip(pixels.whole, 0.0, WHITE)
    sharp = pixels.look(spread, whole) < _LEAST_SMOOTHING_NOISE
    if not sharp.any():
        return
    enhancement = pixels.enhancement(pixels.names)
    if pixels.file is None:
        curve = enhancement.curve.astype(np.float64)
        below = np.minimum(whole, WHITE - 1.0).astype(np.int64)
        near = np.abs(whole - below - 0.5) < _ROUNDING_MARGIN
        reached = np.where(near, curve[below + 1] - curve[below], 0.0) / 2.0
    else:
        error = np.full(whole.size, math.sqrt(pixels.file.own_change()))
        reached = enhancement.moments(whole.ravel(), error)[1].reshape(whole.shape)
    square = pixels.mean_of_rows(np.where(sharp, reached, 0.0) ** 2)
    doubt = float((square * pixels.sample.weights).sum())
    for name in pixels.names:
        found.doubt[name] = found.doubt.get(name, 0.0) + doubt


def _doubt_large_steps(pixels: SampledPixels, found: Observed) -> None:
    """Doubt columns near a large step of the enhancement that the sample does not have.

    An equalization makes one where many columns share a value. A change of less than their
    distance from it carries none of them across.
    """
    sample, region = pixels.sample, pixels.view.region
    if len(sample.columns) >= region.columns:
        return
    enhancement = pixels.enhancement(pixels.names)
    steps = np.diff(enhancement.curve.astype(np.float64))
    large = np.flatnonzero(steps > _LARGE_STEP)
    if not len(large):
        return
    profile = pixels.profile(pixels.names)[region.first_column : region.last_column]
    away = np.abs(profile - large[:, None] - 0.5)
    sampled = away[:, sample.columns - region.first_column]
    moves = pixels.mean_of((pixels.stack - pixels.whole) ** 2).tolist()
    for name in pixels.names:
        if name in pixels.variances:
            own, rest = pixels.noise_without(name)
            moved, share = own, min(0.5, (own / max(rest, _ROUNDING_MARGIN)) ** 2 / 8.0)
        else:
            moved = math.sqrt(moves[pixels.place(name)])
            share = min(0.5, 0.4 * moved / max(pixels.noise_with(pixels.names), _ROUNDING_MARGIN))
        near = max(moved, _ROUNDING_MARGIN)
        unseen = np.count_nonzero(sampled < near, axis=1) < _LEAST_SAMPLED_COLUMNS
        doubt = (away < near).mean(axis=1)[unseen] @ (steps[large][unseen] * share) ** 2
        found.doubt[name] = found.doubt.get(name, 0.0) + float(doubt)


def _doubt_a_cut_file(pixels: SampledPixels, found: Observed) -> None:
    """Doubt what a file makes of noise that black or white cuts off: it is not normal."""
    if pixels.file is None:
        return
    spread, name = pixels.spread(pixels.names), pixels.files[0].name
    lost = np.where(
        spread > _CLIPPED_NOISE, 1.0 - share_unclipped(pixels.levels, spread, WHITE), 0.0
    )
    cut = float(pixels.mean_at_whole(lost))
    gain = float(np.ptp(found.complete / np.sqrt(pixels.sample.weights))) / pixels.view.swing
    doubt = cut * pixels.file.own_change() * min(gain, 8.0) ** 2 / 4.0
    found.doubt[name] = found.doubt.get(name, 0.0) + doubt


def _signal_sampling(pixels: SampledPixels) -> dict[str, float]:
    """Return the mean square of what a mean of few rows deviates by, for each effect.

    A pixel that moves by d passes the curve's steps in proportion to d, which noise spreads
    over the rows. Where the steps are even, a change of a whole step passes no more than one.
    """
    everything, file = pixels.names, pixels.file
    rows = pixels.view.region.rows
    spread = pixels.spread(everything)
    levels = np.clip(pixels.levels, 0.0, WHITE)
    mean, deviation, jumps = pixels.enhancement(everything).smoothed(PassedSteps.of(levels, spread))
    step = float(pixels.levels[1] - pixels.levels[0])
    slope = np.gradient(mean, step) ** 2
    excess = np.maximum(np.gradient(jumps, step) - slope, 0.0)
    total = spread**2
    one = 1.0 / (rows**2 * pixels.view.region.columns)
    pixel = float(pixels.mean_at_whole(slope + excess)) * one
    found: dict[str, float] = {}

    def add(name: str, square: float, linear: float, moves_few: bool) -> None:
        if linear:
            square += linear * rows * float(pixels.mean_at_whole(slope))
        found[name] = square / rows
        if name in pixels.variances:  # one pixel whose noise is drawn otherwise
            found[name] += float(pixels.mean_at_whole(slope * total)) * one
        if moves_few:
            found[name] += _FLUCTUATION * math.sqrt(found[name] * pixel)

    inside = pixels.inside([everything])
    for name, variance in pixels.variances.items():
        moves_few = float(variance.max()) < 0.25 * float(total.max())
        read, linear = pixels.noise_read_back.get(name, (0.0, 0.0))
        own = np.maximum(np.sqrt(variance), math.sqrt(read))
        most = deviation**2
        if file is None:
            linear_part = slope * own**2
        else:  # that the file has rounded as a whole
            linear_part, most = np.zeros(len(own)), np.maximum(most - slope * total, 0.0)
        part = linear_part + slope * np.tanh(4.8 * own) / 6.0 + excess * 0.8 * own
        part = np.where(own**2 > 0.7 * total, most, np.minimum(part, most))
        square = float(pixels.mean_at_whole(part, None if inside is None else inside[0]))
        if inside is not None:
            square += float(pixels.mean_at_whole(own**2, ~inside[0]))
        add(name, square, linear, moves_few)
    if file is not None:
        moved = min(math.sqrt(file.own_change()), 1.0)
        square = float(pixels.mean_at_whole(slope / 6.0 + excess * 0.8 * moved))
        add(pixels.files[0].name, square, file.own_sampling(), moves_few=False)
    even, uneven = pixels.at_whole(slope), pixels.at_whole(excess)
    changes = np.abs(pixels.stack[1:] - pixels.whole)
    linear = np.zeros(len(changes))
    if file is not None:
        added, linear = (of_sets[1:] for of_sets in file.added)
        changes = np.sqrt(changes**2 + np.maximum(added, 0.0)[:, None, None])
    np.minimum(changes, 0.5, out=changes)
    squares = pixels.mean_of(changes * (even * (1.0 - changes) + uneven))
    for name, square, own in zip(pixels.moving, squares.tolist(), linear.tolist(), strict=True):
        add(name, square, own, moves_few=True)
    return found
