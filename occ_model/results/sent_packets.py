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
        Fraction of its chips, from 0 to 1, that are completely visible in at least one frame.
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
        """Whether it was read and is not known to be wrong."""
        return self.is_read and self.correct is not False


@dataclass(frozen=True, slots=True)
class FilmPart:
    """A part of a film without gaps in time, and the packets that were sent during it."""

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

    Packets that no frame shows are made on demand, since a film of hours has millions.
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
            return tuple(self[index] for index in range(len(self))[number])
        number = range(len(self))[number]
        position = bisect_left(self._numbers, number)
        if position < len(self.in_view) and self._numbers[position] == number:
            return self.in_view[position]
        part_index = bisect_right(self._firsts[1:], number)
        part, packets_before = self.parts[part_index], number - self._firsts[part_index]
        return PacketReading(
            number=number,
            part=(part.first_part + packets_before) % self.sub_packets,
            time=part.start + part.begin + packets_before * part.step,
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
        windows = []
        for first, end in pairwise(bounds):
            visible = slice(bisect_left(self._numbers, first), bisect_left(self._numbers, end))
            windows.append((max(end - first, 0), self.in_view[visible]))
        return tuple(windows)

    def time_at(self, elapsed: float, is_end: bool = False) -> float:
        """Return the film's time after a running time in seconds, which excludes gaps.

        Between two parts it is the start of the later one, or with ``is_end`` the end of the other.
        """
        search = bisect_left if is_end else bisect_right
        part_index = min(max(search(self._elapsed, elapsed) - 1, 0), len(self.parts) - 1)
        return self.parts[part_index].start + elapsed - self._elapsed[part_index]

    def _count_before(self, elapsed: float) -> int:
        """Count the packets that began before a running time of the film."""
        count = 0
        for part, elapsed_before in zip(self.parts, self._elapsed, strict=False):
            if part.step > 0.0:
                packets_before = math.ceil((elapsed - elapsed_before - part.begin) / part.step)
                count += min(max(packets_before, 0), part.count)
            elif elapsed > elapsed_before:
                count += part.count
        return count

    def starts(self, numbers: IndexArray) -> FloatArray:
        """Return the start times of packets in seconds, by the film's clock."""
        index = self._part_of(numbers)
        first_starts = np.array([part.start + part.begin for part in self.parts])
        packets_before = numbers - np.array(self._firsts, dtype=np.int64)[index]
        return np.asarray(first_starts[index] + packets_before * self.steps(numbers))

    def steps(self, numbers: IndexArray) -> FloatArray:
        """Return the lengths of packets in seconds."""
        return np.array([part.step for part in self.parts])[self._part_of(numbers)]

    def _part_of(self, numbers: IndexArray) -> IndexArray:
        firsts = np.array(self._firsts[1:], dtype=np.int64)
        return np.asarray(np.searchsorted(firsts, numbers, side="right"))
