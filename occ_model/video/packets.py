"""The packets that were sent while a film ran: which of them frames show, and how they read."""

from dataclasses import dataclass

import numpy as np

from occ_model.arrays import ByteArray, FloatArray, IndexArray
from occ_model.results.video_reading import FrameReading, PacketReading
from occ_model.transmitter import error_correction
from occ_model.video.period import SentPeriod

_MOST = 1_000_000
"""Most packets that are listed."""


@dataclass(frozen=True, eq=False, slots=True)
class PlacedFrame:
    """A frame on the count of all chips that were sent.

    Parameters
    ----------
    reading
        The frame.
    first
        The number of its first chip among all that were sent.
    """

    reading: FrameReading
    first: int


def packets_of(
    frames: list[PlacedFrame],
    period: SentPeriod,
    bits: ByteArray,
    span: tuple[float, float],
    chip_times: tuple[float, float],
) -> tuple[PacketReading, ...]:
    """List the packets that were sent while a film ran.

    Parameters
    ----------
    frames
        The frames that are placed, in the order of time.
    period
        What is sent.
    bits : ndarray of uint8
        The payload, joined from all frames; empty where it was not read.
    span
        Numbers of the chips between which packets count: those that start after the first one and
        end before the last one.
    chip_times
        The time of chip 0, and of a chip, in seconds.
    """
    length = period.part_length
    numbers = np.arange(int(np.ceil(span[0] / length)), int(np.floor(span[1] / length)))[:_MOST]
    if not numbers.size:
        return ()
    seen = _seen(frames, numbers[0] * length, len(numbers) * length).reshape(-1, length)
    frame_of, bits_of = _read(frames, period)
    sent = _sent_bits(period, bits)
    packets = []
    for number, share in zip(numbers.tolist(), seen.mean(axis=1).tolist(), strict=True):
        part = number % period.parts
        read = bits_of.get(number)
        wrong = None
        if read is not None and sent is not None:
            expected = sent[period.slice_of_part(part)]
            wrong = int((read != expected).sum()) if len(read) == len(expected) else len(expected)
        packets.append(
            PacketReading(
                number=number - int(numbers[0]),
                part=part,
                time=chip_times[0] + number * length * chip_times[1],
                frame=frame_of.get(number),
                seen=share,
                bits=read,
                wrong_bits=wrong,
            )
        )
    return tuple(packets)


def _seen(frames: list[PlacedFrame], first: int, count: int) -> FloatArray:
    seen = np.zeros(count)
    for frame in frames:
        start, end = (frame.first + edge - first for edge in frame.reading.whole)
        seen[max(start, 0) : max(min(end, count), 0)] = 1.0
    return seen


def _read(
    frames: list[PlacedFrame], period: SentPeriod
) -> tuple[dict[int, int], dict[int, ByteArray]]:
    """Read each packet that a frame shows whole; return its frame and its bits by its number."""
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
                cache[content] = period.part_bits(chips)
            found = cache[content]
            if found is not None and found[0] == number % period.parts:
                bits_of[number] = found[1]
    return frame_of, bits_of


def _sent_bits(period: SentPeriod, bits: ByteArray) -> ByteArray | None:
    """Return what the framing was given; None where the payload is not known."""
    if not bits.size or period.scheme is None:
        return None
    if period.parts > 1 and period.scheme.correction != "none":
        return np.asarray(error_correction.protect(bits))
    return bits


def counted_on(places: IndexArray, foretold: FloatArray, period: int) -> IndexArray:
    """Return places counted on over periods, each the nearest to what the clock foretells."""
    return np.asarray(places + period * np.rint((foretold - places) / period)).astype(np.int64)
