"""What light changes in few columns, of which a sample may have none or too many."""

from collections.abc import Callable, Sequence

import numpy as np

from occ_model.arrays import FloatArray
from occ_model.effects.observed import Observed
from occ_model.effects.sampled_pixels import SampledPixels
from occ_model.effects.simulated_columns import Names

_MISSED_FRACTION = 0.1
"""Part of a change of the profile that a sample must miss for its columns to be too few."""


def add_unsampled(
    pixels: SampledPixels,
    found: Observed,
    seen: Callable[[Sequence[Names], FloatArray], FloatArray] = lambda _sets, profiles: profiles,
) -> None:
    """Add to the mean square of each change of the light what columns beside the sample add to it.

    Where most columns are white or black, a change shows in the few that are not. All columns of a
    profile cost microseconds; ``seen`` returns what is observed of profiles, (sets, columns).
    """
    if pixels.unsampled is None:
        return
    whole = pixels.profile(pixels.names)
    for effect in (*pixels.lights, *pixels.limits):
        rest = pixels.names - {effect.name}
        profiles = np.stack([whole, pixels.profile(rest)])
        squares = (profiles[1] - whole) ** 2
        if squares @ pixels.unsampled < _MISSED_FRACTION * squares.mean():
            continue
        observed = seen([pixels.names, rest], profiles)
        missed = float((observed[1] - observed[0]) ** 2 @ pixels.unsampled)
        found.alone[effect.name] = found.alone.get(effect.name, 0.0) + max(missed, 0.0)
