"""One channel of a decoded picture, with the range of its levels that the file states."""

import re
from functools import lru_cache
from typing import Any

import cv2
import numpy as np
from av.video.format import VideoFormat
from av.video.frame import VideoFrame
from av.video.reformatter import ColorRange, Colorspace, VideoReformatter
from numpy.typing import NDArray

from occ_model.arrays import Samples
from occ_model.video.file.source import extract_channel

_LUMA_PLANE = re.compile(r"(yuvj?a?4\d\dp|nv\d|p[024]\d\d|gray(?!f|32))")
_HIGH_BITS = re.compile(r"p[024]\d\d|.*msb")  # names of formats with samples in the high bits of 16
_FULL_IF_UNSTATED = ("ffv1", "ffvhuff", "huffyuv", "png", "rawvideo")
"""Codecs whose grey pictures are of full range unless stated; the standards of others disagree."""

_LIMITED_BLACK, _LIMITED_WHITE = 16, 235  # of 8 bits: ITU-R BT.601 and BT.709
_LINES_AT_ONCE = 32
_LINES_OF_HD = 720  # from which colours are by BT.709 where nothing is stated
_BT709, _BT601, _UNSTATED = 1, 6, 2  # ISO/IEC 23091-2, matrix coefficients
_MATRICES = {_BT709: Colorspace.ITU709, 9: Colorspace.BT2020}


class ChannelReader:
    """Reads one channel of frames, as samples of which the largest number is white.

    Luma is the file's own, without conversion; colours are converted as the file states.
    """

    def __init__(self, channel: str, codec: str) -> None:
        self._channel, self._codec = channel, codec
        self._reformatter = VideoReformatter()

    def read(self, frame: VideoFrame, lines: slice = slice(None)) -> Samples:
        """Return the channel of some lines of a frame."""
        form = frame.format
        if self._channel == "luma" or form.name.startswith("gray"):
            if _LUMA_PLANE.match(form.name):
                return self._read_luma(frame, lines)
            if not (form.is_rgb or form.has_palette or "bayer" in form.name):
                kind = "gray16le" if form.name.startswith("gray") else "yuv444p16le"
                return self._read_luma(self._convert(frame, kind), lines)
        bits = max(component.bits for component in form.components)
        if "bayer" in form.name:  # whose components share the bits of one sample
            bits = form.bits_per_pixel
        picture = self._convert(frame, "bgr48le" if bits > 8 else "bgr24").to_ndarray()
        return extract_channel(np.ascontiguousarray(picture[lines]), self._channel)

    def _read_luma(self, frame: VideoFrame, lines: slice) -> Samples:
        form = frame.format
        bits = form.components[0].bits
        table = _tabulate_levels(bits, self._is_full(frame), bool(_HIGH_BITS.match(form.name)))
        samples = _first_plane(frame, form)[lines]
        if table is None:
            return np.ascontiguousarray(samples)
        if bits == 8:
            return np.asarray(cv2.LUT(samples, table), np.uint8)
        levels = np.empty(samples.shape, table.dtype)
        # In parts, because numpy converts the samples to indices of eight bytes.
        for start in range(0, len(samples), _LINES_AT_ONCE):
            part = slice(start, start + _LINES_AT_ONCE)
            np.take(table, samples[part], out=levels[part], mode="clip")
        return levels

    def _is_full(self, frame: VideoFrame) -> bool:
        if frame.color_range != ColorRange.UNSPECIFIED:
            return frame.color_range == ColorRange.JPEG
        name = frame.format.name
        return name.startswith("yuvj") or (
            name.startswith("gray") and self._codec in _FULL_IF_UNSTATED
        )

    def _convert(self, frame: VideoFrame, form: str) -> VideoFrame:
        matrix = frame.colorspace
        if matrix == _UNSTATED:
            matrix = _BT709 if frame.height >= _LINES_OF_HD else _BT601
        extent = ColorRange.JPEG if self._is_full(frame) else ColorRange.MPEG
        is_luma = not form.startswith("bgr")
        # With more threads, the reformatter keeps them alive.
        return self._reformatter.reformat(
            frame, format=form, src_colorspace=_MATRICES.get(matrix, Colorspace.ITU601),
            src_color_range=extent,
            dst_color_range=extent if is_luma else ColorRange.JPEG, threads=1,
        )  # fmt: skip


def _first_plane(frame: VideoFrame, form: VideoFormat) -> NDArray[Any]:
    plane = frame.planes[0]
    kind: Any = np.uint8
    if form.components[0].bits > 8:
        kind = ">u2" if form.is_big_endian else "<u2"
    content: Any = plane  # which has the buffer protocol, unknown to its types
    lines = np.frombuffer(content, kind).reshape(-1, plane.line_size // np.dtype(kind).itemsize)
    return np.asarray(lines[: frame.height, : frame.width])


@lru_cache(maxsize=8)
def _tabulate_levels(bits: int, is_full: bool, in_high_bits: bool) -> NDArray[Any] | None:
    """Return the level of each sample of a file, in 8 or 16 bits; None if they are the same."""
    if is_full and bits in (8, 16):
        return None
    black, white = (0, 2**bits - 1) if is_full else (
        _LIMITED_BLACK << (bits - 8), _LIMITED_WHITE << (bits - 8)
    )  # fmt: skip
    kind = np.uint8 if bits == 8 else np.uint16
    samples = np.arange(2**bits)
    if in_high_bits:
        samples = np.arange(2**16) >> (16 - bits)
    levels = (samples - black) * (np.iinfo(kind).max / (white - black))
    return np.asarray(np.rint(np.clip(levels, 0, np.iinfo(kind).max)), kind)
