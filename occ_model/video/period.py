"""The repeated period of the chips sent: its length, its parts, and places of headers in it."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from occ_model.arrays import ByteArray, IndexArray
from occ_model.scene.scene import Transmitter
from occ_model.transmitter.framings import c_ook
from occ_model.transmitter.framings.framing import (
    FrameFormat,
    find_preambles,
    is_unique,
    own_preamble,
    preamble_of,
)
from occ_model.transmitter.framings.paper import (
    FRAMING as PAPER,
    HEADER,
    find_headers,
    is_header_unique,
)
from occ_model.transmitter.framings.preamble import FRAMING as PREAMBLE
from occ_model.transmitter.framings.raw import FRAMING as RAW
from occ_model.transmitter.scheme import Scheme, scheme_of, sent_chips, shortest_period

_MIN_PREAMBLE_CHIPS = 10  # minimum length of a preamble that a payload rarely contains by chance
_SAMPLES = 8  # number of payloads compared to find the chips that are the same in all


@dataclass(frozen=True)
class SentPeriod:
    """One period of the chips sent, as far as a receiver knows it before reading."""

    # Only its scheme and number of bits are used, not its payload; a raw pattern is used completely
    transmitter: Transmitter

    @cached_property
    def scheme(self) -> Scheme | None:
        """The scheme; None for a raw pattern."""
        return None if self.transmitter.pattern else scheme_of(self.transmitter)

    @cached_property
    def pattern(self) -> ByteArray | None:
        """The chips of a raw pattern's shortest period; None for anything else."""
        if not self.transmitter.pattern:
            return None
        chips = sent_chips(self.transmitter)
        return chips[: shortest_period(chips)]

    @cached_property
    def length(self) -> int:
        if self.pattern is not None:
            return len(self.pattern)
        assert self.scheme is not None  # noqa: S101 - it is no pattern
        return self.scheme.length

    @cached_property
    def parts(self) -> int:
        """Number of equal parts that can each be read alone: the sub-packets, or 1."""
        if self.scheme is None or self.scheme.framing.name != c_ook.FRAMING.name:
            return 1
        return c_ook.count_sub_packets(self.scheme.form.bits)

    @property
    def part_length(self) -> int:
        return self.length // self.parts

    @cached_property
    def known(self) -> IndexArray:
        """The chips that do not depend on the payload: 1 for lit, -1 for dark, 0 if unknown."""
        known = np.zeros(self.length, dtype=np.int64)
        if self.pattern is not None:
            return np.where(self.pattern == 1, 1, -1)
        if self.parts > 1:
            assert self.scheme is not None  # noqa: S101 - a pattern has one part
            preamble = own_preamble(self.scheme.form.line_code)
            starts = np.arange(self.parts)[:, None] * self.part_length
            known[starts + np.arange(len(preamble))] = np.where(preamble == 1, 1, -1)
            return known
        header = np.array(self.header, dtype=np.int64)
        known[: len(header)] = np.where(header == 1, 1, -1)
        return known

    @cached_property
    def header(self) -> tuple[int, ...]:
        """The chips at the start of every period that do not depend on the payload."""
        if self.scheme is None:
            return ()
        random = np.random.default_rng(1)
        payloads = random.integers(0, 2, (_SAMPLES, self.scheme.bits), dtype=np.uint8)
        payloads[:2] = [[0], [1]]
        periods = np.array([self.scheme.encode(payload) for payload in payloads])
        is_same = (periods == periods[0]).all(axis=0)
        return tuple(periods[0][: int(np.argmin(is_same))].tolist())

    @cached_property
    def _preamble(self) -> ByteArray | None:
        """The chips that the framing puts before the line-coded bits; None if not at one place."""
        if self.scheme is None:
            return None
        if self.scheme.framing.name == PAPER.name:
            return np.array(HEADER, dtype=np.uint8)
        has_preamble = self.scheme.framing.name in (PREAMBLE.name, RAW.name)
        return preamble_of(self.scheme.form) if has_preamble else None

    @property
    def data_start(self) -> int | None:
        """The chip at which the line-coded bits start; None if the framing has no such place."""
        return None if self._preamble is None else len(self._preamble)

    def places(self, chips: ByteArray) -> tuple[int, ...]:
        """Return the places of a frame's first chip in the period that its headers allow.

        One place if a header determines it, several if it may be any of them, and none if no header
        is in view or headers contradict each other. All ``chips`` must be whole.
        """
        if self.scheme is None:
            return ()
        if self.scheme.framing.name == c_ook.FRAMING.name:
            return self._places_of_sub_packets(chips, self.scheme.form)
        return self._places_of_headers(chips, self.scheme)

    def _places_of_headers(self, chips: ByteArray, scheme: Scheme) -> tuple[int, ...]:
        headers: tuple[int, ...] = ()
        if scheme.framing.name == PAPER.name:
            if is_header_unique(scheme.line_code):
                headers = find_headers(chips)
            # A run of ones at the end of the view may continue beyond it.
            headers = tuple(header for header in headers if header + len(HEADER) <= len(chips))
        elif self._preamble is not None:
            is_long = len(self._preamble) >= _MIN_PREAMBLE_CHIPS
            if is_long or is_unique(self._preamble, scheme.line_code):
                headers = find_preambles(chips, self._preamble)
        places = {-header % self.length for header in headers}
        return tuple(places) if len(places) == 1 else ()

    def _places_of_sub_packets(self, chips: ByteArray, form: FrameFormat) -> tuple[int, ...]:
        length = self.part_length
        preambles = find_preambles(chips, own_preamble(form.line_code))
        if not preambles or len({preamble % length for preamble in preambles}) > 1:
            return ()
        places = set()
        for preamble in preambles:
            after, before = c_ook.read_numbers_beside(chips, preamble, form)
            if after is not None:
                places.add((after * length - preamble) % self.length)
            if before is not None:
                places.add(((before + 1) * length - preamble) % self.length)
        if places:
            return tuple(places) if len(places) == 1 else ()
        return tuple((part * length - preambles[0]) % self.length for part in range(self.parts))

    def read_part(self, chips: ByteArray) -> tuple[int, ByteArray] | None:
        """Read one part by itself; return its number and its bits, or None if it is not read."""
        if self.scheme is None:
            return None
        if self.parts > 1:
            number, bits, problem = c_ook.read_sub_packet(chips, self.scheme.form)
            return None if problem is not None else (number, bits)
        framed = self.scheme.decode(np.tile(chips, 3))
        if framed.failure is not None or len(framed.bits) != self.scheme.bits:
            return None
        return 0, framed.bits

    def slice_of_part(self, part: int) -> slice:
        """Return the slice of the framing's input bits that a part carries."""
        if self.scheme is None or self.parts == 1:
            return slice(None)
        bits = self.scheme.form.bits
        size = -(-bits // self.parts)
        return slice(part * size, min((part + 1) * size, bits))
