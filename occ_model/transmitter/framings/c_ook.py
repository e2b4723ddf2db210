"""C-OOK, camera on-off keying of IEEE 802.15.7-2018 (PHY V), with sub-packets.

A sub-packet is a preamble, asynchronous bits, a part of the payload, and the asynchronous bits once
more, line-coded. The preamble is one that no payload contains. A sub-packet that is cut
by the picture's edges is joined from its start at one edge and its end at the other, where the
asynchronous bits of both agree. The standard has one asynchronous bit, which changes from one
packet to the next; here they count the sub-packets of a longer payload, so that their order is
known in a picture as well. A payload up to 16 bits is one sub-packet.
"""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.transmitter.framings.framing import (
    Framed,
    FrameFormat,
    Framing,
    find_preambles,
    own_preamble,
)

_PART_BITS = 16  # most bits of the payload in a sub-packet: two characters


@dataclass(frozen=True, slots=True)
class _Division:
    parts: int
    part_bits: int
    asynchronous: int  # asynchronous bits before and after each part

    @classmethod
    def of(cls, bits: int) -> "_Division":
        parts = -(-bits // _PART_BITS)
        return cls(parts, -(-bits // parts), max(1, (parts - 1).bit_length()))

    @property
    def bits(self) -> int:
        return self.part_bits + 2 * self.asynchronous

    def number(self, part: int) -> ByteArray:
        places = reversed(range(self.asynchronous))
        return np.array([part >> place & 1 for place in places], dtype=np.uint8)


def sub_packets(bits: int) -> int:
    """Return the number of sub-packets of a payload; all have as many chips."""
    return _Division.of(bits).parts


def read_sub_packet(chips: ByteArray, form: FrameFormat) -> tuple[int, ByteArray, str | None]:
    """Read the number and payload bits of a sub-packet from its preamble on, or a problem."""
    preamble, division = own_preamble(form.line_code), _Division.of(form.bits)
    if not np.array_equal(chips[: len(preamble)], preamble):
        return 0, chips[:0], "A sub-packet does not start with its preamble."
    data = chips[len(preamble) : len(preamble) + form.line_code.chips_for(division.bits)]
    read = form.line_code.decode(data, int(preamble[-1]))
    number, problem = _number(read.bits, division)
    first = division.asynchronous
    part = read.bits[first : first + division.part_bits]
    left = form.bits - number * division.part_bits
    return number, part[: max(left, 0)], read.failure or problem


def number_beside(
    chips: ByteArray, preamble_at: int, form: FrameFormat
) -> tuple[int | None, int | None]:
    """Return the numbers of the sub-packets that a preamble starts and ends, None where unknown."""
    code, preamble = form.line_code, own_preamble(form.line_code)
    division = _Division.of(form.bits)
    if division.parts == 1:
        return 0, 0
    # The last bits are filled up to a whole block: only whole blocks can be read.
    length = code.chips_for(division.asynchronous)
    start = preamble_at + len(preamble)
    after = _own_number(chips[start : start + length], length, int(preamble[-1]), 0, form)
    bits = -(-division.bits // code.block_bits) * code.block_bits
    within = division.bits - division.asynchronous
    first_block = within // code.block_bits
    begin = preamble_at - code.chips_for(bits) + first_block * code.block_chips
    level = int(chips[begin - 1]) if begin > 0 else 0
    part = chips[max(begin, 0) : preamble_at] if begin > 0 else chips[:0]
    skipped = within - first_block * code.block_bits
    length = code.chips_for(bits) - first_block * code.block_chips
    return after, _own_number(part, length, level, skipped, form)


def _own_number(
    chips: ByteArray, length: int, level: int, skipped: int, form: FrameFormat
) -> int | None:
    """Read a number from some blocks of chips, behind some bits that are skipped."""
    division = _Division.of(form.bits)
    if len(chips) < length:
        return None
    read = form.line_code.decode(chips, level)
    bits = read.bits[skipped : skipped + division.asynchronous]
    if read.failure is not None or len(bits) < division.asynchronous:
        return None
    number = int("".join(map(str, bits.tolist())), 2)
    return number if number < division.parts else None


def _encode(bits: ByteArray, form: FrameFormat) -> ByteArray:
    preamble, division = own_preamble(form.line_code), _Division.of(len(bits))
    missing = division.parts * division.part_bits - len(bits)
    parts = np.pad(np.asarray(bits, dtype=np.uint8), (0, missing))
    sent = []
    for place, part in enumerate(parts.reshape(division.parts, -1)):
        number = division.number(place)
        data = np.concatenate([number, part, number])
        sent += [preamble, form.line_code.encode(data, int(preamble[-1]))]
    return np.concatenate(sent)


def _decode(chips: ByteArray, form: FrameFormat) -> Framed:
    preamble, division = own_preamble(form.line_code), _Division.of(form.bits)
    headers = find_preambles(chips, preamble)
    length = form.line_code.chips_for(division.bits)
    parts: dict[int, ByteArray] = {}
    failure = None
    for data in _sub_packets(chips, headers, len(preamble), length):
        read = form.line_code.decode(data, int(preamble[-1]))
        number, problem = _number(read.bits, division)
        problem = read.failure or problem
        part = read.bits[division.asynchronous : division.asynchronous + division.part_bits]
        if problem is None and not np.array_equal(parts.setdefault(number, part), part):
            problem = f"Two sub-packets {number + 1} differ: some chips were misread."
        failure = failure or problem
    missing = [place for place in range(division.parts) if place not in parts]
    if missing:
        reason = failure or _too_few(len(headers), len(chips), len(preamble) + length)
        if parts:
            reason = (
                f"{len(parts)} of {division.parts} sub-packets were read; the first missing is "
                f"number {missing[0] + 1}. {reason}"
            )
        return Framed.nothing(reason, headers)
    bits = np.concatenate([parts[place] for place in range(division.parts)])
    if failure is None and bits[form.bits :].any():
        failure = "The bits that fill the last sub-packet are not 0: some chips were misread."
    return Framed(headers, bits[: form.bits], failure)


def _sub_packets(
    chips: ByteArray, headers: tuple[int, ...], preamble: int, length: int
) -> list[ByteArray]:
    """Return the chips of the whole sub-packets, or those joined from both edges of the picture."""
    starts = [header + preamble for header in headers]
    whole = [chips[start : start + length] for start in starts if start + length <= len(chips)]
    if whole or not headers:
        return whole
    start = chips[starts[-1] :]
    missing = length - len(start)
    if missing > headers[0]:
        return []
    return [np.concatenate([start, chips[headers[0] - missing : headers[0]]])]


def _number(bits: ByteArray, division: _Division) -> tuple[int, str | None]:
    first, last = bits[: division.asynchronous], bits[division.bits - division.asynchronous :]
    last = last[: division.asynchronous]
    if not np.array_equal(first, last):
        return 0, "The asynchronous bits at a sub-packet's start and end differ."
    if bits[division.bits :].any():
        return 0, "The bits that fill a sub-packet's last block are not 0."
    number = int("".join(map(str, first.tolist())), 2)
    if number >= division.parts:
        return 0, f"A sub-packet has the number {number + 1} of {division.parts}."
    return number, None


def _too_few(headers: int, chips: int, sub_packet: int) -> str:
    found = f"{headers} preambles" if headers != 1 else "One preamble"
    return (
        f"{found} and no whole sub-packet, which has {sub_packet} chips, among {chips} chips; come "
        "closer or raise the frequency."
    )


FRAMING = Framing(
    "c-ook",
    "C-OOK of IEEE 802.15.7: preamble and sub-packets",
    checks=False,
    encode=_encode,
    decode=_decode,
)
