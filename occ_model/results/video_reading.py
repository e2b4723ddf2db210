"""Results of reading a film: frames, packets and clock."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Self

import numpy as np

from occ_model.arrays import BoolArray, ByteArray, FloatArray
from occ_model.results.decoding import Region
from occ_model.results.sent_packets import PacketReading, SentPackets

_AGREEING_ERRORS = 4.0  # standard deviations up to which two values agree


@dataclass(frozen=True, slots=True)
class MeasuredValue:
    """A number with its standard deviation."""

    value: float
    error: float


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
class ClockSolution:
    """The values of one clock that fits a film.

    Times are by the clock that stamps the frames, or, where the lamp's frequency is known, by the
    lamp's and the camera's clock together. Errors are standard deviations.

    Parameters
    ----------
    switching_frequency
        In Hz, at the middle of the film.
    readout_time
        From one column to the next in seconds: chips a column over chips a second.
    frame_period
        From one frame to the next, in seconds.
    gap
        The part of the frame period in which no column starts its exposure, in seconds.
    slow_motion
        How many times longer the film's stated times are.
    """

    switching_frequency: MeasuredValue
    readout_time: MeasuredValue
    frame_period: MeasuredValue
    gap: MeasuredValue
    slow_motion: int


@dataclass(frozen=True, slots=True)
class Clock(ClockSolution):
    """The clock of a film, from the phases of the stripes and the frames' times.

    Parameters
    ----------
    drift
        The change of the frequency in Hz a second; None if there are too few frames to measure it.
    timing_noise
        Root mean square difference of the frames' starts from equal steps or, where these explain
        them better, from their time stamps, in seconds; None if the phases fit no clock, so that
        all times rest on the lamp's known frequency.
    frames
        Number of frames whose phase was used.
    spacing
        How far apart in Hz the switching frequencies are that fit the frames equally well,
        whatever is known; None if the frames do not come in equal steps.
    chips_a_frame
        Chips sent in a frame period, up to the whole periods that ``spacing`` leaves open; None if
        the frames do not come in equal steps.
    phase, repeated_chips
        Chips sent at the film's time 0, in the middle of the exposure of column 0, up to whole
        periods of ``repeated_chips``; None if the phases fit no clock.
    alternatives
        Other clocks that fit equally well and that what is known does not exclude.
    problems
        Sentences on contradictions in the frames' times or phases, and on uncertainties.
    chips_of_cycle
        Number of chips in a cycle of the filmed lamp; 0 for a code.
    """

    drift: MeasuredValue | None
    timing_noise: float | None
    frames: int
    spacing: float | None = None
    chips_a_frame: MeasuredValue | None = None
    phase: MeasuredValue | None = None
    repeated_chips: float = 0.0
    alternatives: tuple[ClockSolution, ...] = ()
    problems: tuple[str, ...] = ()
    chips_of_cycle: int = 0

    def widen_readout(self, relative_error: float, columns: int) -> Self:
        """Add an error to the readout time, and to the gap after as many columns."""
        readout, gap = self.readout_time, self.gap
        added = relative_error * readout.value
        return replace(
            self,
            readout_time=MeasuredValue(readout.value, math.hypot(readout.error, added)),
            gap=MeasuredValue(gap.value, math.hypot(gap.error, columns * added)),
        )

    @property
    def lamp_frequency(self) -> MeasuredValue | None:
        """The frequency of the filmed lamp, in Hz; None for a code."""
        return self._divide_by_cycle(self.switching_frequency)

    @property
    def lamp_drift(self) -> MeasuredValue | None:
        """The change of the lamp's frequency in Hz a second; None for a code, or if unknown."""
        return None if self.drift is None else self._divide_by_cycle(self.drift)

    @property
    def beat(self) -> MeasuredValue | None:
        """How often in Hz a lamp's stripes pass through the frames, positive if the lamp is fast.

        None for a code, or if the frames do not come in equal steps.
        """
        if not self.chips_of_cycle or self.chips_a_frame is None:
            return None
        cycles = self.chips_a_frame.value / self.chips_of_cycle
        period = self.frame_period.value
        beat = (cycles - round(cycles)) / period
        return MeasuredValue(beat, self.chips_a_frame.error / self.chips_of_cycle / period)

    def offset_of(self, other: "Clock") -> MeasuredValue | None:
        """Return the time of another film when this one's time is 0, in seconds.

        It is known up to whole periods of what both films show, which last ``repeat_time``. The
        time of a frame is that of the middle of the exposure of column 0, and that of the first
        frame is 0. None if either clock is not sure.
        """
        if self.phase is None or other.phase is None or not (self.is_sure and other.is_sure):
            return None
        frequency = other.switching_frequency
        chips = (self.phase.value - other.phase.value) % self.repeated_chips
        errors = self.phase.error, other.phase.error, chips * frequency.error / frequency.value
        return MeasuredValue(chips / frequency.value, math.hypot(*errors) / frequency.value)

    @property
    def repeat_time(self) -> float:
        """How long what is sent takes before it repeats, in seconds."""
        return self.repeated_chips / self.switching_frequency.value

    def _divide_by_cycle(self, chip_rate: MeasuredValue) -> MeasuredValue | None:
        chips = self.chips_of_cycle
        return MeasuredValue(chip_rate.value / chips, chip_rate.error / chips) if chips else None

    @property
    def is_sure(self) -> bool:
        """Whether the phases fit this clock, and no other one equally well."""
        return not self.alternatives and self.timing_noise is not None

    def is_sure_of(self, name: str) -> bool:
        """Return whether all clocks that fit agree on a value within its error."""
        if self.timing_noise is None:
            return False
        value: MeasuredValue = getattr(self, name)
        bound = _AGREEING_ERRORS * value.error
        others: list[MeasuredValue] = [getattr(other, name) for other in self.alternatives]
        return all(abs(other.value - value.value) <= bound for other in others)

    @property
    def gap_ratio(self) -> float:
        """The gap as a fraction of the frame period."""
        return self.gap.value / self.frame_period.value


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
