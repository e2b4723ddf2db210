"""What light changes in few columns, of which a sample may have none or too many."""

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.effects.observed import Observed
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.smoothed_curves import LEAST_SMOOTHING_NOISE, SmoothedCurves

_MISSED_FRACTION = 0.1
"""Part of a change that a sample must miss for its columns to be too few."""


def add_unsampled(
    pixels: SampledPixels, found: Observed, curves: SmoothedCurves | None = None
) -> None:
    """Add to the mean square of each change what columns beside the sample add to it.

    Where most columns are white or black, or an enhancement makes them so, a change of the light
    shows in the few that are not, and where little noise spreads the rounding, so does noise. All
    columns of a profile cost microseconds, without the enhancement's curves.
    """
    lacking = pixels.unsampled
    if lacking is None:
        return

    def add(name: str, seen: FloatArray) -> None:
        missed = float((seen[1] - seen[0]) ** 2 @ lacking)
        found.alone[name] = found.alone.get(name, 0.0) + max(missed, 0.0)

    for effect in (*pixels.lights, *pixels.limits, *pixels.lenses):
        profiles = _profiles(pixels, effect.name)
        if profiles is None:
            continue
        sets = [pixels.names, pixels.names - {effect.name}]
        changed = profiles
        if curves is not None:  # as if there were no noise
            pairs = zip(sets, profiles, strict=True)
            levels = [pixels.columns.enhancement(one)(own) for one, own in pairs]
            changed = np.array(levels, dtype=np.float64)
        squares = (changed[1] - changed[0]) ** 2
        if squares @ lacking <= _MISSED_FRACTION * squares.mean():
            continue
        if curves is not None:
            changed = curves.enhanced(sets, profiles)
        add(effect.name, changed)
    if curves is not None and pixels.least_noise(pixels.names) < LEAST_SMOOTHING_NOISE:
        profiles = np.stack([pixels.profile(pixels.names)] * 2)
        for noise in pixels.noises:
            sets = [pixels.names, pixels.names - {noise.name}]
            add(noise.name, curves.enhanced(sets, profiles))


def _profiles(pixels: SampledPixels, name: str) -> FloatArray | None:
    """Return the profile with an effect and without it, None where it moves rims alone.

    What dims each pixel otherwise is taken for its mean over the rows.
    """
    whole, dimming = pixels.profile(pixels.names), pixels.dimming(name)
    if dimming is None:
        is_rim = name in pixels.sample.outline
        return None if is_rim else np.stack([whole, pixels.profile(pixels.names - {name})])
    return np.stack([pixels.profile(pixels.names, pixels.over_columns(dimming)), whole])
