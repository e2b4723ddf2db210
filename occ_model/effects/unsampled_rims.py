"""Changes at the panel's rims that no sample of the pixels shows, and those by a file."""

from occ_model.effects.sampled_pixels import SampledPixels

_UNSAMPLED_PIXELS = 1.0  # pixels of a rim that may change and that no sample shows


def unsampled(pixels: SampledPixels, square: float) -> float:
    """Return the mean square of a few pixels of a rim, of which a sample need not show any.

    A file spreads them over their block.
    """
    if pixels.sample.is_covered:
        return 0.0
    found = _UNSAMPLED_PIXELS * square
    if pixels.file is not None:
        region = pixels.view.region
        blocks = min(64.0 / (region.rows * region.columns), pixels.rims.fraction)
        found += pixels.file.added_at_a_rim(blocks, found)
    return found


def cut_blocks_of_means(pixels: SampledPixels) -> float:
    """Return the mean square of what a file changes in the means of columns beside an upright rim.

    Its blocks are observed in part where the rim moves outwards. Where noise spreads the change
    over the file's steps, it differs from block to block.
    """
    file = pixels.file
    if file is None:
        return 0.0
    upright = pixels.rims.fractions[1]
    added = file.added_at_a_rim(upright, upright * pixels.contrast**2 / 8.0)
    alike = file.undithered_fraction
    return added * (alike + (1.0 - alike) / file.block_rows)
