"""The interface of a framing."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray
from occ_model.errors import ParameterError
from occ_model.transmitter.line_codes.line_code import LineCode

BARKER = (1, 1, 1, 1, 1, 0, 0, 1, 1, 0, 1, 0, 1)
"""The Barker code of 13 chips: the preamble with a line code that does not limit runs.

Its autocorrelation has a peak of 13, and is at most 1 elsewhere (R. H. Barker, 1953).
"""


@dataclass(frozen=True, eq=False, slots=True)
class Framed:
    """What a framing reads from chips.

    Parameters
    ----------
    headers
        Indices of the chips at which headers start.
    bits : ndarray of uint8
        The bits read, empty if none. A result with a failure may contain bits, which break the line
        code or fail a check.
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
        Chips that start a frame, as a text of 0 and 1; if empty, the line code's own.
    bits
        Number of bits in a frame, with those of the error correction.
    correct
        Corrects bits that were read, before a framing checks them; bits that cannot be corrected
        are returned unchanged.
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
        Its identifier, as in a scene file.
    checks
        Whether it checks the payload itself, for example by a check sum. Its failure is then final,
        so ``decode`` must correct the bits with :attr:`FrameFormat.correct` before it checks them.
    encode
        Turns bits into chips, one period of what is sent repeatedly.
    decode
        Turns the chips of any part of what is sent into a :class:`Framed`.
    """

    name: str
    title: str
    checks: bool
    encode: Callable[[ByteArray, FrameFormat], ByteArray]
    decode: Callable[[ByteArray, FrameFormat], Framed]


def own_preamble(line_code: LineCode) -> ByteArray:
    """Return a line code's own preamble, which no payload contains.

    It is the declared one, or else a run of ones longer than any run of the code: for a longest run
    of n it has n + 1 ones between as many zeros, so that it is balanced. For Manchester this is 0
    111 00 and for 4B6B 00 11111 000, the preambles of C-OOK in IEEE 802.15.7-2018.
    """
    if line_code.preamble:
        return _chips_of(line_code.preamble)
    if line_code.longest_run is None:
        raise ParameterError.of(
            "line_code",
            f"'{line_code.name}', which does not limit runs: any preamble can occur in a payload",
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


def binary_digits(number: int, places: int) -> ByteArray:
    return np.array([number >> place & 1 for place in reversed(range(places))], dtype=np.uint8)


def number_of(bits: ByteArray) -> int:
    """Read bits, the most significant first, as a number."""
    return int("".join(map(str, bits.tolist())), 2)


def is_unique(preamble: ByteArray, line_code: LineCode) -> bool:
    """Return whether no payload contains a preamble: the code's own, or one with too long a run."""
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
    is_start = np.ones(count, dtype=bool)
    for offset, chip in enumerate(preamble.tolist()):
        is_start &= chips[offset : offset + count] == chip
    return tuple(np.flatnonzero(is_start).tolist())
