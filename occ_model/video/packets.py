"""Count the packets sent during a film, and read those that its frames show."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.results.sent_packets import FilmPart, PacketReading, SentPackets
from occ_model.results.video_reading import FrameReading
from occ_model.transmitter import error_correction
from occ_model.video.period import SentPeriod


@dataclass(frozen=True, eq=False, slots=True)
class PlacedFrame:
    """A frame and its place in the numbering of all chips that were sent."""

    reading: FrameReading
    first: int  # The number of its first chip in this numbering


@dataclass(frozen=True, eq=False, slots=True)
class CountedPart:
    """A part of a film, within which the times do not jump, in the numbering of all chips sent."""

    frames: list[PlacedFrame]  # Its placed frames, in the order of time
    # Its start by the film's clock, and its duration, in seconds
    start: float
    duration: float
    span: tuple[float, float]  # The chip numbers, with fractions, at its start and at its end


def count_packets(
    parts: Sequence[CountedPart], period: SentPeriod, bits: ByteArray, frequency: float
) -> SentPackets:
    """Count the packets sent during a film, and read those that frames show.

    Only packets that lie completely within a part count. ``bits``: the payload joined from all
    frames; empty if it was not read.
    """
    film_parts: list[FilmPart] = []
    packets: list[PacketReading] = []
    length, framed_bits, earlier_packets = period.part_length, _framed_bits(period, bits), 0
    step = length / frequency
    for part in parts:
        first, end = math.ceil(part.span[0] / length), math.floor(part.span[1] / length)
        count = max(end - first, 0)
        first_start = (first * length - part.span[0]) / frequency
        film_parts.append(
            FilmPart(part.start, part.duration, count, first_start, step, first % period.parts)
        )
        frame_of, bits_of = _read_packets(part.frames, period)
        for number, chips in sorted(_count_visible_chips(part.frames, length).items()):
            if not first <= number < end:
                continue
            packet_bits, packet_index = bits_of.get(number), number - first
            packets.append(
                PacketReading(
                    number=earlier_packets + packet_index,
                    part=number % period.parts,
                    time=part.start + first_start + packet_index * step,
                    frame=frame_of.get(number),
                    seen=chips / length,
                    bits=packet_bits,
                    wrong_bits=_count_wrong(
                        packet_bits, framed_bits, period.slice_of_part(number % period.parts)
                    ),
                )
            )
        earlier_packets += count
    return SentPackets(tuple(film_parts), tuple(packets), period.parts)


def _count_wrong(read: ByteArray | None, sent: ByteArray | None, part: slice) -> int | None:
    """Count the bits of a packet that differ from those sent."""
    if read is None or sent is None:
        return None
    part_bits = sent[part]
    return int((read != part_bits).sum()) if len(read) == len(part_bits) else len(part_bits)


def _count_visible_chips(frames: list[PlacedFrame], length: int) -> dict[int, int]:
    """Count the chips of each packet that frames show whole, by the packet's number."""
    whole_ranges = sorted(
        (frame.first + frame.reading.whole[0], frame.first + frame.reading.whole[1])
        for frame in frames
    )
    counts: dict[int, int] = {}
    counted_until: int | None = None
    for start, end in whole_ranges:
        begin = start if counted_until is None else max(start, counted_until)
        for number in range(begin // length, -(-end // length)):
            chips = min(end, (number + 1) * length) - max(begin, number * length)
            if chips > 0:
                counts[number] = counts.get(number, 0) + chips
        counted_until = end if counted_until is None else max(counted_until, end)
    return counts


def _read_packets(
    frames: list[PlacedFrame], period: SentPeriod
) -> tuple[dict[int, int], dict[int, ByteArray]]:
    """Read each packet that a frame shows whole; return frames and bits by the packet's number."""
    length = period.part_length
    frame_of: dict[int, int] = {}
    bits_of: dict[int, ByteArray] = {}
    cache: dict[bytes, tuple[int, ByteArray] | None] = {}
    for frame in frames:
        start, end = (frame.first + edge for edge in frame.reading.whole)
        for number in range(-(-start // length), end // length):
            chips = frame.reading.chips[number * length - frame.first :][:length]
            frame_of[number] = frame.reading.index
            content = chips.tobytes()
            if content not in cache:
                cache[content] = period.read_part(chips)
            part = cache[content]  # its number and bits
            if part is not None and part[0] == number % period.parts:
                bits_of[number] = part[1]
    return frame_of, bits_of


def _framed_bits(period: SentPeriod, bits: ByteArray) -> ByteArray | None:
    """Return the bits that were given to the framing; None if the payload is unknown."""
    if not bits.size or period.scheme is None:
        return None
    if period.parts > 1 and period.scheme.correction != "none":
        return np.asarray(error_correction.protect(bits))
    return bits


def unwrap_places(places: IndexArray, predicted: FloatArray, period: int) -> IndexArray:
    """Unwrap places over periods, each to the value nearest to the clock's prediction."""
    return np.asarray(places + period * np.rint((predicted - places) / period)).astype(np.int64)
