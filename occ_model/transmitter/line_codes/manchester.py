"""Manchester by the convention of IEEE 802.15.7: 0 is sent as 0 1, and 1 as 1 0."""

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.transmitter.line_codes.differential_manchester import describe_missing_transitions
from occ_model.transmitter.line_codes.line_code import Decoded, LineCode, refuse_partial_block


def _encode(bits: ByteArray, _level: int) -> ByteArray:
    bits = np.asarray(bits, dtype=np.uint8)
    return np.stack([bits, 1 - bits], axis=-1).reshape(-1)


def _decode(chips: ByteArray, _level: int) -> Decoded:
    if len(chips) % 2:
        return refuse_partial_block(len(chips), 2)
    bits, second = chips[0::2], chips[1::2]
    violations = np.flatnonzero(bits == second).tolist()
    return Decoded(
        bits.copy(), tuple(violations), describe_missing_transitions(violations, len(bits))
    )


LINE_CODE = LineCode(
    "manchester",
    "Manchester (IEEE 802.15.7)",
    block_bits=1,
    block_chips=2,
    longest_run=2,
    disparity=0,
    finds_wrong_chip=True,
    encode=_encode,
    decode=_decode,
)
