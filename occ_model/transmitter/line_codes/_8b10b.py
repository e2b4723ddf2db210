"""8B10B with running disparity.

The tables are those of A. X. Widmer and P. A. Franaszek, A DC-balanced, partitioned-block, 8B/10B
transmission code, IBM J. Res. Develop. 27:440 (1983), as in IEEE 802.3, clause 36. A byte HGFEDCBA
is sent as abcdei fghj: EDCBA as six chips, HGF as four. A word has as many ones as zeros, or two
more or two fewer; the running disparity, +1 or -1 between words, selects a word or its complement.
It is -1 before the first byte. Bits are grouped into bytes with the most significant first.
"""

from functools import lru_cache

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.transmitter.line_codes.line_code import (
    Decoded,
    LineCode,
    pad_bits,
    read_numbers,
    refuse_partial_block,
)

# For a running disparity of -1, by EDCBA and by HGF.
_SIX = tuple(
    f"{word:06b}"
    for word in (
        0b100111, 0b011101, 0b101101, 0b110001, 0b110101, 0b101001, 0b011001, 0b111000,
        0b111001, 0b100101, 0b010101, 0b110100, 0b001101, 0b101100, 0b011100, 0b010111,
        0b011011, 0b100011, 0b010011, 0b110010, 0b001011, 0b101010, 0b011010, 0b111010,
        0b110011, 0b100110, 0b010110, 0b110110, 0b001110, 0b101110, 0b011110, 0b101011,
    )
)  # fmt: skip
_FOUR = ("1011", "1001", "0101", "1100", "1101", "1010", "0110", "1110")

_ALTERNATE = "0111"  # for HGF = 111, if the usual word would end a run of five
_ALTERNATE_AFTER = {-1: (17, 18, 20), 1: (11, 13, 14)}  # EDCBA before it, by disparity
_COMPLEMENT = str.maketrans("01", "10")


def _disparity(word: str) -> int:
    return 2 * word.count("1") - len(word)


def _choose_form(word: str, disparity: int) -> str:
    """Choose a word or its complement, as the running disparity requires."""
    # Two balanced words also have two forms, to avoid long runs.
    has_two = _disparity(word) != 0 or word in ("111000", "1100")
    return word.translate(_COMPLEMENT) if has_two and disparity > 0 else word


def encode_byte(byte: int, disparity: int) -> tuple[str, int]:
    """Return the ten chips of a byte, and the running disparity (-1 or 1) after them."""
    low, high = byte & 31, byte >> 5
    six = _choose_form(_SIX[low], disparity)
    disparity += _disparity(six)
    is_alternate = high == 7 and low in _ALTERNATE_AFTER[disparity]
    four = _choose_form(_ALTERNATE if is_alternate else _FOUR[high], disparity)
    return six + four, disparity + _disparity(four)


@lru_cache(maxsize=1)
def _tabulate_words() -> tuple[ByteArray, ByteArray]:
    """Tabulate the words and the disparities after them, by disparity before (-1, 1) and byte."""
    encoded_bytes = [[encode_byte(byte, disparity) for byte in range(256)] for disparity in (-1, 1)]
    words = np.array(
        [[[*map(int, word)] for word, _ in row] for row in encoded_bytes], dtype=np.uint8
    )
    after = np.array([[int(end > 0) for _, end in row] for row in encoded_bytes], dtype=np.uint8)
    return words, after


def _encode(bits: ByteArray, _level: int) -> ByteArray:
    words, after = _tabulate_words()
    state, encoded = 0, []
    for byte in read_numbers(pad_bits(bits, 8)).tolist():
        encoded.append(words[state, byte])
        state = int(after[state, byte])
    return np.concatenate(encoded) if encoded else np.empty(0, dtype=np.uint8)


def _decode(chips: ByteArray, _level: int) -> Decoded:
    """Read each word as the nearest one for the present running disparity."""
    if len(chips) % 10:
        return refuse_partial_block(len(chips), 10)
    words, after = _tabulate_words()
    # The distance of every received word to that of every byte, for both disparities.
    received = chips.reshape(-1, 10).astype(np.int32)
    ones = words.astype(np.int32)
    distances = (
        received.sum(axis=1)[:, None, None]
        + ones.sum(axis=2)
        - 2 * np.tensordot(received, ones, axes=([1], [2]))
    )
    state, values, wrong_words = 0, [], []
    for index, distance in enumerate(distances):
        byte = int(distance[state].argmin())
        if distance[state, byte]:
            wrong_words.append(index)
            other_state = 1 - state
            # A word of the other disparity is valid by itself: an earlier error shows only here.
            if not distance[other_state].min():
                state, byte = other_state, int(distance[other_state].argmin())
        values.append(byte)
        state = int(after[state, byte])
    bits = np.unpackbits(np.array(values, dtype=np.uint8))
    if not wrong_words:
        return Decoded(bits)
    failure = (
        f"Word {wrong_words[0] + 1} of {len(received)} is not an 8B10B word of its running "
        f"disparity: {len(wrong_words)} of {len(received)} words break the line code."
    )
    return Decoded(bits, tuple(8 * index for index in wrong_words), failure)


LINE_CODE = LineCode(
    "8b10b",
    "8B10B with running disparity (IEEE 802.3)",
    block_bits=8,
    block_chips=10,
    longest_run=5,
    disparity=2,
    # An error may turn a balanced word into one of disparity 2 that no later word contradicts.
    finds_wrong_chip=False,
    encode=_encode,
    decode=_decode,
    # The control word K28.5 at a running disparity of +1: it has a comma, which data never contain,
    # and leaves the running disparity for the first byte.
    preamble="1100000101",
)
