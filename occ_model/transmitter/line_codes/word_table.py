"""A block code given by a table with one word of chips for each number."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.transmitter.line_codes.line_code import (
    Decoded,
    pad_bits,
    read_numbers,
    refuse_partial_block,
)


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
        seen = chips.reshape(-1, 1, length)
        distance = (seen != self.words).sum(axis=2)
        nearest = distance.argmin(axis=1)
        places = np.arange(self._bits)[::-1]
        bits = (nearest[:, None] >> places & 1).astype(np.uint8).reshape(-1)
        wrong = np.flatnonzero(distance.min(axis=1, initial=length) > self.corrected)
        if not wrong.size:
            return Decoded(bits)
        first = int(wrong[0])
        failure = (
            f"Chips {first * length + 1} to {(first + 1) * length} are not a {self.noun}: "
            f"{wrong.size} of {len(seen)} words break the line code."
        )
        return Decoded(bits, tuple((wrong * self._bits).tolist()), failure)

    @property
    def _bits(self) -> int:
        return len(self.words).bit_length() - 1


def parse_words(text: str) -> ByteArray:
    """Parse words of 0 and 1 that are separated by spaces, shape (words, chips)."""
    return np.array([[int(chip) for chip in word] for word in text.split()], dtype=np.uint8)
