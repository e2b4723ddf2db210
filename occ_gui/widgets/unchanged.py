"""Comparison of drawn values, to avoid painting, which takes longer than comparing."""

from collections.abc import Sequence

import numpy as np


def are_same(ones: Sequence[object], others: Sequence[object]) -> bool:
    """Return whether two lists of values are equal, with arrays compared element by element."""
    return len(ones) == len(others) and all(map(_is_same, ones, others))


def _is_same(one: object, other: object) -> bool:
    if one is other:
        return True
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return bool(np.array_equal(one, other))
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return False
    return one == other
