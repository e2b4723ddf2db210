"""The interface of a framing."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import ParameterError
from occ_model.transmitter.line_codes.line_code import LineCode

BARKER = (1, 1, 1, 1, 1, 0, 0, 1, 1, 0, 1, 0, 1)
"""Barker code of 13 chips: the preamble of a line code that limits no run.

Its autocorrelation is at most 1 beside the peak of 13 (R. H. Barker, 1953).
"""


@dataclass(frozen=True, eq=False, slots=True)
class Framed:
    """What a framing reads from chips.

    Parameters
    ----------
    headers
        Where headers start among the chips.
    bits : ndarray of uint8
        The bits read, empty where none were. They can be present with a failure, when the chips
        break the line code or a check.
    failure
        None, or a sentence that says why no payload was read.
    """

    headers: tuple[int, ...]
    bits: ByteArray
    failure: str | None = None

    @classmethod
    def nothing(cls, failure: str, headers: tuple[int, ...] = ()) -> "Framed":
        """Make a result without bits."""
        return cls(headers, np.empty(0, dtype=np.uint8), failure)


@dataclass(frozen=True, slots=True)
class FrameFormat:
    """What transmitter and receiver have agreed on.

    Parameters
    ----------
    line_code
        The line code.
    preamble
        Chips that start a frame, as a text; empty: the line code's own.
    bits
        Number of bits that a framing carries.
    correct
        What the error correction makes of bits that were read, for a framing to check; bits that it
        cannot correct come back as they are.
    """

    line_code: LineCode
    preamble: str
    bits: int
    correct: Callable[[ByteArray], ByteArray]


@dataclass(frozen=True, slots=True)
class Framing:
    """A rule by which chips show where a payload starts.

    Parameters
    ----------
    name
        The identifier, as in a scene file.
    checks
        Whether it checks the payload itself, whatever the line code finds; its failure then stands,
        so that ``decode`` corrects the bits by :attr:`FrameFormat.correct` before it checks them.
    encode
        Turns bits into one period of the chips sent, which is sent repeatedly.
    decode
        Turns chips, of any part of what is sent, into a :class:`Framed`.
    """

    name: str
    title: str
    checks: bool
    encode: Callable[[ByteArray, FrameFormat], ByteArray]
    decode: Callable[[ByteArray, FrameFormat], Framed]


def own_preamble(line_code: LineCode) -> ByteArray:
    """Return a line code's own preamble, which no payload contains.

    It is the one declared, or a run longer than any of the code. With a longest run of n that is
    n + 1 ones between as many zeros, so it is balanced: of Manchester 0 111 00 and of 4B6B
    00 11111 000, which are those of C-OOK in IEEE 802.15.7-2018.
    """
    if line_code.preamble:
        return _chips_of(line_code.preamble)
    if line_code.longest_run is None:
        raise ParameterError.of(
            "line_code",
            f"'{line_code.name}', which limits no run: no preamble differs from all its payloads",
            "a line code with a longest run",
            condition="with this framing",
            parameters=("line_code", "framing"),
        )
    ones = line_code.longest_run + 1
    before = ones // 2
    return np.repeat(np.array([0, 1, 0], dtype=np.uint8), [before, ones, ones - before])


def preamble_of(form: FrameFormat) -> ByteArray:
    """Return the given preamble, else the line code's own."""
    if form.preamble:
        return _chips_of(form.preamble)
    if form.line_code.longest_run is None and not form.line_code.preamble:
        return np.array(BARKER, dtype=np.uint8)
    return own_preamble(form.line_code)


def _chips_of(text: str) -> ByteArray:
    return np.array([int(chip) for chip in text], dtype=np.uint8)


def is_unique(preamble: ByteArray, line_code: LineCode) -> bool:
    """Whether no payload contains a preamble: the code's own, or one with too long a run inside."""
    if line_code.preamble and np.array_equal(preamble, _chips_of(line_code.preamble)):
        return True
    if line_code.longest_run is None:
        return False
    edges = np.flatnonzero(np.diff(preamble.astype(np.int8)))
    return bool((np.diff(edges) > line_code.longest_run).any())


def find_preambles(chips: ByteArray, preamble: ByteArray) -> tuple[int, ...]:
    count = len(chips) - len(preamble) + 1
    if count < 1:
        return ()
    fits = np.ones(count, dtype=bool)
    for place, chip in enumerate(preamble.tolist()):
        fits &= chips[place : place + count] == chip
    return tuple(np.flatnonzero(fits).tolist())
