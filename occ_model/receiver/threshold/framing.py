"""Framing: find headers among the chips, and read the bits between two of them."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.transmitter import line_code
from occ_model.transmitter.packet import HEADER, code_of, packet_length

_HEADER_ONES = sum(HEADER)


@dataclass(frozen=True, slots=True)
class Framed:
    """The result of framing: headers, bits, and either a code or the reason for its absence."""

    headers: tuple[int, ...]
    bits: ByteArray
    code: int | None = None
    failure: str | None = None


def find_headers(chips: ByteArray) -> tuple[int, ...]:
    """Find where headers start: the last three ones of every run of three or more.

    A run of ones may be one longer than the header, when the data before it end in a one.
    """
    edges = np.diff(np.concatenate([[0], chips.astype(np.int8), [0]]))
    starts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return tuple((ends[ends - starts >= _HEADER_ONES] - _HEADER_ONES).tolist())


def read_packet(chips: ByteArray, bits: int) -> Framed:
    """Read the packet between the first two headers.

    Parameters
    ----------
    chips : ndarray of uint8
        The chips, first sent first.
    bits
        How many bits a code has.

    Returns
    -------
    Framed
    """
    headers = find_headers(chips)
    none = np.empty(0, dtype=np.uint8)
    length = packet_length(bits)
    if len(headers) < 2:
        return Framed(headers, none, failure=_too_few(len(headers), len(chips), length))
    first, second = headers[:2]
    if second - first != length:
        return Framed(
            headers,
            none,
            failure=f"The first two headers are {second - first} chips apart, a packet of "
            f"{bits} bits has {length}: some chips were misread.",
        )
    data = chips[first + len(HEADER) : second]
    read, violations = line_code.decode(data, level=HEADER[-1])
    if violations:
        return Framed(
            headers,
            read,
            failure=f"Bit {violations[0] + 1} of {bits} has no transition in its middle: "
            f"{len(violations)} of {bits} bits break the line code.",
        )
    return Framed(headers, read, code=code_of(read))


def _too_few(headers: int, chips: int, packet: int) -> str:
    found = "One header" if headers else "No header"
    if chips < 2 * packet:
        return (
            f"{found} found, two needed: {chips} of {2 * packet} chips fit the panel's image; "
            "come closer or raise the frequency."
        )
    return (
        f"{found} found among {chips} chips, two needed: the stripes show no runs as long as a "
        "header's."
    )
