"""The line code: differential Manchester, in the convention of IEEE 802.5.

Every bit is two chips with a transition between them. A bit 0 has a transition at its start as
well, a bit 1 has none. A run of equal chips is therefore never longer than two.
"""

import numpy as np
from numpy.typing import ArrayLike

from occ_model.arrays import ByteArray


def encode(bits: ArrayLike, level: int = 0) -> ByteArray:
    """Turn bits into chips.

    Parameters
    ----------
    bits : array_like of int, shape (..., bits)
        The bits, first sent first.
    level
        The chip before the first one.

    Returns
    -------
    ndarray of uint8, shape (..., 2 x bits)
    """
    # A bit 0 has two transitions and so leaves the level as it was; a bit 1 inverts it.
    after = np.bitwise_xor.accumulate(np.asarray(bits, dtype=np.uint8), axis=-1) ^ np.uint8(level)
    chips = np.stack([1 - after, after], axis=-1)
    return chips.reshape(*after.shape[:-1], 2 * after.shape[-1])


def decode(chips: ByteArray, level: int = 0) -> tuple[ByteArray, list[int]]:
    """Turn chips back into bits.

    Parameters
    ----------
    chips : ndarray of uint8, shape (2 x bits,)
        The chips, first sent first.
    level
        The chip before the first one.

    Returns
    -------
    bits : ndarray of uint8, shape (bits,)
        1 where there is no transition at a bit's start.
    violations : list of int
        The bits that have no transition in their middle; their value in ``bits`` follows from their
        start alone.
    """
    first = chips[0::2]
    second = chips[1::2]
    before = np.concatenate([[np.uint8(level)], second[:-1]])
    bits = (first == before).astype(np.uint8)
    return bits, np.flatnonzero(first == second).tolist()
