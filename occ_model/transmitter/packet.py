"""The packet: the chips that are sent repeatedly, by the paper's scheme or any other."""

from collections.abc import Iterable
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from occ_model.arrays import ByteArray, IndexArray
from occ_model.errors import ParameterError
from occ_model.scene.light_words import PICTURE_ONLY
from occ_model.scene.scene import Scene, Transmitter
from occ_model.transmitter.framings.paper import HEADER
from occ_model.transmitter.line_codes import differential_manchester
from occ_model.transmitter.scheme import scheme_named, scheme_of


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
    """Count the chips of a packet of the paper's scheme."""
    return len(HEADER) + 2 * bits


def check_code(transmitter: Transmitter, instead: str = PICTURE_ONLY) -> None:
    """Refuse a light that is no code; ``instead`` says what to ask of it."""
    if transmitter.light != "code":
        raise ParameterError.of(
            "light", transmitter.light, f"code; of this light, {instead}",
            condition="where chips are sent or read", parameters=("light",),
        )  # fmt: skip


def sent_chips(transmitter: Transmitter) -> ByteArray:
    """Return one period of the chips sent, a raw pattern or a packet; read-only.

    Raises
    ------
    ParameterError
        Another light than a code is sent.
    """
    check_code(transmitter)
    if transmitter.pattern:
        return _pattern_chips(transmitter.pattern)
    return _payload_chips(
        transmitter.payload_bits,
        transmitter.line_code,
        transmitter.framing,
        transmitter.preamble,
        transmitter.error_correction,
    )


@lru_cache(maxsize=64)
def _pattern_chips(pattern: str) -> ByteArray:
    chips = np.frombuffer(pattern.encode("ascii"), dtype=np.uint8) - np.uint8(ord("0"))
    chips.flags.writeable = False
    return chips


@lru_cache(maxsize=256)
def _payload_chips(
    bits: tuple[int, ...], line_code: str, framing: str, preamble: str, correction: str
) -> ByteArray:
    chips = scheme_named(line_code, framing, preamble, correction, len(bits)).encode(bits)
    chips.flags.writeable = False
    return chips


def sends_paper_code(transmitter: Transmitter) -> bool:
    """Whether a code is sent by the paper's scheme, rather than a pattern or a payload."""
    return not (transmitter.pattern or transmitter.payload) and scheme_of(transmitter).is_papers


def shortest_period(chips: NDArray[Any]) -> int:
    """Return the number of chips, or levels, after which a repeated sequence first repeats."""
    count = len(chips)
    divisors = (number for number in range(1, count + 1) if count % number == 0)
    return next(number for number in divisors if np.array_equal(np.roll(chips, number), chips))


def packets_of_codes(codes: IndexArray, bits: int) -> ByteArray:
    """Return the packets of some codes in the paper's scheme, shape (codes, chips)."""
    places = np.arange(bits)[::-1]
    data = differential_manchester.encode(codes[:, None] >> places & 1, level=HEADER[-1])
    header = np.broadcast_to(np.array(HEADER, dtype=np.uint8), (len(codes), len(HEADER)))
    return np.concatenate([header, data], axis=1)


def packet(scene: Scene) -> ByteArray:
    """Return one period of the chips that a scene's transmitter sends.

    Returns
    -------
    ndarray of uint8, shape (chips,), read-only
        For the paper's scheme these are the header 1 1 1 0 and two chips a bit; for a raw pattern
        they are the pattern.

    Raises
    ------
    ParameterError
        The scene's light is no code.
    """
    return sent_chips(scene.transmitter)
