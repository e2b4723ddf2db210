"""A given preamble and the line-coded payload, sent repeatedly."""

from collections.abc import Callable, Iterator

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import inflect
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
    """Read a payload of known length from the chips after a preamble that ends with ``level``."""
    decoded = form.line_code.decode(data[: form.line_code.chips_for(form.bits)], level)
    bits, padding = decoded.bits[: form.bits], decoded.bits[form.bits :]
    failure = decoded.failure
    if failure is None and padding.any():
        failure = (
            "The bits that fill the last block are not 0: some chips were misread, or another "
            "number of bits is sent."
        )
    return Framed((), bits, failure)


FRAMING = Framing(
    "preamble",
    "A preamble, then the payload",
    checks=False,
    encode=_encode,
    decode=_decode,
)


# Number of preambles above which the line code is checked before a whole frame is read
_MAX_WHOLE_FRAMES = 32

_CHECKED_CHIPS = 120  # number of chips that are then checked: whole blocks of 2, 6, 10 and 12
# Reads the chips after a preamble, at least one period, given the preamble's last chip
ReadData = Callable[[ByteArray, int, FrameFormat], Framed]


def read_repeated(
    chips: ByteArray, preamble: ByteArray, bits: int, form: FrameFormat, read_data: ReadData
) -> Framed:
    """Read the frame, a preamble and line-coded bits, from chips.

    Preambles followed by a whole frame are tried first; then, as the frame repeats, those whose
    frame continues before them. If a payload can contain the preamble, all are tried.
    """
    length = len(preamble) + form.line_code.chips_for(bits)
    headers = find_preambles(chips, preamble)
    is_preamble_unique = is_unique(preamble, form.line_code)
    if len(chips) < length:
        return Framed.nothing(
            f"Less than one packet: {inflect(len(chips), 'chip')} of its {length}.", headers
        )
    failures: list[Framed] = []
    payloads: dict[bytes, Framed] = {}
    for is_joined, data in _list_candidates(chips, preamble, length, form):
        if is_joined and is_preamble_unique and payloads:
            break
        frame = read_data(data, int(preamble[-1]), form)
        if frame.failure is None:
            payloads[frame.bits.tobytes()] = frame
        else:
            failures.append(frame)
    if len(payloads) == 1:
        (frame,) = payloads.values()
        return Framed(headers, frame.bits)
    if payloads:
        return Framed.nothing(_ambiguous_payloads(len(payloads)), headers)
    if failures:
        return Framed(headers, failures[0].bits, failures[0].failure)
    return Framed.nothing(
        f"No preamble found among {inflect(len(chips), 'chip')}, of which a frame has {length}.",
        headers,
    )


def _list_candidates(
    chips: ByteArray, preamble: ByteArray, length: int, form: FrameFormat
) -> Iterator[tuple[bool, ByteArray]]:
    """Yield whether the chips after a preamble are joined from two parts, and the distinct chips.

    Of very many preambles, only those followed by valid line code count.
    """
    headers = find_preambles(chips, preamble)
    has_many = len(headers) > _MAX_WHOLE_FRAMES
    contents: set[bytes] = set()
    whole = (chips[each + len(preamble) :] for each in headers if each + length <= len(chips))
    frames = whole, _join_frame_ends(chips, preamble, length)
    for is_joined, candidates in enumerate(frames):
        for data in candidates:
            content = data[: length - len(preamble)].tobytes()
            is_new = content not in contents
            contents.add(content)
            if is_new and (not has_many or _obeys_line_code(data[:_CHECKED_CHIPS], preamble, form)):
                yield bool(is_joined), data


def _obeys_line_code(chips: ByteArray, preamble: ByteArray, form: FrameFormat) -> bool:
    """Return whether the first chips after a preamble obey the line code."""
    whole = len(chips) - len(chips) % form.line_code.block_chips
    return form.line_code.decode(chips[:whole], int(preamble[-1])).failure is None


def _join_frame_ends(chips: ByteArray, preamble: ByteArray, length: int) -> Iterator[ByteArray]:
    """Yield the chips after each preamble in one period, whose end is joined to its start."""
    # The first and the last chip may be incomplete.
    inner = chips[1:-1] if len(chips) >= length + 2 else chips
    period = inner[:length]
    twice = np.concatenate([period, period])
    for header in find_preambles(twice[: length + len(preamble) - 1], preamble):
        yield twice[header + len(preamble) : header + length]


def _ambiguous_payloads(payloads: int) -> str:
    return (
        f"The payload contains the preamble, and {payloads} payloads fit the chips; choose a "
        "preamble that it does not contain, or the framing raw, which checks the payload."
    )
