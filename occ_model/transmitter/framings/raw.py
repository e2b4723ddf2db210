"""A raw frame: preamble, number of bits, payload and a check sum.

The number of bits takes one byte up to 127, else two bytes with the first bit set. The check sum is
CRC-16/IBM-3740 (CCITT-FALSE) of the number of bits and the payload, bit by bit as they are sent. It
detects any error confined to 16 consecutive bits after the number of bits, and all but 1 in 65,536
of the others. A receiver needs to know only the preamble and the line code.
"""

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import inflect
from occ_model.transmitter.framings.framing import (
    Framed,
    FrameFormat,
    Framing,
    binary_digits,
    number_of,
    preamble_of,
)
from occ_model.transmitter.framings.preamble import read_repeated

_CRC_BITS = 16
_POLYNOMIAL = 0x1021  # x^16 + x^12 + x^5 + 1, of ITU-T V.41
_START = 0xFFFF
_SHORT_LENGTH_BITS = 8
_LONG_LENGTH_BITS = 16


def _encode(bits: ByteArray, form: FrameFormat) -> ByteArray:
    preamble = preamble_of(form)
    body = np.concatenate([_length_field(len(bits)), np.asarray(bits, dtype=np.uint8)])
    frame = np.concatenate([body, check_sum(body)])
    return np.concatenate([preamble, form.line_code.encode(frame, int(preamble[-1]))])


def count_length_bits(bits: int) -> int:
    """Return the length in bits of the field that states a payload's number of bits."""
    return len(_length_field(bits))


def _length_field(bits: int) -> ByteArray:
    if bits < 1 << _SHORT_LENGTH_BITS - 1:
        return binary_digits(bits, _SHORT_LENGTH_BITS)
    return binary_digits(bits | 1 << _LONG_LENGTH_BITS - 1, _LONG_LENGTH_BITS)


def check_sum(body: ByteArray) -> ByteArray:
    """Return the CRC-16/IBM-3740 of any number of bits; libraries take only whole bytes."""
    remainder = _START
    for bit in body.tolist():
        is_divided = remainder >> _CRC_BITS - 1 ^ bit
        remainder = remainder << 1 & 0xFFFF
        if is_divided:
            remainder ^= _POLYNOMIAL
    return binary_digits(remainder, _CRC_BITS)


def _decode(chips: ByteArray, form: FrameFormat) -> Framed:
    bits = len(_length_field(form.bits)) + form.bits + _CRC_BITS
    return read_repeated(chips, preamble_of(form), bits, form, _read_frame)


def _read_frame(data: ByteArray, level: int, form: FrameFormat) -> Framed:
    """Read the frame at the start of the chips, whose length it states."""
    code = form.line_code
    length_field = code.decode(data[: code.chips_for(_LONG_LENGTH_BITS)], level).bits
    if len(length_field) < _LONG_LENGTH_BITS:
        return Framed.nothing("The frame ends inside its number of bits.")
    is_long = bool(length_field[0])
    start = _LONG_LENGTH_BITS if is_long else _SHORT_LENGTH_BITS
    count = number_of(length_field[is_long:start])
    frame_bits = start + count + _CRC_BITS
    if code.chips_for(frame_bits) > len(data):
        return Framed.nothing(
            f"The frame states a length of {inflect(count, 'bit')}, for which {len(data)} chips "
            "are too few: some chips were misread, or a longer frame is sent."
        )
    decoded = code.decode(data[: code.chips_for(frame_bits)], level).bits
    body, stated_check_sum = decoded[: start + count], decoded[start + count : frame_bits]
    bits = form.correct(body[start:])
    if not np.array_equal(check_sum(np.concatenate([body[:start], bits])), stated_check_sum):
        return Framed((), bits, "The check sum (CRC-16) does not match: some chips were misread.")
    return Framed((), bits)


FRAMING = Framing(
    "raw",
    "Preamble, number of bits, payload, CRC-16",
    checks=True,
    encode=_encode,
    decode=_decode,
)
