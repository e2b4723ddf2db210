"""Changes at the panel's rims that a sample of the pixels may miss, also those by a file."""

from occ_model.effects.sampled_pixels import SampledPixels

_UNSAMPLED_PIXELS = 1.0  # pixels of a rim that may change without being sampled


def unsampled_rim_square(pixels: SampledPixels, square: float) -> float:
    """Return the mean square change of a few pixels of a rim, none of which may be sampled.

    A file spreads it over their block.
    """
    if pixels.sample.is_covered:
        return 0.0
    found = _UNSAMPLED_PIXELS * square
    if pixels.file is not None:
        region = pixels.view.region
        blocks = min(64.0 / (region.rows * region.columns), pixels.rims.fraction)
        found += pixels.file.growth_at_rim(blocks, found)
    return found


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
    alike = file.undithered_fraction
    return added * (alike + (1.0 - alike) / file.block_rows)
