"""Results of reading a film: its frames, its packets, and its clock."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray
from occ_model.results.decoding import Region
from occ_model.results.sent_packets import PacketReading, SentPackets


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
        """The gap's fraction of the frame period."""
        return self.gap.value / self.frame_period.value


@dataclass(frozen=True, slots=True)
class RateWindow:
    """Error rates in a part of a film."""

    # In seconds
    start: float
    end: float
    # Packets that were sent, and those of them that were not read right
    packets: int
    packets_lost: int
    # Bits that were read and could be compared, and those of them that were wrong
    bits: int
    bits_wrong: int


@dataclass(frozen=True, eq=False, slots=True)
class FilmProgress:
    """What is known of a film after some of its frames.

    Parameters
    ----------
    frames, placed
        Frames so far, and those of them whose place in the packet is known.
    payload
        The payload as far as it is known, as the scene writes it; unknown letters are dots.
    known
        Fraction of the payload's chips that were seen.
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
    packets
        The packets that were sent from the first frame's start to the last one's end; empty where
        the frames' times do not show how many were sent between frames. Where those jump, so that
        what lies between cannot be counted, it is left out of this and of all rates.
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
    duration
        How long the film ran, in seconds: to the end of the last frame's period.
    failure
        None, or a sentence that says why no payload was read.
    problems
        Sentences: what is not regular in the frames' times, and what the clock is not sure of.
    complete_after
        How long the film had run by the end of that frame's period, in seconds; None where it is
        not complete, or there is no clock.
    faults
        A sentence on how often a plug-in has failed; empty where none has.
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
        """Packets that one frame shows whole, and that are right as far as that is known."""
        return sum(packet.is_right for packet in self.packets.in_view)

    @property
    def lost(self) -> int:
        """Packets that were sent and not read, or not read right."""
        return len(self.packets) - self.read

    @property
    def cut_off(self) -> int:
        """Packets that no frame shows whole: those in a gap, or across the edge of a frame."""
        shown = sum(packet.frame is not None for packet in self.packets.in_view)
        return len(self.packets) - shown

    @property
    def doubled(self) -> int:
        """Packets that were read although their part of the payload had been read before."""
        parts = {packet.part for packet in self.packets.in_view if packet.is_right}
        return self.read - len(parts)

    @property
    def bits_per_second(self) -> float:
        """Bits of the payload in the packets read, repetitions included, for each second."""
        right = (one.bits for one in self.packets.in_view if one.is_right)
        bits = sum(len(one) for one in right if one is not None)
        return bits / self.duration if self.duration > 0.0 else 0.0

    @property
    def net_bits_per_second(self) -> float:
        """Bits for each second if every frame showed another payload: repeats within it count once.

        It is the same kind of number as that of a study of single pictures.
        """
        right = (one for one in self.packets.in_view if one.is_right)
        once = {(one.frame, one.part): len(one.bits) for one in right if one.bits is not None}
        return sum(once.values()) / self.duration if self.duration > 0.0 else 0.0

    @property
    def reception_rate(self) -> float | None:
        """Fraction of the packets sent that were read right; None where none were counted."""
        return self.read / len(self.packets) if self.packets else None

    @property
    def packet_error_rate(self) -> float | None:
        """Fraction of the packets sent that were lost; None where none were counted."""
        return self.lost / len(self.packets) if self.packets else None

    @property
    def bit_error_rate(self) -> float | None:
        """Fraction of wrong bits in the packets that were read; None where none was compared."""
        bits, wrong = _compared(self.packets.in_view)
        return wrong / bits if bits else None

    def rates(self, windows: int) -> tuple[RateWindow, ...]:
        """Divide the film in parts of equal length, and count the errors in each.

        Where nothing was sent that can be counted, there are none.

        Parameters
        ----------
        windows
            How many parts.
        """
        if not self.packets:
            return ()
        edges = self.duration * np.arange(windows + 1) / max(windows, 1)
        times = [
            (self.packets.time_at(start), self.packets.time_at(end, is_end=True))
            for start, end in pairwise(edges.tolist())
        ]
        return tuple(
            RateWindow(*between, sent, sent - sum(one.is_right for one in shown), *_compared(shown))
            for between, (sent, shown) in zip(times, self.packets.cut(edges), strict=True)
        )


def _compared(packets: Sequence[PacketReading]) -> tuple[int, int]:
    """Return the number of bits compared, and of those that were wrong."""
    compared = [one for one in packets if one.bits is not None and one.wrong_bits is not None]
    bits = sum(len(one.bits) for one in compared if one.bits is not None)
    return bits, sum(one.wrong_bits or 0 for one in compared)
