"""Films made for tests: moving stripes in many containers and codecs, whole and damaged."""

import struct
from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import av
import numpy as np
from damage import WAYS
from numpy.random import Generator

import occ_model as occ
from occ_model.arrays import ByteArray
from occ_model.video.file.write import write_frames

KINDS = (
    ("mp4", "mp4v"), ("mov", "mp4v"), ("mov", "MJPG"), ("avi", "MJPG"), ("avi", "XVID"),
    ("avi", "HFYU"), ("mkv", "mp4v"), ("mkv", "FFV1"), ("mov", "MPNG"), ("mkv", "VP80"),
    ("webm", "VP90"), ("mp4", "avc1"), ("mkv", "hvc1"), ("webm", "AV01"), ("mov", "apcn"),
)  # fmt: skip
"""Endings and codecs of films, which FFmpeg writes everywhere."""

ENCODERS = {  # of FFmpeg, with the pixels that they are given
    "mp4v": ("mpeg4", "yuv420p"), "MJPG": ("mjpeg", "yuvj420p"), "XVID": ("mpeg4", "yuv420p"),
    "HFYU": ("huffyuv", "rgb24"), "FFV1": ("ffv1", "gray"), "MPNG": ("png", "rgb24"),
    "VP80": ("libvpx", "yuv420p"), "VP90": ("libvpx-vp9", "yuv420p"),
    "avc1": ("libx264", "yuv420p"), "hvc1": ("libx265", "yuv420p10le"),
    "AV01": ("libsvtav1", "yuv420p"), "apcn": ("prores_ks", "yuv422p10le"),
}  # fmt: skip

PICTURES = (("gif", ""), ("png", ""))
"""Animated pictures, which Pillow reads."""

RATE, LINES, COLUMNS = 30.0, 48, 64


def stripes(number: int, lines: int = LINES, columns: int = COLUMNS) -> ByteArray:
    """Return a frame of a film: stripes across the columns, which move from frame to frame."""
    lit = (np.arange(columns) + number) // 8 % 2
    picture = np.broadcast_to(np.where(lit, 235, 20).astype(np.uint8), (lines, columns)).copy()
    picture[: lines // 4] //= 4
    return picture


def write_film(
    path: Path,
    codec: str,
    pictures: Iterable[ByteArray],
    rate: float = RATE,
    size: tuple[int, int] = (LINES, COLUMNS),
    milliseconds: Sequence[int] | None = None,
) -> None:
    """Write grey pictures of a size (lines, columns), and their times, to a film by PyAV alone."""
    encoder, form = ENCODERS[codec]
    silent = {"libx265": {"x265-params": "log-level=none"}}.get(encoder, {})
    with av.open(path, "w") as container:
        stream: Any = container.add_stream(encoder, Fraction(rate).limit_denominator(1001), silent)
        stream.height, stream.width, stream.pix_fmt = *size, form
        stream.gop_size = 12
        if codec != "AV01":
            stream.bit_rate = 4_000_000
        if milliseconds is not None:
            stream.codec_context.time_base = Fraction(1, 1000)
        if codec == "XVID":
            stream.codec_context.codec_tag = codec
        container.start_encoding()  # also if there are no pictures
        for number, picture in enumerate(pictures):
            frame = av.VideoFrame.from_ndarray(picture, "gray").reformat(format=form, threads=1)
            frame.pts = number if milliseconds is None else milliseconds[number]
            container.mux(stream.encode(frame))
        container.mux(stream.encode(None))


@lru_cache
def film_bytes(ending: str, codec: str, frames: int = 20) -> bytes:
    """Return the bytes of a film of stripes."""
    with TemporaryDirectory() as folder:
        path = Path(folder, f"film.{ending}")
        pictures = (stripes(number) for number in range(frames))
        if codec:
            write_film(path, codec, pictures)
        else:
            write_frames(path, [stripes(0), *pictures], RATE, "")
        return path.read_bytes()


def make_damaged_film(seed: int) -> tuple[str, bytes]:
    """Return ending and bytes of a film, damaged at random or with a wrong size or codec."""
    rng = np.random.default_rng(seed)
    ending, codec = (*KINDS, *PICTURES)[rng.integers(len(KINDS) + len(PICTURES))]
    content = bytearray(film_bytes(ending, codec, int(rng.choice([0, 1, 20, 20, 20]))))
    ways = (*WAYS, _enlarge, _replace_codec)
    return ending, bytes(ways[rng.integers(len(ways))](rng, content))


def read_damaged_films(seeds: range, folder: Path) -> list[str]:
    """Read damaged films, of which each must give frames or a sentence; return the sentences."""
    sentences: list[str] = []
    for seed in seeds:
        ending, content = make_damaged_film(seed)
        path = folder / f"film.{ending}"
        path.write_bytes(content)
        try:
            film = occ.load_video(path)
        except occ.VideoError as refusal:
            sentences.append(str(refusal))
            continue
        frames = list(film)
        assert {frame.image.shape for frame in frames} <= {film.shape}, seed
        assert [frame.index for frame in frames] == list(range(len(frames))), seed
        sentences += [film.problem] if film.problem is not None else []
        film.close()
    assert [each for each in sentences if not each.startswith(f"{folder}/film.")] == []
    assert [each for each in sentences if not each.endswith(".")] == []
    return sentences


def _replace_codec(rng: Generator, content: bytearray) -> bytearray:
    codecs = (b"mp4v", b"MJPG", b"jpeg", b"XVID", b"FMP4", b"HFYU", b"FFV1", b"V_VP8", b"V_VP9")
    others = (b"avc1\x00", b"hvc1\x00", b"png \x00", b"abcd\x00", b"apcn\x00")
    for codec in codecs:
        content = content.replace(codec, others[rng.integers(len(others))][: len(codec)])
    return content


def _enlarge(rng: Generator, content: bytearray) -> bytearray:
    """Declare a huge size wherever the film declares its own."""
    width, height = rng.choice([0, 16_383, 30_000, 65_535], 2).tolist()
    for form, scale in ((">HH", 1), ("<HH", 1), ("<II", 1), (">II", 65_536)):
        own = struct.pack(form, COLUMNS * scale, LINES * scale)
        content = content.replace(own, struct.pack(form, width * scale, height * scale))
    # The sizes in Matroska files, as numbers of one byte.
    return content.replace(bytes((0xB0, 0x81, COLUMNS)), bytes((0xB0, 0x81, 255)))


def repeat_first(film: bytes, frames: int) -> bytes:
    """Show the first frame of an MP4 or MOV film again and again, without storing it again."""
    place = film.index(b"stts") + 12
    (step,) = struct.unpack_from(">I", film, place + 4)
    sizes, chunks = film.index(b"stsz") + 8, film.index(b"stco") + 12
    size = struct.unpack_from(">I", film, sizes)[0] or struct.unpack_from(">I", film, sizes + 8)[0]
    (first,) = struct.unpack_from(">I", film, chunks)
    film = _set_table(film, b"stts", struct.pack(">III", 1, frames, step))
    film = _set_table(film, b"stsz", struct.pack(">II", size, frames))
    film = _set_table(film, b"stsc", struct.pack(">IIII", 1, 1, 1, 1))
    film = _set_table(film, b"stco", struct.pack(">I", frames) + struct.pack(">I", first) * frames)
    length = film.index(b"mdhd") + 20
    film = film[:length] + struct.pack(">I", frames * step) + film[length + 4 :]
    return film.replace(b"edts", b"free")  # which says how much of the film is shown


def _set_table(film: bytes, name: bytes, table: bytes) -> bytes:
    """Replace a table of frames in an MP4 film, which has its tables at the end."""
    path = (b"moov", b"trak", b"mdia", b"minf", b"stbl")
    places = [film.rindex(box) - 4 for box in path]
    place = film.index(name, places[-1]) - 4
    (old,) = struct.unpack_from(">I", film, place)
    new = struct.pack(">I", 12 + len(table)) + film[place + 4 : place + 12] + table
    changed = bytearray(film[:place] + new + film[place + old :])
    for outer in places:
        (size,) = struct.unpack_from(">I", changed, outer)
        struct.pack_into(">I", changed, outer, size + len(new) - old)
    return bytes(changed)
