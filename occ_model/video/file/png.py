"""Write an animated PNG frame by frame.

Pillow keeps all frames in memory until it has them all. The format: W3C, Portable Network Graphics
(PNG) Specification (Third Edition), 2025, chunks acTL, fcTL and fdAT.
"""

import struct
import zlib
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import cv2

from occ_model.arrays import ByteArray

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_MAX_DELAY_PART = 65_535  # largest numerator or denominator of a frame's delay


def write_png(path: Path, pictures: Iterator[ByteArray], rate: float, note: str) -> int:
    """Write grey or coloured pictures with a note as the text ``Description``; count them."""
    delay = (1 / Fraction(rate)).limit_denominator(_MAX_DELAY_PART)
    count = sequence = place = 0
    with path.open("wb") as file:
        for picture in pictures:
            header, data = _encoded(picture)
            if count == 0:
                file.write(_SIGNATURE + _chunk(b"IHDR", header))
                place = file.tell()
                file.write(_count_of_frames(1))
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
        file.seek(place)
        file.write(_count_of_frames(count))
    return count


def _count_of_frames(count: int) -> bytes:
    return _chunk(b"acTL", struct.pack(">II", count, 0))  # 0: played again and again


def _chunk(name: bytes, content: bytes) -> bytes:
    check = zlib.crc32(content, zlib.crc32(name))
    return struct.pack(">I4s", len(content), name) + content + struct.pack(">I", check)


def _encoded(picture: ByteArray) -> tuple[bytes, bytes]:
    """Encode one picture: its header's content, and its compressed pixels."""
    bgr = cv2.cvtColor(picture, cv2.COLOR_RGB2BGR) if picture.ndim == 3 else picture
    encoded = cv2.imencode(".png", bgr)[1].tobytes()
    place, header, data = len(_SIGNATURE), b"", b""
    while place < len(encoded):
        size, name = struct.unpack_from(">I4s", encoded, place)
        content = encoded[place + 8 : place + 8 + size]
        if name == b"IHDR":
            header = content
        elif name == b"IDAT":
            data += content
        place += 12 + size
    return header, data
