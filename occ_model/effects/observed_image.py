"""How leaving effects out changes the image and the column profile, estimated from a sample."""

import math

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.camera.photometry import WHITE
from occ_model.effects.normal import clipped_mean, share_unclipped
from occ_model.effects.observed import Observed
from occ_model.effects.sampled_pixels import SampledPixels


def observed_image(pixels: SampledPixels) -> Observed:
    """Return the pixels, each weighted by how much of its change is seen."""
    everything, file = pixels.names, pixels.file
    whole = pixels.values(everything)
    spread = pixels.spread(everything)
    slope = np.gradient(spread, pixels.levels)
    unclipped = share_unclipped(pixels.levels, spread, WHITE)
    # Where the light changes, its noise does; and pixels that are cut off change less.
    share = pixels.look(unclipped * (1.0 + slope**2), whole)
    weights = np.sqrt(np.maximum(share * pixels.sample.pixel_weights, 0.0)).ravel()

    def seen(included: frozenset[str]) -> FloatArray:
        return pixels.values(included).ravel() * weights

    found = Observed(everything, seen)
    region = pixels.view.region
    for name in pixels.outline & everything:
        found.doubt[name] = pixels.doubted_pixels(
            pixels.contrast**2 / (region.rows * region.columns)
        )
    for effect in pixels.effects:
        name = effect.name
        if effect in pixels.noises:
            variance = pixels.look(pixels.variances[name] * unclipped, whole)
            square = float((variance * pixels.sample.pixel_weights).sum())
            if file is not None:
                square = file.of_noise(*pixels.noise_without(name))[0]
            found.alone[name] = square
        elif file is not None and effect in pixels.files:
            found.alone[name] = file.own_change()
        elif file is not None:
            plain = found.together(frozenset({name}))
            added = file.added(pixels.values(everything - {name}))[0]
            added += _added_at_rims(pixels, name, plain)
            found.alone[name] = max(added, -0.5 * plain)
    return found


def _added_at_rims(pixels: SampledPixels, name: str, plain: float) -> float:
    """Return what a file adds where an effect moves or softens the panel's rim."""
    if name not in pixels.outline or pixels.file is None:
        return 0.0
    ends = pixels.moved_rims(name) * 8.0 / pixels.view.region.rows
    if plain:
        return pixels.file.added_at_rims(min(ends, 1.0), plain)
    # A rim that moves outwards changes blocks that are observed in part.
    rims = pixels.rim_share
    return pixels.file.added_at_rims(rims, rims * pixels.view.swing**2 / 64.0)


def observed_profile(pixels: SampledPixels) -> Observed:
    """Return the means of the columns, rounded, clipped and as a file keeps them."""
    everything, sample, file = pixels.names, pixels.sample, pixels.file
    whole, rows = pixels.values(everything), pixels.view.region.rows
    weights = np.sqrt(sample.weights)

    def seen(included: frozenset[str]) -> FloatArray:
        spread = pixels.spread(included)
        if file is not None and pixels.files[0].name in included:
            spread = np.hypot(spread, math.sqrt(file.own_change()))
        table = clipped_mean(pixels.levels, spread, WHITE)
        return pixels.mean_of_rows(pixels.look(table, pixels.read_back(included))) * weights

    found = Observed(everything, seen)
    region = pixels.view.region
    for name in pixels.outline & everything:
        share = pixels.contrast**2 / (region.rows**2 * region.columns)
        found.doubt[name] = pixels.doubted_pixels(share)
    for effect in pixels.effects:
        name = effect.name
        if effect in pixels.noises:
            variance = pixels.look(pixels.variances[name], whole)
            part = float((pixels.mean_of_rows(variance) * sample.weights).sum()) / rows
            if file is not None:
                part = file.of_noise(*pixels.noise_without(name))[1]
            found.alone[name] = part
        elif file is not None and effect in pixels.files:
            found.alone[name] = file.own_sampling()
            found.doubt[name] = found.together(frozenset({name}))
        elif file is not None:
            found.alone[name] = file.added(pixels.values(everything - {name}))[1]
    return found
