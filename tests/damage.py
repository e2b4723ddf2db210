"""Ways to damage the bytes of a file, whatever they mean."""

import struct
from collections.abc import Callable

from numpy.random import Generator


def cut(rng: Generator, content: bytearray) -> bytearray:
    return content[: rng.integers(1, len(content))]


def flip(rng: Generator, content: bytearray) -> bytearray:
    for place in rng.integers(len(content), size=rng.integers(1, 9)):
        content[place] ^= 1 << rng.integers(8)
    return content


def flip_in_the_header(rng: Generator, content: bytearray) -> bytearray:
    for place in rng.integers(min(len(content), 120), size=rng.integers(1, 5)):
        content[place] = rng.integers(256)
    return content


def insert_a_run(rng: Generator, content: bytearray) -> bytearray:
    place, length = int(rng.integers(len(content))), int(rng.integers(1, 3000))
    run = rng.bytes(length) if rng.integers(2) else bytes([int(rng.integers(256))]) * length
    return content[:place] + run + content[place:]


def drop_a_run(rng: Generator, content: bytearray) -> bytearray:
    place = rng.integers(len(content))
    return content[:place] + content[place + rng.integers(1, 200) :]


def wrong_number(rng: Generator, content: bytearray) -> bytearray:
    """Write numbers at the edge of what fits over some of the first bytes."""
    for _ in range(rng.integers(1, 4)):
        place = int(rng.integers(2, min(len(content), 400) - 4))
        number = int(rng.choice([0, 1, 0x7F, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF]))
        struct.pack_into("<I" if rng.integers(2) else ">I", content, place, number)
    return content


def only_the_magic(rng: Generator, content: bytearray) -> bytearray:
    return content[: rng.integers(4, 40)] + rng.bytes(int(rng.integers(1, 2000)))


WAYS: tuple[Callable[[Generator, bytearray], bytearray], ...] = (
    cut, flip, flip_in_the_header, insert_a_run, drop_a_run, wrong_number, only_the_magic,
)  # fmt: skip


def damage_bytes(rng: Generator, content: bytes) -> bytes:
    """Damage a file of some hundred bytes or more in one random way."""
    return bytes(WAYS[rng.integers(len(WAYS))](rng, bytearray(content)))
