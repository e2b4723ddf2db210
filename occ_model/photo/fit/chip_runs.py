"""Sequences of chips by their runs of equal chips: pulses, and how many of their chips count."""

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


def pulse(on: int, count: int) -> ByteArray:
    """Return the fewest chips of a pulse that is on for some of a number of parts of its period."""
    shared = math.gcd(on, count)
    chips = np.zeros(count // shared, dtype=np.uint8)
    chips[: on // shared] = 1
    return chips


def chips_as_one(chips: ByteArray) -> float:
    """Return how many chips count as one: of a pulse half a period, however fine its chips are.

    A pulse has two edges a period: it samples the brightness of a lamp no more often than a square
    wave of two chips does.
    """
    return 0.5 * len(chips) if len(runs_of(chips)) == 2 else 1.0


def chips_if_longer(chips: ByteArray) -> tuple[int, int]:
    """Return how many chips may be one, and by how many each bright run is too long for that.

    Rising edges lie on a lattice of such chips, and falling edges on another; (1, 0) where they do
    not. A single pulse is of any such length.
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
