"""A scheme: line code, framing and error correction together, from bits to chips and back."""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike

from occ_model.arrays import ByteArray
from occ_model.scene.scene import Transmitter
from occ_model.transmitter import error_correction
from occ_model.transmitter.framings.framing import Framed, FrameFormat, Framing
from occ_model.transmitter.framings.paper import is_header_unique
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
        """Whether it is the paper's: differential Manchester after the header 1 1 1 0."""
        return (self.line_code.name, self.framing.name, self.correction) == _PAPER_SCHEME

    @property
    def takes_any_chips(self) -> bool:
        """Whether any chips after the header 1 1 1 0 are a payload, as no rule refuses them."""
        paper = self.framing.name == _PAPER_SCHEME[1]
        return paper and self.line_code.longest_run is None

    @property
    def ends_by_header(self) -> bool:
        """Whether a packet is read from a header to the next one, which no data contain."""
        return self.framing.name == _PAPER_SCHEME[1] and is_header_unique(self.line_code)

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
            Line code and framing do not go together, or a package is missing.
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
            With ``bits`` bits, or with a sentence that says why not.
        """
        read = self.framing.decode(chips, self.form)
        if self.correction == "none" or len(read.bits) != self.form.bits:
            return read
        payload = error_correction.correct(read.bits, self.bits)
        failure = read.failure if self.framing.checks else None
        if payload is None:
            failure = (
                f"More than {error_correction.PARITY_BYTES // 2} bytes of a block are wrong: the "
                "error correction cannot tell which."
            )
        if payload is None or failure is not None:
            payload = read.bits[: self.bits]
        return Framed(read.headers, payload, failure)

    @cached_property
    def form(self) -> FrameFormat:
        """What the framing gets: line code, preamble, bits in a frame, and their correction."""
        bits = self.bits
        if self.correction != "none":
            bits = error_correction.count_protected_bits(bits)
        return FrameFormat(self.line_code, self.preamble, bits, self._correct_frame)

    def _correct_frame(self, bits: ByteArray) -> ByteArray:
        """Correct the bits of a frame by the error correction, if there is one and it can."""
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
