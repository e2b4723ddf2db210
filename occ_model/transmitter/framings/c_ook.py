"""C-OOK, camera on-off keying of IEEE 802.15.7-2018 (PHY V), with sub-packets.

A sub-packet is a preamble that no payload contains, followed by line-coded bits: asynchronous bits,
a part of the payload, and the same asynchronous bits again. If the picture's edges cut every
sub-packet, one is joined from the start at the last edge and the end at the first, if their
asynchronous bits agree. The standard has one asynchronous bit, which changes from packet to packet;
here these bits number the sub-packets of a long payload, so that a single picture shows their
order. A payload of up to 16 bits is one sub-packet.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.transmitter.framings.framing import (
    Framed,
    FrameFormat,
    Framing,
    binary_digits,
    find_preambles,
    number_of,
    own_preamble,
)

_PART_BITS = 16  # maximum bits of the payload in a sub-packet: two characters


@dataclass(frozen=True, slots=True)
class _SubPacketLayout:
    parts: int
    part_bits: int
    asynchronous: int  # number of asynchronous bits before, and again after, each part

    @classmethod
    def of(cls, bits: int) -> "_SubPacketLayout":
        parts = -(-bits // _PART_BITS)
        return cls(parts, -(-bits // parts), max(1, (parts - 1).bit_length()))

    @property
    def bits(self) -> int:
        return self.part_bits + 2 * self.asynchronous


def count_sub_packets(bits: int) -> int:
    """Count the sub-packets of a payload; all are equally long."""
    return _SubPacketLayout.of(bits).parts


def read_sub_packet(chips: ByteArray, form: FrameFormat) -> tuple[int, ByteArray, str | None]:
    """Read a sub-packet's number and payload bits from its preamble on, and state any problem."""
    preamble, layout = own_preamble(form.line_code), _SubPacketLayout.of(form.bits)
    if not np.array_equal(chips[: len(preamble)], preamble):
        return 0, chips[:0], "A sub-packet does not start with its preamble."
    data = chips[len(preamble) : len(preamble) + form.line_code.chips_for(layout.bits)]
    decoded = form.line_code.decode(data, int(preamble[-1]))
    number, problem = _check_number(decoded.bits, layout)
    start = layout.asynchronous
    part = decoded.bits[start : start + layout.part_bits]
    bits_left = form.bits - number * layout.part_bits
    return number, part[: max(bits_left, 0)], decoded.failure or problem


def read_numbers_beside(
    chips: ByteArray, preamble_at: int, form: FrameFormat
) -> tuple[int | None, int | None]:
    """Read the numbers of the sub-packets after and before a preamble; None if unknown."""
    code, preamble = form.line_code, own_preamble(form.line_code)
    layout = _SubPacketLayout.of(form.bits)
    if layout.parts == 1:
        return 0, 0
    # Only whole blocks of the line code can be read; the last one is padded.
    length = code.chips_for(layout.asynchronous)
    start = preamble_at + len(preamble)
    number_after = _read_number(chips[start : start + length], length, int(preamble[-1]), 0, form)
    bits = -(-layout.bits // code.block_bits) * code.block_bits
    number_start = layout.bits - layout.asynchronous
    first_block = number_start // code.block_bits
    block_start = preamble_at - code.chips_for(bits) + first_block * code.block_chips
    level = int(chips[block_start - 1]) if block_start > 0 else 0
    last_blocks = chips[max(block_start, 0) : preamble_at] if block_start > 0 else chips[:0]
    skipped = number_start - first_block * code.block_bits
    length = code.chips_for(bits) - first_block * code.block_chips
    return number_after, _read_number(last_blocks, length, level, skipped, form)


def _read_number(
    chips: ByteArray, length: int, level: int, skipped: int, form: FrameFormat
) -> int | None:
    """Read a number from some blocks of chips, after a number of ``skipped`` bits."""
    layout = _SubPacketLayout.of(form.bits)
    if len(chips) < length:
        return None
    decoded = form.line_code.decode(chips, level)
    bits = decoded.bits[skipped : skipped + layout.asynchronous]
    if decoded.failure is not None or len(bits) < layout.asynchronous:
        return None
    number = number_of(bits)
    return number if number < layout.parts else None


def _encode(bits: ByteArray, form: FrameFormat) -> ByteArray:
    preamble, layout = own_preamble(form.line_code), _SubPacketLayout.of(len(bits))
    padding = layout.parts * layout.part_bits - len(bits)
    parts = np.pad(np.asarray(bits, dtype=np.uint8), (0, padding))
    pieces = []
    for part_number, part in enumerate(parts.reshape(layout.parts, -1)):
        number_bits = binary_digits(part_number, layout.asynchronous)
        data = np.concatenate([number_bits, part, number_bits])
        pieces += [preamble, form.line_code.encode(data, int(preamble[-1]))]
    return np.concatenate(pieces)


def _decode(chips: ByteArray, form: FrameFormat) -> Framed:
    preamble, layout = own_preamble(form.line_code), _SubPacketLayout.of(form.bits)
    headers = find_preambles(chips, preamble)
    length = form.line_code.chips_for(layout.bits)
    parts: dict[int, ByteArray] = {}
    failure = None
    for data in _join_sub_packets(chips, headers, len(preamble), length):
        decoded = form.line_code.decode(data, int(preamble[-1]))
        number, problem = _check_number(decoded.bits, layout)
        problem = decoded.failure or problem
        part = decoded.bits[layout.asynchronous : layout.asynchronous + layout.part_bits]
        if problem is None and not np.array_equal(parts.setdefault(number, part), part):
            problem = (
                f"Two sub-packets {number + 1} differ: some chips were misread, or another payload "
                "follows."
            )
        failure = failure or problem
    missing = [place for place in range(layout.parts) if place not in parts]
    if missing:
        reason = failure or _too_few_chips(len(headers), len(chips), len(preamble) + length)
        if parts:
            reason = (
                f"{len(parts)} of {layout.parts} sub-packets were read; the first missing is "
                f"number {missing[0] + 1}. {reason}"
            )
        return Framed.nothing(reason, headers)
    bits = np.concatenate([parts[place] for place in range(layout.parts)])
    if failure is None and bits[form.bits :].any():
        failure = (
            "The bits that fill the last sub-packet are not 0: some chips were misread, or another "
            "number of bits is sent."
        )
    return Framed(headers, bits[: form.bits], failure)


def _join_sub_packets(
    chips: ByteArray, headers: tuple[int, ...], preamble: int, length: int
) -> list[ByteArray]:
    """Return the whole sub-packets; if there are none, join one from both edges of the picture."""
    starts = [header + preamble for header in headers]
    whole = [chips[start : start + length] for start in starts if start + length <= len(chips)]
    if whole or not headers:
        return whole
    start = chips[starts[-1] :]
    missing = length - len(start)
    if missing > headers[0]:
        return []
    return [np.concatenate([start, chips[headers[0] - missing : headers[0]]])]


def _check_number(bits: ByteArray, layout: _SubPacketLayout) -> tuple[int, str | None]:
    first, last = bits[: layout.asynchronous], bits[layout.bits - layout.asynchronous :]
    last = last[: layout.asynchronous]
    if not np.array_equal(first, last):
        return 0, "The asynchronous bits at a sub-packet's start and end differ."
    if bits[layout.bits :].any():
        return 0, "The bits that fill a sub-packet's last block are not 0."
    number = number_of(first)
    if number >= layout.parts:
        return 0, f"A sub-packet has the number {number + 1} of {layout.parts}."
    return number, None


def _too_few_chips(headers: int, chips: int, sub_packet: int) -> str:
    preambles = f"{headers} preambles" if headers != 1 else "One preamble"
    return (
        f"{preambles} and no whole sub-packet, which has {sub_packet} chips, among {chips} chips."
    )


FRAMING = Framing(
    "c-ook",
    "C-OOK of IEEE 802.15.7: preamble and sub-packets",
    checks=False,
    encode=_encode,
    decode=_decode,
)
