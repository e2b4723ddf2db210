"""Films as decoded by FFmpeg, with the times, fields and orientation that their files state."""

from bisect import bisect_left
from collections import deque
from heapq import heappop, heappush
from pathlib import Path
from typing import Any, BinaryIO

import av
from av.container import InputContainer
from av.packet import Packet
from av.sidedata.sidedata import Type as SideData
from av.stream import Disposition
from av.video.frame import VideoFrame
from av.video.stream import VideoStream

from occ_model.errors import VideoError
from occ_model.video.file.channels import ChannelReader
from occ_model.video.file.film_facts import as_fields, describe_film
from occ_model.video.file.orientation import Orientation
from occ_model.video.file.source import (
    MAX_PIXELS,
    FrameSource,
    StoredFrame,
    check_memory,
    explain_too_large,
)

_THREADS = 2
"""Threads of FFmpeg. Each keeps frames: for 4K films, one for each of many processors would take
more memory than the process may use."""

_UPPER_FIRST, _LOWER_FIRST = (2, 4), (3, 5)
"""Values of FFmpeg's ``AVFieldOrder`` by the field that is shown first, as its decoders set them.

Its documentation explains 4 and 5 otherwise, but 4 is set if the upper field is both stored and
shown first, as by Matroska's 9.
"""


class AvSource(FrameSource):
    """The frames of a film's best track; those of an interlaced film are its fields.

    ``demuxer``: FFmpeg's name of the container. FFmpeg is given an open file, as it would open
    others that a path or an address names.
    """

    def __init__(self, path: Path, channel: str, demuxer: str) -> None:
        self._path, self._demuxer = path, demuxer
        self._file = path.open("rb")
        self._container, self._stream = _open(self._file, demuxer)
        context = self._stream.codec_context
        problem = explain_too_large(context.width, context.height)
        if problem:
            raise VideoError(problem)
        self.pixels = context.width * context.height
        context.options = {"max_pixels": str(MAX_PIXELS)}
        context.thread_count, context.thread_type = _THREADS, "AUTO"
        self._reader = ChannelReader(channel, context.name)
        self._packets = self._container.demux(self._stream)
        self._frames: deque[VideoFrame] = deque()
        self._field: tuple[VideoFrame, int] | None = None  # The second one of a frame
        self._timestamps: list[int] | None = None
        self._counts_damage = True
        self._is_numbered, self._numbers = demuxer == "avi", list[int]()
        self._examine_first_frame()

    def _examine_first_frame(self) -> None:
        """Find what only decoding shows: the order of fields, and how frames are oriented."""
        first = self._peek()
        if first is None:
            check_memory(self.pixels)
            raise VideoError("it contains no frame that can be decoded.")
        side_data: Any = first.side_data  # whose types know names only, not the kinds
        matrix = side_data.get(SideData.DISPLAYMATRIX)
        self._orientation = Orientation()
        if matrix is not None:
            self._orientation = Orientation.of_matrix(bytes(matrix))
        order = self._stream.codec_context.field_order
        self._has_fields = order in (*_UPPER_FIRST, *_LOWER_FIRST)
        if first.interlaced_frame and not self._has_fields:
            raise VideoError("it is interlaced, and does not say which of two fields is the first.")
        self._first_field = int(order in _LOWER_FIRST)
        self.facts = describe_film(self._container, self._stream)
        if self._has_fields:
            self.facts = as_fields(self.facts, self._orientation.line_axis)

    def read(self) -> StoredFrame | None:
        picture = self._take()
        if picture is None:
            return None
        frame, field = picture
        time = self._time_of(frame)
        if field is None:
            return StoredFrame(time, self._orientation.turn(self._reader.read(frame)))
        end = frame.height // 2 * 2  # both fields with as many lines
        pixels = self._reader.read(frame, slice(field, end, 2))
        is_second = field != self._first_field
        is_lower = bool(field) != self._orientation.is_last_line_first
        step = 1.0 / self.facts.frame_rate if self.facts.frame_rate else 0.0
        upright = self._orientation.turn(pixels)
        return StoredFrame(time + is_second * step, upright, 0.5 * is_lower)

    def skip(self) -> bool:
        return self._take() is not None

    def seek(self, index: int) -> int | None:
        fields = 1 + self._has_fields
        timestamps = self._list_timestamps()
        number = index // fields
        if self._is_numbered and self._stream.codec_context.has_b_frames:
            return None
        if not 0 <= number < len(timestamps):
            return None
        try:
            self._go_to(timestamps[number])
        except av.FFmpegError:  # a damaged index
            return None
        frame = self._peek()
        if frame is None or frame.pts is None:
            return None
        found = bisect_left(timestamps, frame.pts)
        if found > number or timestamps[found] != frame.pts:
            return None
        return found * fields

    def close(self) -> None:
        self._container.close()
        self._file.close()

    def _time_of(self, frame: VideoFrame) -> float:
        """Return a frame's time in seconds of the recording."""
        if frame.pts is not None and self._stream.time_base is not None:
            return float(frame.pts * self._stream.time_base) / self.facts.slowdown
        return 0.0

    def _take(self) -> tuple[VideoFrame, int | None] | None:
        """Return the next picture: its frame, and the number of its field or None for all of it."""
        if self._field is not None:
            taken, self._field = self._field, None
            return taken
        frame = self._peek()
        if frame is None:
            return None
        self._frames.popleft()
        self.damaged += self._counts_damage and frame.is_corrupt
        if not self._has_fields:
            if frame.interlaced_frame:
                raise VideoError("it is interlaced, but the film's first frame is not.")
            return frame, None
        self._field = frame, 1 - self._first_field
        return frame, self._first_field

    def _peek(self) -> VideoFrame | None:
        """Return the frame that is decoded next; None after the last one."""
        while not self._frames:
            try:
                packet = next(self._packets, None)
            except MemoryError:
                raise
            except (av.FFmpegError, EOFError):
                packet = None
            if packet is None:
                return None
            self._decode_packet(packet)
        return self._frames[0]

    def _decode_packet(self, packet: "Packet[VideoStream]") -> None:
        try:
            frames = packet.decode()
        except MemoryError:
            raise
        except av.FFmpegError:
            self.damaged += self._counts_damage
            return
        if self._is_numbered:
            self._number(packet, frames)
        self._frames.extend(frames)

    def _number(self, packet: "Packet[VideoStream]", frames: list[VideoFrame]) -> None:
        """Give frames their numbers as shown; an AVI file has them in the order of storage."""
        if packet.size and packet.dts is not None:
            heappush(self._numbers, packet.dts)
        for frame in frames:
            if self._numbers:
                frame.pts = heappop(self._numbers)

    def _list_timestamps(self) -> list[int]:
        """List the times of all frames that are shown, in order."""
        if self._timestamps is None:
            with self._path.open("rb") as file, _open(file, self._demuxer)[0] as container:
                packets = [
                    packet.dts if self._is_numbered else packet.pts
                    for packet in container.demux(container.streams[self._stream.index])
                    if packet.size and not packet.is_discard
                ]
            self._timestamps = sorted(time for time in packets if time is not None)
        return self._timestamps

    def _go_to(self, timestamp: int) -> None:
        """Go to the last frame before or at a time from which decoding can start."""
        self._container.seek(timestamp, stream=self._stream)
        self._packets = self._container.demux(self._stream)
        self._frames.clear()
        self._numbers.clear()
        self._field, self._counts_damage = None, False


def _open(file: BinaryIO, demuxer: str) -> tuple[InputContainer, VideoStream]:
    """Open a film's best track; the picture of a cover is none."""
    try:
        container = av.open(file, "r", format=demuxer)
    except (av.FFmpegError, ValueError, LookupError):
        raise VideoError("no film was found in it.") from None
    stream = container.streams.best("video")
    if not isinstance(stream, VideoStream) or stream.disposition & Disposition.attached_pic:
        container.close()
        raise VideoError("no film was found in it.")
    context: object = stream.codec_context  # None for a codec that is not known
    if context is None:
        container.close()
        raise VideoError("its codec is not one of those that can be decoded.")
    return container, stream
