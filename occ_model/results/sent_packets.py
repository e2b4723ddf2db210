"""The packets that were sent during a film; only those that frames show are stored."""

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate, pairwise
from typing import overload

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray


@dataclass(frozen=True, eq=False, slots=True)
class PacketReading:
    """One packet, or sub-packet, that was sent during the film.

    Parameters
    ----------
    number
        Its number among those sent, from 0.
    part
        The number of its sub-packet, from 0; 0 if packets have no parts.
    time
        Its start in seconds by the film's clock.
    frame
        The frame that shows all of it; None if none does.
    seen
        Fraction of its chips, from 0 to 1, that are completely in any frame.
    bits : ndarray of uint8 or None
        The bits read from this packet alone; None if it was not read.
    wrong_bits
        Number of bits that differ from the payload joined from all packets; None if either was not
        read.
    """

    number: int
    part: int
    time: float
    frame: int | None
    seen: float
    bits: ByteArray | None
    wrong_bits: int | None

    @property
    def is_read(self) -> bool:
        """Whether one frame shows all of it, and it could be read."""
        return self.bits is not None

    @property
    def correct(self) -> bool | None:
        """Whether it agrees with the joined payload; None if either was not read."""
        return None if self.wrong_bits is None else self.wrong_bits == 0

    @property
    def is_right(self) -> bool:
        """Whether it was read, and is right as far as that is known."""
        return self.is_read and self.correct is not False


@dataclass(frozen=True, slots=True)
class FilmPart:
    """A part of a film without gaps in time, and the packets that were sent meanwhile."""

    # Its start by the film's clock, and its length, in seconds
    start: float
    duration: float
    count: int = 0
    # Seconds from ``start`` to the first packet, and from one packet to the next
    begin: float = 0.0
    step: float = 0.0
    first_part: int = 0  # The number of the first packet's sub-packet


@dataclass(frozen=True, eq=False)
class SentPackets(Sequence[PacketReading]):
    """The packets that were sent during a film, in the order of their numbers.

    Those that no frame shows are made on demand, since a film of hours has millions.
    """

    parts: tuple[FilmPart, ...] = ()
    in_view: tuple[PacketReading, ...] = ()  # The packets with chips in frames, in order
    sub_packets: int = 1

    @cached_property
    def _firsts(self) -> list[int]:
        """Number of each part's first packet, and the number of all packets."""
        return list(accumulate((part.count for part in self.parts), initial=0))

    @cached_property
    def _numbers(self) -> list[int]:
        return [packet.number for packet in self.in_view]

    @cached_property
    def _elapsed(self) -> list[float]:
        """Seconds of film before each part, and of all parts."""
        return list(accumulate((part.duration for part in self.parts), initial=0.0))

    def __len__(self) -> int:
        return self._firsts[-1]

    @overload
    def __getitem__(self, number: int) -> PacketReading: ...

    @overload
    def __getitem__(self, number: slice) -> tuple[PacketReading, ...]: ...

    def __getitem__(self, number: int | slice) -> PacketReading | tuple[PacketReading, ...]:
        if isinstance(number, slice):
            return tuple(self[one] for one in range(len(self))[number])
        number = range(len(self))[number]
        place = bisect_left(self._numbers, number)
        if place < len(self.in_view) and self._numbers[place] == number:
            return self.in_view[place]
        index = bisect_right(self._firsts[1:], number)
        part, later = self.parts[index], number - self._firsts[index]
        return PacketReading(
            number=number,
            part=(part.first_part + later) % self.sub_packets,
            time=part.start + part.begin + later * part.step,
            frame=None,
            seen=0.0,
            bits=None,
            wrong_bits=None,
        )

    def cut(self, edges: FloatArray) -> tuple[tuple[int, tuple[PacketReading, ...]], ...]:
        """Divide the packets into windows by the film's running time at their start.

        ``edges`` are increasing times in seconds, without the gaps between the film's parts, and
        enclose all packets. Return the number sent, and the packets in view, for each window.
        """
        bounds = [0, *(self._count_before(edge) for edge in edges[1:-1].tolist()), len(self)]
        found = []
        for first, end in pairwise(bounds):
            here = slice(bisect_left(self._numbers, first), bisect_left(self._numbers, end))
            found.append((max(end - first, 0), self.in_view[here]))
        return tuple(found)

    def time_at(self, elapsed: float, is_end: bool = False) -> float:
        """Return the film's time after a running time in seconds, which leaves out gaps.

        At a cut it is the start of the next part, or with ``is_end`` the end of the part before.
        """
        search = bisect_left if is_end else bisect_right
        place = min(max(search(self._elapsed, elapsed) - 1, 0), len(self.parts) - 1)
        return self.parts[place].start + elapsed - self._elapsed[place]

    def _count_before(self, elapsed: float) -> int:
        """Count the packets that began before a running time of the film."""
        before = 0
        for part, at in zip(self.parts, self._elapsed, strict=False):
            if part.step > 0.0:
                later = math.ceil((elapsed - at - part.begin) / part.step)
                before += min(max(later, 0), part.count)
            elif elapsed > at:
                before += part.count
        return before

    def starts(self, numbers: IndexArray) -> FloatArray:
        """Return the start times of packets in seconds, by the film's clock."""
        index = self._part_of(numbers)
        begins = np.array([part.start + part.begin for part in self.parts])
        later = numbers - np.array(self._firsts, dtype=np.int64)[index]
        return np.asarray(begins[index] + later * self.steps(numbers))

    def steps(self, numbers: IndexArray) -> FloatArray:
        """Return the lengths of packets in seconds."""
        return np.array([part.step for part in self.parts])[self._part_of(numbers)]

    def _part_of(self, numbers: IndexArray) -> IndexArray:
        firsts = np.array(self._firsts[1:], dtype=np.int64)
        return np.asarray(np.searchsorted(firsts, numbers, side="right"))
