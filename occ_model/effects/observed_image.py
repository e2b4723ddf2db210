"""How leaving effects out changes the image and the column profile, estimated from a sample."""

import math
from collections.abc import Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.effects.normal_noise import clipped_mean, fraction_unclipped, normal_fraction
from occ_model.effects.observed import Observed
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.simulated_columns import Names
from occ_model.effects.smoothed_curves import add_unsampled
from occ_model.effects.unsampled_rims import cut_blocks_of_means, unsampled

_SHARP_NOISE = 1e-9  # deviation in grey levels that none is taken for


def observed_image(pixels: SampledPixels) -> Observed:
    """Return the pixels, each weighted by how much of its change is seen."""
    everything, file = pixels.names, pixels.file
    spread = pixels.spread(everything)
    unclipped = fraction_unclipped(pixels.levels, spread, WHITE)
    # Where the light changes, its noise does; and pixels that are cut off change less.
    fraction = pixels.at_whole(unclipped * (1.0 + pixels.table.slope(spread) ** 2))
    weights = np.sqrt(np.maximum(fraction * pixels.sample.pixel_weights, 0.0)).ravel()

    def seen(sets: Sequence[Names]) -> FloatArray:
        return pixels.values(sets).reshape(len(sets), -1) * weights

    found = Observed(everything, seen, pixels.moving)
    region = pixels.view.region
    if pixels.sample.outline:
        doubt = unsampled(pixels, pixels.contrast**2 / (region.rows * region.columns))
        square = 3.0 * pixels.contrast**2
        found.doubt.update(
            {n: doubt + square * pixels.rims.crossed(n) for n in pixels.sample.outline}
        )
    for name, variance in pixels.variances.items():
        found.alone[name] = (
            pixels.mean_at_whole(variance * unclipped)
            if file is None
            else pixels.noise_read_back[name][0]
        )
    if file is not None:
        found.alone[pixels.files[0].name] = file.own_change
        squares = np.array([found.shown(name) for name in pixels.moving])
        doubts = np.array([found.doubt.get(name, 0.0) for name in pixels.moving])
        rims = np.array([pixels.rims.moved(name) for name in pixels.moving]) * 8.0 / region.rows
        inside, _, more = (of_sets[1:] for of_sets in file.added)
        added = inside + file.added_at_rims(np.minimum(rims, 1.0), squares + doubts)
        alone = np.maximum(added, -squares)
        doubts += np.maximum(added + more, -0.5 * (squares + doubts)) - alone
        found.alone.update(zip(pixels.moving, alone.tolist(), strict=True))
        found.doubt.update(zip(pixels.moving, doubts.tolist(), strict=True))
    add_unsampled(pixels, found)
    return found


def observed_profile(pixels: SampledPixels) -> Observed:
    """Return the means of the columns, rounded, clipped and as a file keeps them."""
    everything, sample, file = pixels.names, pixels.sample, pixels.file
    rows, weights = pixels.view.region.rows, np.sqrt(sample.weights)

    def seen(sets: Sequence[Names]) -> FloatArray:
        spread = np.stack([pixels.spread(included) for included in sets])
        tables = clipped_mean(pixels.levels, spread, WHITE)
        if file is not None:  # whose error is cut off again, also of pixels that are at an end
            filed = [at for at, one in enumerate(sets) if pixels.files[0].name in one]
            below = normal_fraction(-pixels.levels / np.maximum(spread[filed], _SHARP_NOISE))
            above = normal_fraction(
                (pixels.levels - WHITE) / np.maximum(spread[filed], _SHARP_NOISE)
            )
            error = math.sqrt(file.own_change)
            tables[filed] += (below - above) * error / math.sqrt(2.0 * math.pi)
        found = pixels.table.look_each(tables, pixels.read_back(sets))
        return pixels.mean_of_rows(found) * weights

    found = Observed(everything, seen, sorted(everything))
    region = pixels.view.region
    if pixels.sample.outline:
        square = pixels.contrast**2
        doubt = unsampled(pixels, square / (region.rows**2 * region.columns))
        doubt += cut_blocks_of_means(pixels)
        found.doubt.update(
            {n: doubt + square * pixels.rims.crossed(n) for n in pixels.sample.outline}
        )
    if file is None:
        variances = {n: pixels.mean_at_whole(v) for n, v in pixels.variances.items()}
        found.add_noise({n: v / rows for n, v in variances.items()}, region.columns)
    else:
        found.alone.update({n: of_mean for n, (_, of_mean) in pixels.noise_read_back.items()})
        name = pixels.files[0].name
        found.alone[name] = file.own_sampling()
        found.doubt[name] = found.shown(name)
        for name in pixels.moving:  # what rounding adds is known to within its size
            added, more = (float(of_sets[pixels.place(name)]) for of_sets in file.added[1:])
            found.alone[name] = added
            added += 2.0 * more / file.block_rows
            found.add_doubt([name], added)
    add_unsampled(pixels, found)
    return found
