"""Results of reading a film: its frames, its packets, and what its clock says."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray
from occ_model.results.decoding import Region


@dataclass(frozen=True, slots=True)
class Measured:
    """A number with its standard deviation."""

    value: float
    error: float


@dataclass(frozen=True, eq=False, slots=True)
class FrameReading:
    """What one frame of a film shows.

    Parameters
    ----------
    index, time
        Those of the frame; the time in seconds.
    region
        The rectangle of the image that was read, None where no panel was found.
    chips : ndarray of uint8, shape (chips,)
        The chips in view, the first sent first; those at both ends may be cut off.
    ratios : ndarray of float64, shape (chips,)
        How much likelier each chip is lit than not: the logarithm of the ratio of both likelihoods.
    whole : (int, int)
        The first chip, and the one after the last, that are not cut off.
    chip_length
        Columns of a chip; None where no chips were read.
    place
        The place of the first chip in what is sent repeatedly, in chips; None where the frame does
        not show it, or not yet.
    failure
        None, or a sentence that says why the frame was not read, or where it was not placed.
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
        Share of its chips that lie whole in any frame, from 0 to 1.
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


@dataclass(frozen=True, slots=True)
class Clock:
    """The clock of a film: what the phases of the stripes say by the frames' times.

    Every time is by the clock that stamps the frames. Errors are standard deviations.

    Parameters
    ----------
    switching_frequency
        In Hz, in the middle of the film.
    drift
        Its change, in Hz a second; None where too few frames show it.
    readout_time
        From one column to the next, in seconds: chips a column over chips a second.
    frame_period
        From one frame to the next, in seconds.
    gap
        The part of the frame period in which no column starts its exposure, in seconds.
    timing_noise
        Root mean square by which frames start earlier or later than they are stamped, in seconds.
    frames
        Frames whose phase was used.
    alternatives
        Other switching frequencies that fit as well, in Hz, and the readout time of each: aliases
        that the rough readout time does not exclude.
    problems
        Sentences: what the frame times or the phases contradict, and what is not certain.
    """

    switching_frequency: Measured
    drift: Measured | None
    readout_time: Measured
    frame_period: Measured
    gap: Measured
    timing_noise: float
    frames: int
    alternatives: tuple[tuple[float, float], ...] = ()
    problems: tuple[str, ...] = ()

    @property
    def is_sure(self) -> bool:
        """Whether no other frequency fits as well."""
        return not self.alternatives

    @property
    def gap_ratio(self) -> float:
        """The gap's share of the frame period."""
        return self.gap.value / self.frame_period.value


@dataclass(frozen=True, slots=True)
class RateWindow:
    """Error rates in a part of a film.

    Parameters
    ----------
    start, end
        In seconds.
    packets, packets_lost
        Packets that were sent, and those of them that were not read right.
    bits, bits_wrong
        Bits that were read and could be compared, and those of them that were wrong.
    """

    start: float
    end: float
    packets: int
    packets_lost: int
    bits: int
    bits_wrong: int


@dataclass(frozen=True, eq=False, slots=True)
class FilmProgress:
    """What is known of a film after some of its frames.

    Parameters
    ----------
    frame
        The last frame.
    frames, placed
        Frames so far, and those of them whose place in the packet is known.
    payload
        The payload as far as it is known, as the scene writes it; unknown letters are dots.
    known
        Share of the payload's chips that were seen.
    complete
        Whether the whole payload is read.
    clock
        The clock as of the last time that it was fitted; None before.
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
    frames
        Its frames.
    packets
        The packets that were sent from the first frame's start to the last one's end; empty where
        the frames' times do not tell how many were sent between frames.
    clock
        What the film says of the clock; None where too few frames show it.
    bits : ndarray of uint8
        The payload's bits, joined from all frames; empty where it was not read.
    known : ndarray of bool
        Which chips of one period of what is sent were seen.
    payload
        The bits as the scene writes its payload; a number's digits where it sends a code.
    certainty
        The probability that all bits are right, by the chips' votes.
    complete_at
        The time of the frame after which the payload was complete, in seconds; None before.
    failure
        None, or a sentence that says why no payload was read.
    """

    frames: tuple[FrameReading, ...]
    packets: tuple[PacketReading, ...]
    clock: Clock | None
    bits: ByteArray
    known: BoolArray
    payload: str
    certainty: float
    complete_at: float | None
    duration: float
    failure: str | None

    @property
    def read(self) -> int:
        """Packets that one frame shows whole, and that are right as far as that is known."""
        return sum(packet.is_read and packet.correct is not False for packet in self.packets)

    @property
    def lost(self) -> int:
        """Packets that were sent and not read, or not read right."""
        return len(self.packets) - self.read

    @property
    def cut_off(self) -> int:
        """Packets that no frame shows whole: those in a gap, or across the edge of a frame."""
        return sum(packet.frame is None for packet in self.packets)

    @property
    def doubled(self) -> int:
        """Packets that were read although their part of the payload had been read before."""
        parts = {packet.part for packet in self.packets if _is_right(packet)}
        return self.read - len(parts)

    @property
    def bits_per_second(self) -> float:
        """Bits of the payload in the packets read, repetitions included, for each second."""
        bits = sum(len(one.bits) for one in self.packets if one.bits is not None and _is_right(one))
        return bits / self.duration if self.duration > 0.0 else 0.0

    @property
    def reception_rate(self) -> float | None:
        """Share of the packets sent that were read right; None where none were counted."""
        return self.read / len(self.packets) if self.packets else None

    @property
    def packet_error_rate(self) -> float | None:
        """Share of the packets sent that were lost; None where none were counted."""
        return self.lost / len(self.packets) if self.packets else None

    @property
    def bit_error_rate(self) -> float | None:
        """Share of wrong bits in the packets that were read; None where none was compared."""
        compared = [one for one in self.packets if one.wrong_bits is not None]
        count = sum(len(one.bits) for one in compared if one.bits is not None)
        return sum(one.wrong_bits or 0 for one in compared) / count if count else None

    def rates(self, windows: int) -> tuple[RateWindow, ...]:
        """Divide the film in parts of equal length, and count the errors in each.

        Parameters
        ----------
        windows
            How many parts.
        """
        start = self.frames[0].time if self.frames else 0.0
        edges = start + self.duration * np.arange(windows + 1) / max(windows, 1)
        times = np.array([packet.time for packet in self.packets])
        number = np.clip(np.searchsorted(edges, times, side="right") - 1, 0, windows - 1)
        found = []
        for place in range(windows):
            here = [self.packets[one] for one in np.flatnonzero(number == place).tolist()]
            found.append(_counted(float(edges[place]), float(edges[place + 1]), here))
        return tuple(found)


def _is_right(packet: PacketReading) -> bool:
    return packet.is_read and packet.correct is not False


def _counted(start: float, end: float, packets: Sequence[PacketReading]) -> RateWindow:
    compared = [one for one in packets if one.bits is not None and one.wrong_bits is not None]
    return RateWindow(
        start=start,
        end=end,
        packets=len(packets),
        packets_lost=sum(not _is_right(one) for one in packets),
        bits=sum(len(one.bits) for one in compared if one.bits is not None),
        bits_wrong=sum(one.wrong_bits or 0 for one in compared),
    )
