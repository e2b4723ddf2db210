"""What light changes in few columns, of which a sample may have none or too many."""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.effects.observed import Observed
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.simulated_columns import Names
from occ_model.effects.smoothed_curves import SmoothedCurves

_MISSED_FRACTION = 0.1
"""Part of a change that a sample must miss for its columns to be too few."""


def add_unsampled(
    pixels: SampledPixels, found: Observed, curves: SmoothedCurves | None = None
) -> None:
    """Add to the mean square of each change of the light what columns beside the sample add to it.

    Where most columns are white or black, or an enhancement makes them so, a change shows in the
    few that are not. All columns of a profile cost microseconds, without the enhancement's curves.
    """
    if pixels.unsampled is None:
        return
    whole = pixels.profile(pixels.names)
    for effect in (*pixels.lights, *pixels.limits):
        sets = [pixels.names, pixels.names - {effect.name}]
        profiles = np.stack([whole, pixels.profile(sets[1])])
        changed = profiles
        if curves is not None:  # as if there were no noise
            changed = np.stack(
                [_enhanced(pixels, *pair) for pair in zip(sets, profiles, strict=True)]
            )
        squares = (changed[1] - changed[0]) ** 2
        if squares @ pixels.unsampled < _MISSED_FRACTION * squares.mean():
            continue
        if curves is not None:
            changed = curves.enhanced(sets, profiles)
        missed = float((changed[1] - changed[0]) ** 2 @ pixels.unsampled)
        found.alone[effect.name] = found.alone.get(effect.name, 0.0) + max(missed, 0.0)


def _enhanced(pixels: SampledPixels, included: Names, profile: FloatArray) -> FloatArray:
    return pixels.columns.enhancement(included)(profile).astype(np.float64)
