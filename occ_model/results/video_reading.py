"""Results of reading a film: frames, packets and clock."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray
from occ_model.results.clock import Clock
from occ_model.results.decoding import Region
from occ_model.results.sent_packets import PacketReading, SentPackets


@dataclass(frozen=True, eq=False, slots=True)
class FrameReading:
    """What was read from one frame of a film.

    Parameters
    ----------
    index, time
        Number and time, in seconds, of the frame.
    region
        The rectangle of the image that was read, None if no panel was found.
    chips : ndarray of uint8, shape (chips,)
        The visible chips, in the order sent; those at both ends may be incomplete.
    ratios : ndarray of float64, shape (chips,)
        For each chip, the logarithm of the likelihood ratio of lit to dark.
    whole : (int, int)
        The first complete chip, and the chip after the last complete one.
    chip_length
        Columns of a chip; None if no chips were read.
    place
        The place of the first chip in the repeated period, in chips; None if it is not known, or
        not yet.
    failure
        None, or a sentence on why the frame was not read or its place is unknown.
    """

    index: int
    time: float
    region: Region | None = None
    chips: ByteArray = field(default_factory=lambda: np.empty(0, dtype=np.uint8))
    ratios: FloatArray = field(default_factory=lambda: np.empty(0))
    whole: tuple[int, int] = (0, 0)
    chip_length: float | None = None
    place: int | None = None
    failure: str | None = None


@dataclass(frozen=True, slots=True)
class RateWindow:
    """Error rates in a part of a film."""

    # In seconds
    start: float
    end: float
    # Packets that were sent, and those that were not read correctly
    packets: int
    packets_lost: int
    # Bits that were read and could be compared, and the wrong ones among them
    bits: int
    bits_wrong: int


@dataclass(frozen=True, eq=False, slots=True)
class FilmProgress:
    """What is known about a film after some of its frames.

    Parameters
    ----------
    frames, placed
        Number of frames so far, and of frames whose place in the packet is known.
    payload
        The payload as far as it is known, in the scene's notation; unknown letters are dots.
    known
        Fraction of the payload's chips that have been read.
    complete
        Whether the whole payload has been read.
    clock
        The clock of the last fit; None before the first.
    """

    frame: FrameReading
    frames: int
    placed: int
    payload: str
    known: float
    complete: bool
    clock: Clock | None


@dataclass(frozen=True, eq=False, slots=True)
class VideoReading:
    """What was read from a film.

    Parameters
    ----------
    packets
        The packets sent from the first frame's start to the last one's end; empty if the frames'
        times do not show how many were sent between frames. Where these times jump, packets cannot
        be counted, and that time is excluded here and from all rates.
    clock
        The film's clock; None if too few frames show it.
    bits : ndarray of uint8
        The payload's bits, joined from all frames; empty if it was not read.
    known : ndarray of bool
        Which chips of the repeated period were read.
    payload
        The bits in the notation of the scene's payload, or the digits of a code.
    certainty
        The probability that all bits are right, from the chips' votes.
    complete_at
        The time in seconds of the frame that completed the payload; None if it is not complete.
    duration
        Length of the film in seconds, to the end of the last frame's period.
    failure
        None, or a sentence on why no payload was read.
    problems
        Sentences on irregular frame times, and on what is uncertain about the clock.
    complete_after
        Length of the film, in seconds, to the end of the period of the frame that completed the
        payload; None if it is not complete, or there is no clock.
    faults
        A sentence on how often a plug-in has failed; empty if none has.
    """

    frames: tuple[FrameReading, ...]
    packets: SentPackets
    clock: Clock | None
    bits: ByteArray
    known: BoolArray
    payload: str
    certainty: float
    complete_at: float | None
    duration: float
    failure: str | None
    problems: tuple[str, ...] = ()
    complete_after: float | None = None
    faults: str = ""

    @property
    def read(self) -> int:
        """Number of packets that one frame shows completely and that are not known to be wrong."""
        return sum(packet.is_right for packet in self.packets.in_view)

    @property
    def lost(self) -> int:
        """Number of packets that were sent but not read, or not read correctly."""
        return len(self.packets) - self.read

    @property
    def cut_off(self) -> int:
        """Number of packets that no frame shows completely: in a gap, or across a frame's edge."""
        complete = sum(packet.frame is not None for packet in self.packets.in_view)
        return len(self.packets) - complete

    @property
    def doubled(self) -> int:
        """Number of packets that were read after their part of the payload had been read before."""
        parts = {packet.part for packet in self.packets.in_view if packet.is_right}
        return self.read - len(parts)

    @property
    def bits_per_second(self) -> float:
        """Payload bits a second in all packets that were read, with repetitions."""
        right = (packet.bits for packet in self.packets.in_view if packet.is_right)
        bits = sum(len(packet) for packet in right if packet is not None)
        return bits / self.duration if self.duration > 0.0 else 0.0

    @property
    def net_bits_per_second(self) -> float:
        """Bits a second as if each frame had its own payload: repetitions in a frame count once.

        It is comparable with the rate in studies of single pictures.
        """
        right = (packet for packet in self.packets.in_view if packet.is_right)
        distinct = {
            (packet.frame, packet.part): len(packet.bits)
            for packet in right
            if packet.bits is not None
        }
        return sum(distinct.values()) / self.duration if self.duration > 0.0 else 0.0

    @property
    def reception_rate(self) -> float | None:
        """Fraction of the sent packets that were read correctly; None if none were counted."""
        return self.read / len(self.packets) if self.packets else None

    @property
    def packet_error_rate(self) -> float | None:
        """Fraction of the sent packets that were lost; None if none were counted."""
        return self.lost / len(self.packets) if self.packets else None

    @property
    def bit_error_rate(self) -> float | None:
        """Fraction of wrong bits in the packets that were read; None if none could be compared."""
        bits, wrong = _count_compared(self.packets.in_view)
        return wrong / bits if bits else None

    def rates(self, windows: int) -> tuple[RateWindow, ...]:
        """Divide the film into parts of equal length, and count the errors in each.

        There are none if the packets could not be counted.

        Parameters
        ----------
        windows
            Number of parts.
        """
        if not self.packets:
            return ()
        edges = self.duration * np.arange(windows + 1) / max(windows, 1)
        times = [
            (self.packets.time_at(start), self.packets.time_at(end, is_end=True))
            for start, end in pairwise(edges.tolist())
        ]
        return tuple(
            RateWindow(
                *times_of_window,
                sent,
                sent - sum(packet.is_right for packet in visible),
                *_count_compared(visible),
            )
            for times_of_window, (sent, visible) in zip(times, self.packets.cut(edges), strict=True)
        )


def _count_compared(packets: Sequence[PacketReading]) -> tuple[int, int]:
    """Count the bits that could be compared, and the wrong ones among them."""
    comparable = [
        packet for packet in packets if packet.bits is not None and packet.wrong_bits is not None
    ]
    bits = sum(len(packet.bits) for packet in comparable if packet.bits is not None)
    return bits, sum(packet.wrong_bits or 0 for packet in comparable)
