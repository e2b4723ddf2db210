"""Write animated GIF and PNG files frame by frame.

Pillow would keep all frames in memory until the last one. The formats: CompuServe, Graphics
Interchange Format, version 89a; W3C, Portable Network Graphics (PNG) Specification (Third Edition),
2025, chunks acTL, fcTL and fdAT.
"""

import struct
import zlib
from collections.abc import Iterator
from fractions import Fraction
from io import BytesIO
from pathlib import Path

import cv2

from occ_model.arrays import Samples
from occ_model.errors import OutputError

_LARGEST_SIDE = 65_535
_BLOCK = 255  # bytes of a block of data

_LOOP_EXTENSION = b"\x21\xff\x0bNETSCAPE2.0\x03\x01\x00\x00\x00"  # repeat endlessly
_HEAD_BYTES, _DESCRIPTION_BYTES = 13, 10
"""Bytes before the first table of colours, and bytes of a picture's description."""

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_MAX_DELAY_PART = 65_535  # largest numerator or denominator of a frame's delay


def write_gif(path: Path, pictures: Iterator[Samples], rate: float, note: str) -> int:
    """Write grey or coloured pictures, with a note as the comment; return their number.

    Times, not the steps between frames, are rounded to 1/100 s, so that errors do not add up.
    """
    count = 0
    with path.open("wb") as file:
        for picture in pictures:
            lines, columns = picture.shape[:2]
            if max(lines, columns) > _LARGEST_SIDE:
                raise OutputError(
                    f"A GIF film cannot have {columns:,} x {lines:,} pixels; allowed: up to "
                    f"{_LARGEST_SIDE:,} a side."
                )
            if count == 0:
                file.write(b"GIF89a" + struct.pack("<HHBBB", columns, lines, 0, 0, 0))
                file.write(_LOOP_EXTENSION + _comment(note.encode()))
            step = round((count + 1) * 100 / rate) - round(count * 100 / rate)
            file.write(struct.pack("<BBBBHBB", 0x21, 0xF9, 4, 4, step, 0, 0))
            file.write(_encode_gif(picture))
            count += 1
        file.write(b"\x3b")
    return count


def _comment(content: bytes) -> bytes:
    parts = [content[start : start + _BLOCK] for start in range(0, len(content), _BLOCK)]
    return b"\x21\xfe" + b"".join(bytes((len(part),)) + part for part in parts) + b"\0"


def _encode_gif(picture: Samples) -> bytes:
    from PIL import Image

    buffer = BytesIO()
    picture_to_save = Image.fromarray(picture)
    (picture_to_save if picture.ndim == 2 else picture_to_save.quantize()).save(buffer, "GIF")
    content = buffer.getvalue()
    # The file's table of colours, of 2^(size + 1) times three bytes, becomes the picture's own.
    size = content[10] & 7
    table_end = _HEAD_BYTES + 3 * 2 ** (size + 1)
    description = bytearray(content[table_end : table_end + _DESCRIPTION_BYTES])
    description[9] |= 0x80 | size
    table, pixels = content[_HEAD_BYTES:table_end], content[table_end + _DESCRIPTION_BYTES : -1]
    return bytes(description) + table + pixels


def write_png(path: Path, pictures: Iterator[Samples], rate: float, note: str) -> int:
    """Write grey or coloured pictures, with a note as text ``Description``; return their number."""
    delay = (1 / Fraction(rate)).limit_denominator(_MAX_DELAY_PART)
    count = sequence = count_position = 0
    with path.open("wb") as file:
        for picture in pictures:
            header, data = _encode_png(picture)
            if count == 0:
                file.write(_SIGNATURE + _chunk(b"IHDR", header))
                count_position = file.tell()
                file.write(_frame_count_chunk(1))
                file.write(_chunk(b"iTXt", b"Description\0\0\0\0\0" + note.encode()))
            size = header[:8]
            times = struct.pack(">HH", delay.numerator, delay.denominator)
            control = struct.pack(">I", sequence) + size + bytes(8) + times + bytes(2)
            file.write(_chunk(b"fcTL", control))
            sequence += 1
            if count == 0:
                file.write(_chunk(b"IDAT", data))
            else:
                file.write(_chunk(b"fdAT", struct.pack(">I", sequence) + data))
                sequence += 1
            count += 1
        file.write(_chunk(b"IEND", b""))
        file.seek(count_position)
        file.write(_frame_count_chunk(count))
    return count


def _frame_count_chunk(count: int) -> bytes:
    return _chunk(b"acTL", struct.pack(">II", count, 0))  # 0: repeated endlessly


def _chunk(name: bytes, content: bytes) -> bytes:
    check = zlib.crc32(content, zlib.crc32(name))
    return struct.pack(">I4s", len(content), name) + content + struct.pack(">I", check)


def _encode_png(picture: Samples) -> tuple[bytes, bytes]:
    """Encode one picture; return the contents of its header and its compressed pixels."""
    bgr = cv2.cvtColor(picture, cv2.COLOR_RGB2BGR) if picture.ndim == 3 else picture
    encoded = cv2.imencode(".png", bgr)[1].tobytes()
    position, header, data = len(_SIGNATURE), b"", b""
    while position < len(encoded):
        size, name = struct.unpack_from(">I4s", encoded, position)
        content = encoded[position + 8 : position + 8 + size]
        if name == b"IHDR":
            header = content
        elif name == b"IDAT":
            data += content
        position += 12 + size
    return header, data
