"""NRZ (non-return-to-zero): each bit is a chip. Runs and brightness are not limited."""

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.transmitter.line_codes.line_code import Decoded, LineCode


def _encode(bits: ByteArray, _level: int) -> ByteArray:
    return np.array(bits, dtype=np.uint8)


def _decode(chips: ByteArray, _level: int) -> Decoded:
    return Decoded(np.array(chips, dtype=np.uint8))


LINE_CODE = LineCode(
    "nrz",
    "NRZ: a bit is a chip",
    block_bits=1,
    block_chips=1,
    longest_run=None,
    disparity=None,
    finds_wrong_chip=False,
    encode=_encode,
    decode=_decode,
)
