"""A scheme (line code, framing and error correction) and the packet of chips that it sends."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from occ_model.arrays import ByteArray, IndexArray
from occ_model.errors import ParameterError
from occ_model.scene.light_words import PICTURE_ONLY
from occ_model.scene.scene import Scene, Transmitter
from occ_model.transmitter import error_correction
from occ_model.transmitter.framings.framing import Framed, FrameFormat, Framing
from occ_model.transmitter.framings.paper import HEADER, is_header_unique
from occ_model.transmitter.line_codes import differential_manchester
from occ_model.transmitter.line_codes.line_code import LineCode
from occ_model.transmitter.registry import FRAMINGS, LINE_CODES

_PAPER_SCHEME = ("differential-manchester", "paper", "none")


@dataclass(frozen=True)
class Scheme:
    """Turns payloads of one length into chips and back.

    Parameters
    ----------
    line_code, framing
        Its parts.
    preamble
        Chips that start a frame, as a text; if empty, the line code's own.
    correction
        ``"none"`` or ``"reed-solomon"``.
    """

    line_code: LineCode
    framing: Framing
    preamble: str
    correction: str
    bits: int

    @property
    def is_papers(self) -> bool:
        """Whether it is the paper's scheme: differential Manchester after the header 1 1 1 0."""
        return (self.line_code.name, self.framing.name, self.correction) == _PAPER_SCHEME

    @property
    def takes_any_chips(self) -> bool:
        """Whether any chips after the header 1 1 1 0 are a payload, as no rule refuses them."""
        return self.framing.name == "paper" and self.line_code.longest_run is None

    @property
    def ends_by_header(self) -> bool:
        """Whether a packet is read from a header to the next one, which no data contain."""
        return self.framing.name == "paper" and is_header_unique(self.line_code)

    @property
    def finds_wrong_chip(self) -> bool:
        """Whether any single wrong chip of a payload is detected or harmless."""
        return self.framing.checks or self.line_code.finds_wrong_chip

    @cached_property
    def length(self) -> int:
        """Number of chips of one period, the same for all payloads."""
        return len(self.encode(np.zeros(self.bits, dtype=np.uint8)))

    def encode(self, bits: ArrayLike) -> ByteArray:
        """Turn a payload into one period of the chips sent.

        Parameters
        ----------
        bits : array_like of int, shape (bits,)
            The payload.

        Returns
        -------
        ndarray of uint8, shape (length,)

        Raises
        ------
        ParameterError
            Line code and framing cannot be combined, or a package is missing.
        PluginError
            A plug-in fails.
        """
        payload = np.asarray(bits, dtype=np.uint8)
        if self.correction != "none":
            payload = error_correction.protect(payload)
        return self.framing.encode(payload, self.form)

    def decode(self, chips: ByteArray) -> Framed:
        """Read the payload from the chips of any part of what is sent repeatedly.

        Parameters
        ----------
        chips : ndarray of uint8
            The chips in the order sent.

        Returns
        -------
        Framed
            With ``bits`` bits, or with a sentence that states why not.
        """
        framed = self.framing.decode(chips, self.form)
        if self.correction == "none" or len(framed.bits) != self.form.bits:
            return framed
        payload = error_correction.correct(framed.bits, self.bits)
        failure = framed.failure if self.framing.checks else None
        if payload is None:
            failure = (
                f"More than {error_correction.PARITY_BYTES // 2} bytes of a block are wrong: the "
                "error correction cannot tell which."
            )
        if payload is None or failure is not None:
            payload = framed.bits[: self.bits]
        return Framed(framed.headers, payload, failure)

    @cached_property
    def form(self) -> FrameFormat:
        """The format given to the framing: line code, preamble, bits in a frame, correction."""
        bits = self.bits
        if self.correction != "none":
            bits = error_correction.count_protected_bits(bits)
        return FrameFormat(self.line_code, self.preamble, bits, self._correct_frame)

    def _correct_frame(self, bits: ByteArray) -> ByteArray:
        """Correct the bits of a frame by the error correction, if possible; else return them."""
        if self.correction == "none" or len(bits) != self.form.bits:
            return bits
        payload = error_correction.correct(bits, self.bits)
        return bits if payload is None else error_correction.protect(payload)


def scheme_of(transmitter: Transmitter) -> Scheme:
    """Return the scheme of a transmitter; it depends only on the payload's length.

    Raises
    ------
    ParameterError
        There is no such line code or framing.
    PluginError
        One is a plug-in that cannot be used.
    """
    return scheme_named(
        transmitter.line_code,
        transmitter.framing,
        transmitter.preamble,
        transmitter.error_correction,
        transmitter.payload_length,
    )


@lru_cache(maxsize=256)
def scheme_named(line_code: str, framing: str, preamble: str, correction: str, bits: int) -> Scheme:
    """Return the scheme with these names for payloads of some bits; errors as :func:`scheme_of`."""
    return Scheme(LINE_CODES.get(line_code), FRAMINGS.get(framing), preamble, correction, bits)


def bits_of(code: int, bits: int) -> tuple[int, ...]:
    """Write a code as bits, the most significant first."""
    return tuple(code >> place & 1 for place in reversed(range(bits)))


def code_of(bits: Iterable[int]) -> int:
    """Read bits, the most significant first, as a code."""
    code = 0
    for bit in bits:
        code = code << 1 | int(bit)
    return code


def packet_length(bits: int) -> int:
    """Count the chips of a packet of the paper's scheme."""
    return len(HEADER) + 2 * bits


def check_code(transmitter: Transmitter, instead: str = PICTURE_ONLY) -> None:
    """Refuse a light that is no code; ``instead`` says what to ask of it."""
    if transmitter.light != "code":
        raise ParameterError.of(
            "light", transmitter.light, f"code; of this light, {instead}",
            condition="where chips are sent or read", parameters=("light",),
        )  # fmt: skip


def sent_chips(transmitter: Transmitter) -> ByteArray:
    """Return one period of the chips sent, a raw pattern or a packet; read-only.

    Raises
    ------
    ParameterError
        Another light than a code is sent.
    """
    check_code(transmitter)
    if transmitter.pattern:
        return _pattern_chips(transmitter.pattern)
    return _payload_chips(scheme_of(transmitter), transmitter.payload_bits)


@lru_cache(maxsize=64)
def _pattern_chips(pattern: str) -> ByteArray:
    chips = np.frombuffer(pattern.encode("ascii"), dtype=np.uint8) - np.uint8(ord("0"))
    chips.flags.writeable = False
    return chips


@lru_cache(maxsize=256)
def _payload_chips(scheme: Scheme, bits: tuple[int, ...]) -> ByteArray:
    chips = scheme.encode(bits)
    chips.flags.writeable = False
    return chips


def sends_paper_code(transmitter: Transmitter) -> bool:
    """Return whether a code is sent by the paper's scheme, not a pattern or a payload."""
    return not (transmitter.pattern or transmitter.payload) and scheme_of(transmitter).is_papers


def shortest_period(chips: NDArray[Any]) -> int:
    """Return the number of chips, or levels, after which a repeated sequence first repeats."""
    count = len(chips)
    divisors = (number for number in range(1, count + 1) if count % number == 0)
    return next(number for number in divisors if np.array_equal(np.roll(chips, number), chips))


def packets_of_codes(codes: IndexArray, bits: int) -> ByteArray:
    """Return the packets of some codes in the paper's scheme, shape (codes, chips)."""
    places = np.arange(bits)[::-1]
    data = differential_manchester.encode(codes[:, None] >> places & 1, level=HEADER[-1])
    header = np.broadcast_to(np.array(HEADER, dtype=np.uint8), (len(codes), len(HEADER)))
    return np.concatenate([header, data], axis=1)


def packet(scene: Scene) -> ByteArray:
    """Return one period of the chips that a scene's transmitter sends.

    Returns
    -------
    ndarray of uint8, shape (chips,), read-only
        For the paper's scheme these are the header 1 1 1 0 and two chips a bit; for a raw pattern
        they are the pattern.

    Raises
    ------
    ParameterError
        The scene's light is no code.
    """
    return sent_chips(scene.transmitter)
