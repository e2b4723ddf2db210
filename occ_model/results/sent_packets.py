"""The packets that were sent while a film ran: counted, and listed only where frames show them."""

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
    """One packet, or sub-packet, among those that were sent while the film ran.

    Parameters
    ----------
    number
        Its number among those sent, from 0 for the first one.
    part
        Which part of the payload it carries, from 0: its sub-packet; 0 where a packet is the whole.
    time
        When it began, in seconds by the film's clock.
    frame
        The frame that shows it whole; None where none does.
    seen
        Fraction of its chips that lie whole in any frame, from 0 to 1.
    bits : ndarray of uint8 or None
        The bits read of this packet alone; None where it was not read.
    wrong_bits
        Bits that differ from those of the payload joined from all packets; None where either was
        not read.
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
        """Whether one frame shows it whole, and it could be read."""
        return self.bits is not None

    @property
    def correct(self) -> bool | None:
        """Whether it is as the joined payload has it; None where either was not read."""
        return None if self.wrong_bits is None else self.wrong_bits == 0

    @property
    def is_right(self) -> bool:
        """Whether it is read, and right as far as that is known."""
        return self.is_read and self.correct is not False


@dataclass(frozen=True, slots=True)
class FilmPart:
    """A part of a film in which frame follows frame, and the packets that were sent meanwhile."""

    # When its first frame began by the film's clock, and how long it is, in seconds
    start: float
    duration: float
    count: int = 0
    # When the first of them began after ``start``, and the time from one to the next, in seconds
    begin: float = 0.0
    step: float = 0.0
    first_part: int = 0  # The number of the sub-packet that the first of them is


@dataclass(frozen=True, eq=False)
class SentPackets(Sequence[PacketReading]):
    """The packets that were sent while a film ran, in the order of their numbers.

    One that no frame shows is made on demand: a film of hours has millions of them.
    """

    parts: tuple[FilmPart, ...] = ()
    in_view: tuple[PacketReading, ...] = ()  # The packets of which frames show chips, in order
    sub_packets: int = 1

    @cached_property
    def _firsts(self) -> list[int]:
        """Number of each part's first packet, and of all packets."""
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
        """Divide the packets by the running time of the film at which each began.

        ``edges``: rising times in seconds without the gaps between the film's parts; all packets
        lie between the outermost two. Returns the number sent, and those in view, in each window.
        """
        bounds = [0, *(self._before(edge) for edge in edges[1:-1].tolist()), len(self)]
        found = []
        for first, end in pairwise(bounds):
            here = slice(bisect_left(self._numbers, first), bisect_left(self._numbers, end))
            found.append((max(end - first, 0), self.in_view[here]))
        return tuple(found)

    def time_at(self, elapsed: float, is_end: bool = False) -> float:
        """Return the film's time when it had run for so many seconds, without gaps.

        At a cut it is where the next part begins, or with ``is_end`` where the part before ends.
        """
        search = bisect_left if is_end else bisect_right
        place = min(max(search(self._elapsed, elapsed) - 1, 0), len(self.parts) - 1)
        return self.parts[place].start + elapsed - self._elapsed[place]

    def _before(self, elapsed: float) -> int:
        """Return the number of packets that began before the film had run for so long."""
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
