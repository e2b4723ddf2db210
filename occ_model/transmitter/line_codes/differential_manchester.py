"""Differential Manchester, the paper's line code, by the convention of IEEE 802.5.

Every bit is two chips with a transition between them. A bit 0 also has a transition at its start, a
bit 1 has none. A run of equal chips is therefore never longer than two.
"""

import numpy as np
from numpy.typing import ArrayLike

from occ_model.arrays import ByteArray
from occ_model.transmitter.line_codes.line_code import Decoded, LineCode, refuse_partial_block


def encode(bits: ArrayLike, level: int = 0) -> ByteArray:
    """Turn bits, shape (..., bits), into twice as many chips; ``level`` is the chip before."""
    # A bit 0 has two transitions, which leave the level unchanged; a bit 1 inverts it.
    second = np.bitwise_xor.accumulate(np.asarray(bits, dtype=np.uint8), axis=-1) ^ np.uint8(level)
    chips = np.stack([1 - second, second], axis=-1)
    return chips.reshape(*second.shape[:-1], 2 * second.shape[-1])


def decode(chips: ByteArray, level: int = 0) -> tuple[ByteArray, list[int]]:
    """Return the bits of chips, and the indices of bits without a transition in their middle."""
    first = chips[0::2]
    second = chips[1::2]
    previous = np.concatenate([[np.uint8(level)], second[:-1]])
    bits = (first == previous).astype(np.uint8)
    return bits, np.flatnonzero(first == second).tolist()


def describe_missing_transitions(violations: list[int], bits: int) -> str | None:
    """Describe the failure of bits without a transition in their middle; None if there are none."""
    if not violations:
        return None
    return (
        f"Bit {violations[0] + 1} of {bits} has no transition in its middle: "
        f"{len(violations)} of {bits} bits break the line code."
    )


def _decode(chips: ByteArray, level: int) -> Decoded:
    if len(chips) % 2:
        return refuse_partial_block(len(chips), 2)
    bits, violations = decode(chips, level)
    return Decoded(bits, tuple(violations), describe_missing_transitions(violations, len(bits)))


LINE_CODE = LineCode(
    "differential-manchester",
    "Differential Manchester (IEEE 802.5, the paper's)",
    block_bits=1,
    block_chips=2,
    longest_run=2,
    disparity=0,
    finds_wrong_chip=True,
    encode=encode,
    decode=_decode,
)
