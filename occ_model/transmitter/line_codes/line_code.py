"""The interface of a line code, and block codes given by a table with a word for each number."""

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from occ_model.arrays import ByteArray

VISIBLE_LIMIT = 200.0
"""Frequency in Hz below which people may see flicker.

IEEE 802.15.7-2018, 4.4.3.1: light that changes within the maximum flickering time period of 5 ms is
generally considered safe.
"""


def _no_bits() -> ByteArray:
    return np.empty(0, dtype=np.uint8)


@dataclass(frozen=True, eq=False, slots=True)
class Decoded:
    """The bits read from chips.

    Parameters
    ----------
    bits : ndarray of uint8
        The bits in the order sent, with the padding of the last block. Where chips break the code,
        these are the likeliest bits; empty if the number of chips breaks it.
    violations
        Indices of the bits at which the chips break the code.
    failure
        None, or a sentence that says where the chips break the code.
    """

    bits: ByteArray = field(default_factory=_no_bits)
    violations: tuple[int, ...] = ()
    failure: str | None = None


@dataclass(frozen=True, slots=True)
class LineCode:
    """A rule that turns bits into chips, with the properties that it guarantees.

    A code works in blocks: ``block_bits`` bits become ``block_chips`` chips. The last block is
    padded with zeros.

    Parameters
    ----------
    name
        The identifier, as in a scene file.
    block_bits, block_chips
        Bits and chips of a block.
    longest_run
        Maximum number of equal consecutive chips in any payload; None if there is no limit.
    disparity
        Largest difference between the numbers of ones and zeros in any payload; None if there is no
        limit. With 0 all payloads are equally bright.
    finds_wrong_chip
        Whether any single wrong chip of any payload is detected or harmless.
    encode
        Turns bits, shape (bits,), into chips; its second argument is the chip before the first.
    decode
        Turns chips, shape (chips,), into a :class:`Decoded`; its second argument is the same chip.
    preamble
        Chips that start a frame and that no payload contains, as a text; if empty, a run of ones
        that is longer than the longest run.
    """

    name: str
    title: str
    block_bits: int
    block_chips: int
    longest_run: int | None
    disparity: int | None
    finds_wrong_chip: bool
    encode: Callable[[ByteArray, int], ByteArray]
    decode: Callable[[ByteArray, int], Decoded]
    preamble: str = ""

    @property
    def chips_a_bit(self) -> Fraction:
        """Chips sent for each bit of a whole block."""
        return Fraction(self.block_chips, self.block_bits)

    @property
    def overhead(self) -> Fraction:
        """Fraction of the chips that carry no bit."""
        return 1 - 1 / self.chips_a_bit

    def chips_for(self, bits: int) -> int:
        """Count the chips for a number of bits, with the padding of the last block."""
        return -(-bits // self.block_bits) * self.block_chips

    @property
    def least_switching_frequency(self) -> float | None:
        """Switching frequency in Hz above which no run of chips lasts long enough to be seen.

        None if runs have no limit. See :data:`VISIBLE_LIMIT`.
        """
        return None if self.longest_run is None else VISIBLE_LIMIT * 2 * self.longest_run


def pad_bits(bits: ByteArray, block: int) -> ByteArray:
    """Pad bits with zeros to whole blocks, shape (blocks, block)."""
    missing = -len(bits) % block
    return np.pad(np.asarray(bits, dtype=np.uint8), (0, missing)).reshape(-1, block)


def read_numbers(blocks: ByteArray) -> ByteArray:
    """Read each row of up to eight bits, the most significant first, as a number."""
    places = np.arange(blocks.shape[1])[::-1]
    return np.asarray((blocks.astype(np.int64) << places).sum(axis=1), dtype=np.uint8)


def refuse_partial_block(count: int, block: int) -> Decoded:
    return Decoded(failure=f"{count} chips are not a whole number of blocks of {block} chips.")


@dataclass(frozen=True, eq=False, slots=True)
class WordTable:
    words: ByteArray  # Shape (2 ** bits, chips): the word of each number
    noun: str  # The name of a word in a sentence, such as "4B6B word"
    corrected: int = 0  # Number of wrong chips in a word that can be corrected with certainty

    def encode(self, bits: ByteArray, _level: int) -> ByteArray:
        """Turn bits into words; the last block is padded with zeros."""
        return self.words[read_numbers(pad_bits(bits, self._bits))].reshape(-1)

    def decode(self, chips: ByteArray, _level: int) -> Decoded:
        """Read each word as the nearest one of the table, by the number of chips that differ."""
        length = self.words.shape[1]
        if len(chips) % length:
            return refuse_partial_block(len(chips), length)
        received = chips.reshape(-1, 1, length)
        distance = (received != self.words).sum(axis=2)
        nearest = distance.argmin(axis=1)
        places = np.arange(self._bits)[::-1]
        bits = (nearest[:, None] >> places & 1).astype(np.uint8).reshape(-1)
        wrong_words = np.flatnonzero(distance.min(axis=1, initial=length) > self.corrected)
        if not wrong_words.size:
            return Decoded(bits)
        first = int(wrong_words[0])
        failure = (
            f"Chips {first * length + 1} to {(first + 1) * length} are not a {self.noun}: "
            f"{wrong_words.size} of {len(received)} words break the line code."
        )
        return Decoded(bits, tuple((wrong_words * self._bits).tolist()), failure)

    @property
    def _bits(self) -> int:
        return len(self.words).bit_length() - 1
