"""Read a frame that is sent repeatedly, from chips that show more than one period of it."""

from collections.abc import Callable, Iterator

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.transmitter.framings.framing import Framed, find_preambles

ReadData = Callable[[ByteArray], Framed]
"""Reads the chips after a preamble, to the end of a period or further."""


def read_repeated(
    chips: ByteArray, preamble: ByteArray, length: int, *, unique: bool, read: ReadData
) -> Framed:
    """Read the frame that chips show.

    First each preamble with a whole frame after it is tried, then each one with the frame's end
    before it: what is sent repeats. Where a payload may contain the preamble, all are tried.

    Parameters
    ----------
    chips : ndarray of uint8
        The chips, first sent first.
    preamble : ndarray of uint8
        The chips that start a frame.
    length
        Chips of a period.
    unique
        Whether no payload contains the preamble.
    read
        Reads what follows it.

    Returns
    -------
    Framed
    """
    headers = find_preambles(chips, preamble)
    if len(chips) < length:
        return Framed.nothing(too_few(len(chips), length), headers)
    failed: list[Framed] = []
    found: dict[bytes, Framed] = {}
    for frames in (_whole(chips, preamble, length, headers), _wrapped(chips, preamble, length)):
        for data in frames:
            one = read(data)
            if one.failure is None:
                found[one.bits.tobytes()] = one
            else:
                failed.append(one)
        if found and unique:
            break
    if len(found) == 1:
        (one,) = found.values()
        return Framed(headers, one.bits)
    if found:
        return Framed.nothing(_ambiguous(len(found)), headers)
    if failed:
        return Framed(headers, failed[0].bits, failed[0].failure)
    return Framed.nothing(
        f"No preamble found among {len(chips)} chips, of which a frame has {length}.", headers
    )


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
    """Say that less than one period is seen."""
    return (
        f"Less than one packet: {chips} of {length} chips fit the panel's image; come closer, "
        "raise the frequency or send fewer bits."
    )


def _ambiguous(payloads: int) -> str:
    return (
        f"The payload contains the preamble, and {payloads} payloads fit the chips; choose a "
        "preamble that it does not contain, or the framing raw, which checks the payload."
    )
