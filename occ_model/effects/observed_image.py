"""How much image and column profile change without some effects, estimated from a sample."""

import math
from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.effects.normal_noise import mean_after_clipping, normal_fraction, unclipped_fraction
from occ_model.effects.observed import SampledObservable
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.simulated_columns import Names
from occ_model.effects.smoothed_curves import add_unsampled
from occ_model.effects.unsampled_rims import cut_block_square, unsampled_rim_square

_SHARP_NOISE = 1e-9  # noise in grey levels that stands for none


def observe_image(pixels: SampledPixels) -> SampledObservable:
    """Observe the pixels, each weighted by how much of its change clipping leaves."""
    everything, file = pixels.names, pixels.file
    spread = pixels.spread(everything)
    unclipped = unclipped_fraction(pixels.levels, spread, WHITE)
    # A change of the light also changes its noise, and clipped pixels change less.
    fraction = pixels.interpolate_at_pixels(unclipped * (1.0 + pixels.table.slope(spread) ** 2))
    weights = np.sqrt(np.maximum(fraction * pixels.sample.pixel_weights, 0.0)).ravel()

    def observe(sets: Sequence[Names]) -> FloatArray:
        return pixels.values(sets).reshape(len(sets), -1) * weights

    found = SampledObservable(everything, observe, pixels.moving)
    region = pixels.view.region
    if pixels.sample.outline:
        doubt = unsampled_rim_square(pixels, pixels.contrast**2 / (region.rows * region.columns))
        square = 3.0 * pixels.contrast**2
        found.doubt.update(
            {n: doubt + square * pixels.rims.upright_rim_error(n) for n in pixels.sample.outline}
        )
    for name, variance in pixels.variances.items():
        found.alone[name] = (
            pixels.mean_over_pixels(variance * unclipped)
            if file is None
            else pixels.noise_read_back[name][0]
        )
    if file is not None:
        found.alone[pixels.files[0].name] = file.own_change
        squares = np.array([found.sampled_square(name) for name in pixels.moving])
        doubts = np.array([found.doubt.get(name, 0.0) for name in pixels.moving])
        rims = (
            np.array([pixels.rims.count_moved_rims(name) for name in pixels.moving])
            * 8.0
            / region.rows
        )
        inside, _, more = (of_sets[1:] for of_sets in file.growth)
        added = inside + file.growth_at_rims(np.minimum(rims, 1.0), squares + doubts)
        alone = np.maximum(added, -squares)
        doubts += np.maximum(added + more, -0.5 * (squares + doubts)) - alone
        found.alone.update(zip(pixels.moving, alone.tolist(), strict=True))
        found.doubt.update(zip(pixels.moving, doubts.tolist(), strict=True))
    add_unsampled(pixels, found)
    return found


def observe_profile(pixels: SampledPixels) -> SampledObservable:
    """Observe the means of the columns, after rounding, clipping and the file."""
    everything, sample, file = pixels.names, pixels.sample, pixels.file
    rows, weights = pixels.view.region.rows, np.sqrt(sample.weights)

    def observe(sets: Sequence[Names]) -> FloatArray:
        spread = np.stack([pixels.spread(included) for included in sets])
        tables = mean_after_clipping(pixels.levels, spread, WHITE)
        if file is not None:  # its error is clipped again, also where pixels are black or white
            filed = [at for at, one in enumerate(sets) if pixels.files[0].name in one]
            below = normal_fraction(-pixels.levels / np.maximum(spread[filed], _SHARP_NOISE))
            above = normal_fraction(
                (pixels.levels - WHITE) / np.maximum(spread[filed], _SHARP_NOISE)
            )
            error = math.sqrt(file.own_change)
            tables[filed] += (below - above) * error / math.sqrt(2.0 * math.pi)
        found = pixels.table.interpolate_each(tables, pixels.values_read_back(sets))
        return pixels.mean_of_rows(found) * weights

    found = SampledObservable(everything, observe, sorted(everything))
    region = pixels.view.region
    if pixels.sample.outline:
        square = pixels.contrast**2
        doubt = unsampled_rim_square(pixels, square / (region.rows**2 * region.columns))
        doubt += cut_block_square(pixels)
        found.doubt.update(
            {n: doubt + square * pixels.rims.upright_rim_error(n) for n in pixels.sample.outline}
        )
    if file is None:
        variances = {n: pixels.mean_over_pixels(v) for n, v in pixels.variances.items()}
        found.add_noise({n: v / rows for n, v in variances.items()}, region.columns)
    else:
        found.alone.update({n: of_mean for n, (_, of_mean) in pixels.noise_read_back.items()})
        name = pixels.files[0].name
        found.alone[name] = file.own_sampling_square()
        found.doubt[name] = found.sampled_square(name)
        for name in pixels.moving:  # the growth by rounding is known only to within its own size
            added, more = (float(of_sets[pixels.stack_index(name)]) for of_sets in file.growth[1:])
            found.alone[name] = added
            added += 2.0 * more / file.block_rows
            found.add_doubt([name], added)
    add_unsampled(pixels, found)
    return found
