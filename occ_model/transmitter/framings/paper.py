"""The paper's framing: the header 1 1 1 0, and the line-coded payload up to the next header."""

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import inflect
from occ_model.transmitter.framings.framing import Framed, FrameFormat, Framing
from occ_model.transmitter.framings.preamble import read_after, read_repeated
from occ_model.transmitter.line_codes.line_code import LineCode

HEADER = (1, 1, 1, 0)
"""The header: three ones, which never occur in data with runs of at most two, and a zero.

The paper names only the three ones. Without the zero, the code 0 and the code with only its first
bit set would send the same endless chip sequence.
"""

HEADER_ONES = sum(HEADER)


def _encode(bits: ByteArray, form: FrameFormat) -> ByteArray:
    data = form.line_code.encode(bits, HEADER[-1])
    return np.concatenate([np.array(HEADER, dtype=np.uint8), data])


def is_header_unique(line_code: LineCode) -> bool:
    """Return whether no data contain a header's ones, so that two headers bound a packet."""
    return line_code.longest_run is not None and line_code.longest_run < HEADER_ONES


def find_headers(chips: ByteArray) -> tuple[int, ...]:
    """Find where headers start: at the last three ones of every run of three or more."""
    edges = np.diff(np.concatenate([[0], chips.astype(np.int8), [0]]))
    starts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return tuple((ends[ends - starts >= HEADER_ONES] - HEADER_ONES).tolist())


def _decode(chips: ByteArray, form: FrameFormat) -> Framed:
    """Read the packet between the first two headers; try all headers if data can contain one."""
    length = len(HEADER) + form.line_code.chips_for(form.bits)
    if not is_header_unique(form.line_code):
        return read_repeated(chips, np.array(HEADER, dtype=np.uint8), form.bits, form, read_after)
    headers = find_headers(chips)
    if len(headers) < 2:
        headers_text = "One header" if headers else "No header"
        chips_text = inflect(len(chips), "chip")
        return Framed.nothing(f"{headers_text} found among {chips_text}, two needed.", headers)
    first, second = headers[:2]
    if second - first != length:
        return Framed.nothing(
            f"The first two headers are {inflect(second - first, 'chip')} apart, a packet of "
            f"{inflect(form.bits, 'bit')} has {length}: some chips were misread, or packets of "
            "another length are sent.",
            headers,
        )
    framed = read_after(chips[first + len(HEADER) : second], HEADER[-1], form)
    return Framed(headers, framed.bits, framed.failure)


FRAMING = Framing(
    "paper", "The paper's header 1 1 1 0", checks=False, encode=_encode, decode=_decode
)
