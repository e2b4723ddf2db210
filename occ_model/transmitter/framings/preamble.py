"""A given preamble, and the line-coded payload after it, sent over and over."""

from collections.abc import Callable, Iterator

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import counted
from occ_model.transmitter.framings.framing import (
    Framed,
    FrameFormat,
    Framing,
    find_preambles,
    is_unique,
    preamble_of,
)


def _encode(bits: ByteArray, form: FrameFormat) -> ByteArray:
    preamble = preamble_of(form)
    return np.concatenate([preamble, form.line_code.encode(bits, int(preamble[-1]))])


def _decode(chips: ByteArray, form: FrameFormat) -> Framed:
    return read_repeated(chips, preamble_of(form), form.bits, form, read_after)


def read_after(data: ByteArray, level: int, form: FrameFormat) -> Framed:
    """Read a payload of known length from the chips after a preamble, whose last is ``level``."""
    read = form.line_code.decode(data[: form.line_code.chips_for(form.bits)], level)
    bits, padding = read.bits[: form.bits], read.bits[form.bits :]
    failure = read.failure
    if failure is None and padding.any():
        failure = "The bits that fill the last block are not 0: some chips were misread."
    return Framed((), bits, failure)


FRAMING = Framing(
    "preamble",
    "A preamble, then the payload",
    checks=False,
    encode=_encode,
    decode=_decode,
)


_MAX_WHOLE_FRAMES = 32  # places of a preamble behind all of which the whole frame is read

_CHECKED_CHIPS = 120  # chips behind preambles that must obey the line code: blocks of 2, 6, 10, 12
# Reads the chips behind a preamble, at least a period; given also the preamble's last chip
ReadData = Callable[[ByteArray, int, FrameFormat], Framed]


def read_repeated(
    chips: ByteArray, preamble: ByteArray, bits: int, form: FrameFormat, read: ReadData
) -> Framed:
    """Read the frame that chips show: a preamble, and some line-coded bits.

    First each preamble with a whole frame after it is tried, then each one with the frame's end
    before it: what is sent repeats. Where a payload may contain the preamble, all are tried.
    """
    length = len(preamble) + form.line_code.chips_for(bits)
    headers = find_preambles(chips, preamble)
    unique = is_unique(preamble, form.line_code)
    if len(chips) < length:
        return Framed.nothing(too_few(len(chips), length), headers)
    failed: list[Framed] = []
    found: dict[bytes, Framed] = {}
    for wrapped, data in _candidates(chips, preamble, length, form):
        if wrapped and unique and found:
            break
        one = read(data, int(preamble[-1]), form)
        if one.failure is None:
            found[one.bits.tobytes()] = one
        else:
            failed.append(one)
    if len(found) == 1:
        (one,) = found.values()
        return Framed(headers, one.bits)
    if found:
        return Framed.nothing(_ambiguous(len(found)), headers)
    if failed:
        return Framed(headers, failed[0].bits, failed[0].failure)
    return Framed.nothing(
        f"No preamble found among {counted(len(chips), 'chip')}, of which a frame has {length}.",
        headers,
    )


def _candidates(
    chips: ByteArray, preamble: ByteArray, length: int, form: FrameFormat
) -> Iterator[tuple[bool, ByteArray]]:
    """Return what follows each preamble, each content once, and whether it is joined of two parts.

    Of very many preambles only those count behind which the line code is obeyed.
    """
    headers = find_preambles(chips, preamble)
    many = len(headers) > _MAX_WHOLE_FRAMES
    tried: set[bytes] = set()
    frames = (_whole(chips, preamble, length, headers), _wrapped(chips, preamble, length))
    for wrapped, datas in enumerate(frames):
        for data in datas:
            content = data[: length - len(preamble)].tobytes()
            is_new = content not in tried
            tried.add(content)
            if is_new and (not many or _obeys(data[:_CHECKED_CHIPS], preamble, form)):
                yield bool(wrapped), data


def _obeys(chips: ByteArray, preamble: ByteArray, form: FrameFormat) -> bool:
    """Whether the first chips behind a preamble obey the line code."""
    whole = len(chips) - len(chips) % form.line_code.block_chips
    return form.line_code.decode(chips[:whole], int(preamble[-1])).failure is None


def _whole(
    chips: ByteArray, preamble: ByteArray, length: int, headers: tuple[int, ...]
) -> Iterator[ByteArray]:
    """Return what follows each preamble, where a whole period does."""
    for header in headers:
        if header + length <= len(chips):
            yield chips[header + len(preamble) :]


def _wrapped(chips: ByteArray, preamble: ByteArray, length: int) -> Iterator[ByteArray]:
    """Return what follows each preamble in one period, its end joined to its start."""
    # The first and the last chip may be cut off.
    inner = chips[1:-1] if len(chips) >= length + 2 else chips
    period = inner[:length]
    twice = np.concatenate([period, period])
    for header in find_preambles(twice[: length + len(preamble) - 1], preamble):
        yield twice[header + len(preamble) : header + length]


def too_few(chips: int, length: int) -> str:
    """Return the failure that less than one period is seen."""
    return (
        f"Less than one packet: {chips} of {length} chips fit the panel's image; come closer, "
        "raise the frequency or send fewer bits."
    )


def _ambiguous(payloads: int) -> str:
    return (
        f"The payload contains the preamble, and {payloads} payloads fit the chips; choose a "
        "preamble that it does not contain, or the framing raw, which checks the payload."
    )
