"""The packet: a header and line-coded bits, sent repeatedly."""

from collections.abc import Iterable
from functools import lru_cache

import numpy as np

from occ_model.arrays import ByteArray, IndexArray
from occ_model.scene.scene import Scene, Transmitter
from occ_model.transmitter import line_code

HEADER = (1, 1, 1, 0)
"""The header: three ones, which no line-coded data contain, and a zero.

The paper names only the three ones. Without the zero the code 0 and the code with only its first
bit set would send the same endless chip sequence.
"""


def bits_of(code: int, bits: int) -> tuple[int, ...]:
    """Write a code as bits, the most significant first."""
    return tuple(code >> place & 1 for place in reversed(range(bits)))


def code_of(bits: Iterable[int]) -> int:
    """Read bits, the most significant first, as a code."""
    code = 0
    for bit in bits:
        code = code << 1 | int(bit)
    return code


def packet_length(bits: int) -> int:
    """Count the chips of a packet."""
    return len(HEADER) + 2 * bits


def sent_chips(transmitter: Transmitter) -> ByteArray:
    """Return one period of the chips sent: the raw pattern if there is one, else the packet.

    Returns
    -------
    ndarray of uint8, shape (chips,), read-only
    """
    return _sent_chips(transmitter.code, transmitter.bits, transmitter.pattern)


@lru_cache(maxsize=256)
def _sent_chips(code: int, bits: int, pattern: str) -> ByteArray:
    if pattern:
        chips = np.frombuffer(pattern.encode("ascii"), dtype=np.uint8) - np.uint8(ord("0"))
    else:
        chips = packets(np.array([code]), bits)[0]
    chips.flags.writeable = False
    return chips


def packets(codes: IndexArray, bits: int) -> ByteArray:
    """Return the packets of some codes.

    Returns
    -------
    ndarray of uint8, shape (codes, chips)
    """
    places = np.arange(bits)[::-1]
    data = line_code.encode(codes[:, None] >> places & 1, level=HEADER[-1])
    header = np.broadcast_to(np.array(HEADER, dtype=np.uint8), (len(codes), len(HEADER)))
    return np.concatenate([header, data], axis=1)


def packet(scene: Scene) -> ByteArray:
    """Return one period of the chips that a scene's transmitter sends.

    Returns
    -------
    ndarray of uint8, shape (chips,), read-only
        The header, a zero and two chips a bit; or the raw pattern where the scene has one.
    """
    return sent_chips(scene.transmitter)
