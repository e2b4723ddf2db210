"""Error correction by a Reed-Solomon code over GF(256), by the package ``reedsolo``."""

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import ParameterError

if TYPE_CHECKING:  # an optional package
    from reedsolo import RSCodec

PARITY_BYTES = 4  # bytes added to each block; half as many wrong bytes can be corrected
_BLOCK_BYTES = 255 - PARITY_BYTES  # maximum bytes of the payload in a block


def count_protected_bits(bits: int) -> int:
    octets = -(-bits // 8)
    return 8 * (octets + PARITY_BYTES * -(-octets // _BLOCK_BYTES))


def protect(bits: ByteArray) -> ByteArray:
    """Pad a payload with zeros to whole bytes, and add the parity."""
    protected = _codec().encode(bytearray(np.packbits(bits).tobytes()))
    return np.unpackbits(np.frombuffer(bytes(protected), dtype=np.uint8))


def correct(bits: ByteArray, count: int) -> ByteArray | None:
    """Correct a payload of ``count`` bits by its parity; None if too many bytes are wrong."""
    codec = _codec()
    from reedsolo import ReedSolomonError

    try:
        decoded, _, _ = codec.decode(bytearray(np.packbits(bits).tobytes()))
    except ReedSolomonError:
        return None
    payload = np.unpackbits(np.frombuffer(bytes(decoded), dtype=np.uint8))
    # The padding of the last byte must be 0.
    return None if payload[count:].any() else payload[:count]


@lru_cache(maxsize=1)
def _codec() -> "RSCodec":
    try:
        from reedsolo import RSCodec
    except ImportError:
        raise ParameterError(
            "error_correction is 'reed-solomon', which needs the package reedsolo; install it with "
            "pip install 'occ-explorer[ecc]'.",
            parameters=("error_correction",),
        ) from None
    return RSCodec(PARITY_BYTES)
