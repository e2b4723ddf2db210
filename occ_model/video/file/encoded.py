"""Write films as FFmpeg encodes them, frame by frame: MPEG-4 in MP4, and FFV1 in Matroska."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import av
import numpy as np
from av.codec.context import Flags
from av.container import OutputContainer
from av.video.reformatter import ColorRange, VideoReformatter
from av.video.stream import VideoStream

from occ_model.arrays import Samples
from occ_model.video.file.note import mkv_note, mp4_note

_FINEST, _LAMBDA = 1, 118  # MPEG-4's smallest loss, and what FFmpeg multiplies it by


@dataclass(frozen=True, slots=True)
class _Encoding:
    container: str
    codec: str
    forms: dict[tuple[int, int], str]  # Of stored pixels, by bytes a sample and dimensions
    largest_rate_part: int  # Largest numerator or denominator of the step between frames
    even: bool  # Whether it has even numbers of lines and columns only


ENCODINGS = {
    ".mp4": _Encoding("mp4", "mpeg4", {(1, 2): "yuv420p", (1, 3): "yuv420p"}, 65_535, even=True),
    ".mkv": _Encoding(
        "matroska", "ffv1", {(1, 2): "gray", (2, 2): "gray16le", (1, 3): "bgr0"}, 10**6, even=False
    ),
}
_GIVEN_FORMS = {(1, 2): "gray", (2, 2): "gray16le", (1, 3): "rgb24"}


def write_encoded(path: Path, pictures: Iterator[Samples], rate: float, note: str) -> int:
    """Write grey or coloured pictures, with a note in a block at the end; return their number."""
    encoding, count = ENCODINGS[path.suffix.lower()], 0
    step = (1 / Fraction(rate)).limit_denominator(encoding.largest_rate_part)
    reformatter, stream = VideoReformatter(), None
    with (
        _disk_errors(),
        path.open("wb") as file,
        av.open(file, "w", format=encoding.container) as container,
    ):
        for picture in pictures:
            lines, columns = (
                side // 2 * 2 if encoding.even else side for side in picture.shape[:2]
            )
            pixels: Any = np.ascontiguousarray(picture[:lines, :columns])
            kind = pixels.dtype.itemsize, pixels.ndim
            if stream is None:
                stream = _add_stream(container, encoding, step, pixels.shape, encoding.forms[kind])
            frame = av.VideoFrame.from_ndarray(pixels, _GIVEN_FORMS[kind])
            if encoding.forms[kind] != _GIVEN_FORMS[kind]:
                # With more threads, the reformatter keeps them alive.
                frame = reformatter.reformat(
                    frame, format=encoding.forms[kind], dst_color_range=ColorRange.MPEG, threads=1
                )
            frame.pts, frame.time_base = count, step
            container.mux(stream.encode(frame))
            count += 1
        if stream is not None:
            container.mux(stream.encode(None))
    with path.open("ab") as file:
        file.write(mp4_note(note) if encoding.container == "mp4" else mkv_note(note))
        file.flush()
        os.fsync(file.fileno())  # some disks report only here that they are full
    return count


@contextmanager
def _disk_errors() -> Iterator[None]:
    """Raise the error of the file that is written, which PyAV wraps into one of its own."""
    try:
        yield
    except av.error.PyAVCallbackError as error:
        reason: BaseException | None = error
        while reason is not None and not isinstance(reason, OSError):
            reason = reason.__cause__ or reason.__context__
        raise (reason or error) from None


def _add_stream(
    container: OutputContainer,
    encoding: _Encoding,
    step: Fraction,
    shape: tuple[int, ...],
    form: str,
) -> VideoStream:
    stream = container.add_stream(encoding.codec, 1 / step)
    if not isinstance(stream, VideoStream):
        raise TypeError(encoding.codec)
    stream.height, stream.width, stream.pix_fmt = shape[0], shape[1], form
    context = stream.codec_context
    context.time_base = step
    if encoding.even:
        context.flags |= Flags.qscale
        context.qmin, context.global_quality = _FINEST, _FINEST * _LAMBDA
    return stream
