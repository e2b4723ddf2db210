"""Sequences of chips by their runs of equal chips."""

import math
from itertools import groupby

import numpy as np

from occ_model.arrays import ByteArray


def runs_of(chips: ByteArray) -> list[int]:
    """Count the chips of each run of equal chips in one period, from a change on."""
    changes = np.flatnonzero(chips != np.roll(chips, 1))
    if changes.size == 0:
        return [len(chips)]
    turned = np.roll(chips, -int(changes[0])).tolist()
    return [len(list(run)) for _, run in groupby(turned)]


def canonical(chips: ByteArray) -> ByteArray:
    """Rotate a sequence so that its longest run of ones comes first, and keep one period of it."""
    text = "".join(map(str, chips.tolist()))
    shortest = (text + text).find(text, 1)
    text = text[:shortest]
    turned = max(text[start:] + text[:start] for start in range(len(text)))
    return np.array(list(turned), dtype=np.uint8)


def is_single_pulse(chips: ByteArray) -> bool:
    """Whether a period has one pulse only, as any regular pattern has."""
    return len(runs_of(canonical(chips))) <= 2


def chips_if_longer(chips: ByteArray) -> tuple[int, int]:
    """Return how many chips may be one longer chip, and the excess of each bright run.

    If white lengthens bright runs, rising and falling edges lie on two lattices of longer chips.
    (1, 0) is returned if they do not, and for a single pulse, which fits any lattice.
    """
    runs = runs_of(canonical(chips))
    if len(runs) <= 2:
        return 1, 0
    bright = runs[::2]  # the longest run of ones comes first
    rising = np.cumsum([0, *runs])[::2]
    falling = rising[:-1] + bright
    together = math.gcd(*np.diff(rising).tolist(), *np.diff(falling).tolist())
    lengths = [part for part in range(1, together + 1) if together % part == 0]
    most = max((part for part in lengths if 0 < bright[0] % part < min(bright)), default=1)
    return most, bright[0] % most
